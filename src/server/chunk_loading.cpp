#include "server/chunk_loading.h"

#include "base/clock.h"
#include "base/log.h"
#include "light/relight.h"
#include "math/mat.h"
#include "server/interest.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace vitrail::server {

namespace {

ColumnPos column_of_player(const Session& session) {
    return column_of(chunk_of(block_of(session.body.feet.at)));
}

bool in_range(ColumnPos a, ColumnPos b, float radius) {
    const double dx = double(i64(a.x) - b.x), dz = double(i64(a.z) - b.z);
    return dx * dx + dz * dz <= double(radius) * radius;
}

bool column_in_world(ColumnPos at) {
    return in_world(ChunkPos{at.x, 0, at.z});
}

constexpr float kMovedBlocks = 2;     // further than this from where it joined a player moves: the budget holds
constexpr float kSpeedShare = 0.2f;   // of a tick's speed in the mean
constexpr float kTeleportBlocks = 16; // a tick; no speed at all
constexpr int kSectors = 16;          // directions are rounded, so that turning a little sorts nothing anew

float rounded(float v, float step) {
    return std::round(v / step) * step;
}

// Follows the player's way; every tick.
void follow(Session& session) {
    const WorldPos at = session.body.feet.at;
    if (!session.followed) session.followed = true, session.joined_at = session.followed_at = at, session.speed = {};
    const Vec3 moved = view_from(session.followed_at, at).v, away = view_from(session.joined_at, at).v;
    session.followed_at = at;
    if (length(away) > kMovedBlocks) session.travels = true;
    session.speed = length(moved) > kTeleportBlocks
                        ? Vec3{}
                        : session.speed + (moved * float(kTicksASecond) - session.speed) * kSpeedShare;
}

GenerationViewer viewer_of(const Session& session) {
    GenerationViewer v;
    v.at = column_of_player(session);
    v.radius = float(session.view_distance) + kLoadMargin;
    constexpr float step = 6.2831853f / kSectors;
    const Vec3 look = look_direction(rounded(session.body.yaw, step), 0);
    v.look_x = look.x, v.look_z = look.z;
    const float speed = std::sqrt(session.speed.x * session.speed.x + session.speed.z * session.speed.z);
    if (speed > 1) {
        const float towards = rounded(std::atan2(session.speed.z, session.speed.x), step);
        const float columns = rounded(speed / kChunkSize, 0.5f);
        v.move_x = std::cos(towards) * columns, v.move_z = std::sin(towards) * columns;
    }
    return v;
}

} // namespace

bool ready(const ServerDimension& dimension, ColumnPos at) {
    return dimension.columns.contains(at);
}

bool surrounded(const ServerDimension& dimension, ColumnPos at) {
    for (i32 dz = -1; dz <= 1; ++dz)
        for (i32 dx = -1; dx <= 1; ++dx) {
            const ColumnPos p{at.x + dx, at.z + dz};
            if (!ready(dimension, p) && column_in_world(p)) return false;
        }
    return true;
}

ChunkPtr require_chunk(ServerDimension& dimension, ChunkPos at) {
    if (ChunkPtr chunk = dimension.dimension.find(at)) return chunk;
    const auto found = dimension.columns.find(column_of(at));
    if (found == dimension.columns.end() || !found->second.made) return nullptr;
    if (!dimension.dimension.contains(origin_of(at))) return nullptr;
    dimension.dimension.put(at, std::make_shared<const Chunk>());
    const ChunkPos one[1] = {at};
    for (ChunkPos lit : relight_chunks(dimension.dimension, one).light_chunks)
        dimension.light_changed.insert(lit);
    return dimension.dimension.find(at);
}

void request_columns(ServerWorld& world) {
    for (auto& [id, dimension] : world.dimensions) {
        std::vector<GenerationViewer> viewers;
        bool travels = false;
        for (const auto& session : world.sessions) {
            if (!session->joined || session->gone || session->dimension() != id) continue;
            follow(*session);
            travels |= session->travels;
            viewers.push_back(viewer_of(*session));
        }
        GenerationScheduler& scheduler = *dimension.scheduler;
        // Until somebody moves nothing is there to stutter, and everybody waits for the land.
        scheduler.set_limited(travels);
        scheduler.plan(viewers, [&columns = dimension.columns](ColumnPos at) { return columns.contains(at); });
        scheduler.pump();
    }
}

namespace {

void publish(ServerDimension& dimension, FinishedColumn finished) {
    Column& column = dimension.columns[finished.at];
    ++dimension.opened;
    if (!finished.column) {
        log_error(fmt::format("column {} {} does not load: {}", finished.at.x, finished.at.z,
                              finished.column.error().message));
        // Left as never made, so that nothing is generated over what may still be read one day.
        column = {false, true};
        return;
    }
    ColumnData& data = *finished.column;
    std::vector<ChunkPos> positions;
    for (auto& c : data.chunks) {
        positions.push_back(c.at);
        dimension.dimension.put(c.at, std::move(c.chunk));
    }
    dimension.dimension.put_heights(finished.at, data.heights);
    for (ChunkPos lit : relight_chunks(dimension.dimension, positions).light_chunks)
        dimension.light_changed.insert(lit);
    column = {data.made, data.stored};
}

} // namespace

void publish_columns(ServerWorld& world, float budget_ms) {
    const u64 start = now_ns();
    for (auto& [id, dimension] : world.dimensions) {
        bool any = false;
        while (!any || seconds_since(start) * 1000 <= double(budget_ms)) {
            auto finished = dimension.scheduler->take();
            if (!finished) break;
            publish(dimension, std::move(*finished));
            any = true;
        }
        const bool complete = dimension.scheduler->pending() == 0;
        for (auto& session : world.sessions)
            if (session->dimension() == id) session->columns_complete = complete;
    }
}

void unload_columns(ServerWorld& world) {
    for (auto& [id, dimension] : world.dimensions) {
        std::vector<ColumnPos> leave;
        for (const auto& [at, column] : dimension.columns) {
            bool needed = dimension.dirty_columns.contains(at);
            for (const auto& session : world.sessions)
                needed |= session->joined && session->dimension() == id &&
                          in_range(column_of_player(*session), at, float(session->view_distance) + kKeepMargin);
            if (!needed) leave.push_back(at);
        }
        const DimensionInfo& info = dimension.dimension.info();
        for (ColumnPos at : leave) {
            for (i32 y = info.min_y >> 4; y < info.max_y >> 4; ++y) {
                const ChunkPos p{at.x, y, at.z};
                dimension.dimension.erase(p);
                dimension.connections.erase(p);
                dimension.light_changed.erase(p);
            }
            dimension.dimension.erase_heights(at);
            dimension.heights_changed.erase(at);
            dimension.columns.erase(at);
        }
    }
}

} // namespace vitrail::server
