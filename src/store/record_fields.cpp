#include "store/record_fields.h"

namespace vitrail::stored {

Level to_stored(const LevelRecord& v) {
    return {v.name,       v.seed,      u32(v.spawn.dimension), v.spawn.at.x,   v.spawn.at.y, v.spawn.at.z, v.spawn_yaw,
            v.time_ticks, v.generator, v.generator_version,    v.content_hash, v.source, v.unfinished,
            v.day_minutes};
}

Dimension to_stored(const DimensionInfo& v) {
    return {v.name, v.min_y, v.max_y, v.has_sky, v.sea_level};
}

Column to_stored(const ColumnRecord& v) {
    Column out{{}, v.generated, v.lit, v.stage};
    out.above.reserve(256);
    u32 last = 0; // unsigned: differences of far heights wrap instead of overflowing
    for (i32 y : v.heights.above) {
        out.above.push_back(i32(u32(y) - last));
        last = u32(y);
    }
    return out;
}

Player to_stored(const PlayerRecord& v) {
    return {u32(v.at.dimension), v.at.at.x, v.at.at.y, v.at.at.z, v.yaw, v.pitch, v.hotbar,
            v.hotbar_slot,       v.flying,  v.extra};
}

Result<LevelRecord> from_stored(const Level& v) {
    LevelRecord out;
    out.name = v.name;
    out.seed = v.seed;
    out.spawn = {DimensionId(v.spawn_dimension), {v.spawn_x, v.spawn_y, v.spawn_z}};
    if (!in_world(out.spawn.at)) return fail(ErrorCode::damaged, "spawn lies beyond the edge of the world");
    out.spawn_yaw = v.spawn_yaw;
    out.time_ticks = v.time_ticks;
    out.generator = v.generator;
    out.generator_version = v.generator_version;
    out.content_hash = v.content_hash;
    out.source = v.source;
    out.unfinished = v.unfinished;
    out.day_minutes = v.day_minutes;
    return out;
}

Result<DimensionInfo> from_stored(DimensionId id, const Dimension& v) {
    if (v.min_y >= v.max_y || v.min_y < -kWorldEdge || v.max_y > kWorldEdge || (v.min_y & 15) || (v.max_y & 15))
        return fail(ErrorCode::damaged, "a dimension's lowest and highest y are no range of chunks");
    return DimensionInfo{id, v.name, v.min_y, v.max_y, v.has_sky, v.sea_level};
}

Result<ColumnRecord> from_stored(const Column& v) {
    if (v.above.size() != 256) return fail(ErrorCode::damaged, "a column has not 256 heights");
    ColumnRecord out{{}, v.generated, v.lit, v.stage};
    u32 last = 0;
    for (std::size_t i = 0; i < 256; ++i)
        out.heights.above[i] = i32(last += u32(v.above[i]));
    return out;
}

Result<PlayerRecord> from_stored(std::string name, const Player& v) {
    PlayerRecord out;
    out.name = std::move(name);
    out.at = {DimensionId(v.dimension), {v.x, v.y, v.z}};
    if (!in_world(block_of(out.at.at))) return fail(ErrorCode::damaged, "a player stands beyond the edge of the world");
    out.yaw = v.yaw;
    out.pitch = v.pitch;
    out.hotbar = v.hotbar;
    out.hotbar_slot = v.hotbar_slot;
    out.flying = v.flying;
    out.extra = v.extra;
    return out;
}

} // namespace vitrail::stored
