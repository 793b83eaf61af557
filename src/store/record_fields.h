// The stored form of the typed records: structs with numbered fields (base/fields.h), and their way to and from the
// structs that the program uses. Numbers are never used again for another meaning; docs/formats/store.md lists them.
#pragma once

#include "store/world_records.h"

namespace vitrail::stored {

inline constexpr u8 kVersion = 1; // of every record but chunks, whose payload carries its own

struct Counts { // meta "counts"
    u32 states = 0, biomes = 0;
    static constexpr auto fields =
        std::tuple{field<1>("states", &Counts::states, {.most_value = StateTable::kCapacity}),
                   field<2>("biomes", &Counts::biomes, {.most_value = BiomeTable::kCapacity})};
};

struct Level { // meta "level"
    std::string name;
    u64 seed = 0;
    u32 spawn_dimension = 0;
    i32 spawn_x = 0, spawn_y = 0, spawn_z = 0;
    float spawn_yaw = 0;
    u64 time_ticks = 0;
    std::string generator;
    u32 generator_version = 0;
    u64 content_hash = 0;
    std::string source;
    bool unfinished = false;
    u32 day_minutes = kUsualDayMinutes;
    static constexpr auto fields = std::tuple{field<1>("name", &Level::name, {.most = 1024}),
                                              field<2>("seed", &Level::seed),
                                              field<3>("spawn_dimension", &Level::spawn_dimension),
                                              field<4>("spawn_x", &Level::spawn_x),
                                              field<5>("spawn_y", &Level::spawn_y),
                                              field<6>("spawn_z", &Level::spawn_z),
                                              field<7>("spawn_yaw", &Level::spawn_yaw),
                                              field<8>("time_ticks", &Level::time_ticks),
                                              field<9>("generator", &Level::generator, {.most = 256}),
                                              field<10>("generator_version", &Level::generator_version),
                                              field<11>("content_hash", &Level::content_hash),
                                              field<12>("source", &Level::source, {.most = 4096}),
                                              field<13>("unfinished", &Level::unfinished),
                                              field<14>("day_minutes", &Level::day_minutes,
                                                        {.most_value = kMostDayMinutes})};
};

struct Dimension { // dimension, by id
    std::string name;
    i32 min_y = 0, max_y = 0;
    bool has_sky = true;
    i32 sea_level = 63;
    static constexpr auto fields =
        std::tuple{field<1>("name", &Dimension::name, {.most = 256}), field<2>("min_y", &Dimension::min_y),
                   field<3>("max_y", &Dimension::max_y), field<4>("has_sky", &Dimension::has_sky), field<5>("sea_level", &Dimension::sea_level)};
};

struct Column {             // column, by dimension, x, z
    std::vector<i32> above; // 256 heights, each less the one before
    bool generated = false, lit = false;
    u32 stage = 0;
    static constexpr auto fields =
        std::tuple{field<1>("above", &Column::above, {.most = 256}), field<2>("generated", &Column::generated),
                   field<3>("lit", &Column::lit), field<4>("stage", &Column::stage)};
};

struct Player { // player, by name
    u32 dimension = 0;
    i64 x = 0, y = 0, z = 0; // 32.32 fixed point
    float yaw = 0, pitch = 0;
    std::vector<std::string> hotbar;
    u8 hotbar_slot = 0;
    bool flying = false;
    Bytes extra;
    static constexpr auto fields = std::tuple{field<1>("dimension", &Player::dimension),
                                              field<2>("x", &Player::x),
                                              field<3>("y", &Player::y),
                                              field<4>("z", &Player::z),
                                              field<5>("yaw", &Player::yaw),
                                              field<6>("pitch", &Player::pitch),
                                              field<7>("hotbar", &Player::hotbar, {.most = 64}),
                                              field<8>("hotbar_slot", &Player::hotbar_slot, {.most_value = 63}),
                                              field<9>("flying", &Player::flying),
                                              field<10>("extra", &Player::extra, {.most = 1 << 20})};
};

struct Quarantined { // quarantine, by table number and key
    std::string reason;
    Bytes record; // as it was found
    static constexpr auto fields = std::tuple{field<1>("reason", &Quarantined::reason, {.most = 4096}),
                                              field<2>("record", &Quarantined::record, {.most = 64 << 20})};
};

Level to_stored(const LevelRecord& v);
Dimension to_stored(const DimensionInfo& v);
Column to_stored(const ColumnRecord& v);
Player to_stored(const PlayerRecord& v);
// Errors: damaged, a value that no world of ours has.
Result<LevelRecord> from_stored(const Level& v);
Result<DimensionInfo> from_stored(DimensionId id, const Dimension& v);
Result<ColumnRecord> from_stored(const Column& v);
Result<PlayerRecord> from_stored(std::string name, const Player& v);

} // namespace vitrail::stored
