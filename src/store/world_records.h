// WorldRecords: the typed layer over a WorldStore: level, dimensions, state and biome tables, chunks, columns, players,
// script data. What belongs together goes into one SaveBatch and is kept in one transaction, together with every state
// and biome that was numbered since the last one.
//
//     auto records = WorldRecords::open(folder, registry, {.create = true});    // or {.read_only = true}
//     SaveBatch batch;
//     batch.chunks.push_back({dimension, at, chunk});
//     VX_TRY((*records)->save(batch));                                           // durable; SaveQueue does it
//     off-thread
//
// A record that fails its checksum or does not parse is moved to the quarantine table with the reason, logged, counted
// in damage(), and read as never made; the world goes on. Thread-safe as the store is.
#pragma once

#include "base/fields.h"
#include "store/sqlite_store.h"
#include "store/world_store.h"
#include "voxel/chunk_codec.h"
#include "world/biome_table.h"
#include "world/day_clock.h"
#include "world/dimension.h"
#include "world/state_table.h"

#include <map>
#include <memory>
#include <mutex>

namespace vitrail {

struct LevelRecord {
    std::string name{};
    u64 seed = 0;
    Located<BlockPos> spawn{};
    float spawn_yaw = 0;     // degrees
    u64 time_ticks = 0;      // since the world began; a day has 24000
    u32 day_minutes = kUsualDayMinutes; // how long a day takes, of real time, 0..kMostDayMinutes; 0: time stands still
    std::string generator{}; // "" : none, never-made chunks stay absent
    u32 generator_version = 0;
    u64 content_hash = 0; // of the content it was last played with
    std::string source{}; // where it was imported from, for people
    bool unfinished = false; // being imported: what is here is a part
};

struct ColumnRecord {
    ColumnHeights heights{};
    bool generated = false; // every chunk of the column that has anything in it is stored: absent ones are air
    bool lit = false;       // sky and block light of the stored chunks are settled
    u32 stage = 0;          // the generator's own mark
};

struct PlayerRecord {
    std::string name{};
    Located<WorldPos> at{};
    float yaw = 0, pitch = 0;          // degrees
    std::vector<std::string> hotbar{}; // block state texts
    u8 hotbar_slot = 0;
    bool flying = false;
    Bytes extra{}; // rules' own additions, opaque here
};

struct SaveBatch {
    struct ChunkSave {
        DimensionId dimension{};
        ChunkPos at;
        ChunkPtr chunk; // null: the record goes, the chunk is never made again
    };
    struct ColumnSave {
        DimensionId dimension{};
        ColumnPos at;
        ColumnRecord column;
    };
    struct EntitySave {
        u64 id = 0;
        std::optional<Bytes> data; // none: it is gone
    };
    struct ScriptSave {
        std::string key;
        std::optional<Bytes> value;
    };
    std::optional<LevelRecord> level;
    std::vector<DimensionInfo> dimensions;
    std::vector<ChunkSave> chunks;
    std::vector<ColumnSave> columns;
    std::vector<EntitySave> entities;
    std::vector<PlayerRecord> players;
    std::vector<ScriptSave> scripts;
    bool empty() const {
        return !level && dimensions.empty() && chunks.empty() && columns.empty() && entities.empty() &&
               players.empty() && scripts.empty();
    }
};

// One damaged record, set aside.
struct Damage {
    Table table{};
    Bytes key;
    std::string reason;
};

class WorldRecords {
public:
    // Loads the state and biome tables. `registry` is the content that states are resolved against; an empty
    // BlockRegistry serves tools. Errors: the store's; damaged, where the tables are beyond repair.
    static Result<std::unique_ptr<WorldRecords>> over(std::unique_ptr<WorldStore> store,
                                                      std::shared_ptr<const BlockRegistry> registry);
    // open_sqlite_store and over.
    static Result<std::unique_ptr<WorldRecords>>
    open(const std::string& folder, std::shared_ptr<const BlockRegistry> registry, const OpenOptions& options = {});

    WorldStore& store() { return *store_; }
    StateTable& states() const { return *states_; }
    const std::shared_ptr<StateTable>& states_ptr() const { return states_; }
    const std::shared_ptr<BiomeTable>& biomes_ptr() const { return biomes_; }
    BiomeTable& biomes() const { return *biomes_; }
    // What decode_chunk may take from this world's store.
    DecodeLimits decode_limits() const;

    // Each: nothing (null, empty) where never saved. Errors: the store's.
    Result<std::optional<LevelRecord>> load_level();
    Result<std::vector<DimensionInfo>> load_dimensions();
    Result<ChunkPtr> load_chunk(DimensionId dimension, ChunkPos at);
    struct ColumnChunk {
        ChunkPos at;
        ChunkPtr chunk;
    };
    // All stored chunks of a column in one range scan, bottom first.
    Result<std::vector<ColumnChunk>> load_column_chunks(DimensionId dimension, ColumnPos at);
    Result<std::optional<ColumnRecord>> load_column(DimensionId dimension, ColumnPos at);
    Result<std::optional<Bytes>> load_entity(u64 id);
    Result<std::optional<PlayerRecord>> load_player(const std::string& name);
    Result<std::vector<PlayerRecord>> load_players();
    Result<std::optional<Bytes>> load_script(const std::string& key);
    Result<std::map<std::string, Bytes>> load_scripts();
    // Positions of all stored columns (those with a ColumnRecord or a chunk).
    Result<std::vector<ColumnPos>> list_columns(DimensionId dimension);

    // One transaction; durable when it returns. Errors: the store's, nothing kept then.
    Result<> save(const SaveBatch& batch);

    // Damaged records found and set aside since opening.
    std::vector<Damage> damage() const;

private:
    WorldRecords(std::unique_ptr<WorldStore> store, std::shared_ptr<const BlockRegistry> registry);
    Result<> load_tables();
    void set_aside(Table table, ByteView key, ByteView record, const std::string& reason);
    // What can be wrong with one record: handled here, so that the callers see only good ones and the store's errors.
    template <class Parse>
    auto load(Table table, const Bytes& key, u8 version_most, Parse parse)
        -> Result<std::optional<typename decltype(parse(ByteView{}))::value_type>>;
    template <class Visit>
    Result<> load_range(Table table, ByteView from, ByteView to, u8 version_most, Visit visit);

    std::unique_ptr<WorldStore> store_;
    std::shared_ptr<StateTable> states_;
    std::shared_ptr<BiomeTable> biomes_;
    std::mutex save_mutex_; // guards the two counts: what the store already holds of the tables
    u32 states_kept_ = 0, biomes_kept_ = 0;
    mutable std::mutex damage_mutex_;
    std::vector<Damage> damage_;
};

} // namespace vitrail
