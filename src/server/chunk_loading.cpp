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

bool in_range(ColumnPos a, ColumnPos b, i32 radius) {
    return std::abs(i64(a.x) - b.x) <= radius && std::abs(i64(a.z) - b.z) <= radius;
}

bool column_in_world(ColumnPos at) {
    return in_world(ChunkPos{at.x, 0, at.z});
}

// Smaller is sooner: the distance in chunks, columns behind the player count as half as far again.
float urgency(const Session& session, ColumnPos at) {
    const ColumnPos here = column_of_player(session);
    const float dx = float(at.x - here.x), dz = float(at.z - here.z);
    const float distance = std::sqrt(dx * dx + dz * dz);
    if (distance < 2) return distance;
    const Vec3 look = look_direction(session.body.yaw, 0);
    const float ahead = (look.x * dx + look.z * dz) / distance;
    return distance * (1.25f - 0.25f * ahead);
}

} // namespace

bool ready(const ServerDimension& dimension, ColumnPos at) {
    const auto found = dimension.columns.find(at);
    return found != dimension.columns.end() && found->second.state == Column::State::ready;
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
    if (found == dimension.columns.end() || found->second.state != Column::State::ready || !found->second.made)
        return nullptr;
    if (!dimension.dimension.contains(origin_of(at))) return nullptr;
    dimension.dimension.put(at, std::make_shared<const Chunk>());
    const ChunkPos one[1] = {at};
    for (ChunkPos lit : relight_chunks(dimension.dimension, one).light_chunks)
        dimension.light_changed.insert(lit);
    return dimension.dimension.find(at);
}

void request_columns(ServerWorld& world) {
    for (auto& [id, dimension] : world.dimensions) {
        // Few at a time, so that the order follows the player.
        const u32 most = std::max(2u, world.pool->threads() * 24);
        if (dimension.loading >= most) continue;
        std::vector<std::pair<float, ColumnPos>> missing;
        for (const auto& session : world.sessions) {
            if (!session->joined || session->dimension() != id) continue;
            const ColumnPos here = column_of_player(*session);
            const i32 radius = i32(session->view_distance) + kLoadMargin;
            if (session->columns_complete && session->loaded_around == here && session->loaded_radius == radius)
                continue;
            bool complete = true;
            for (i32 dz = -radius; dz <= radius; ++dz)
                for (i32 dx = -radius; dx <= radius; ++dx) {
                    const ColumnPos at{i32(u32(here.x) + u32(dx)), i32(u32(here.z) + u32(dz))};
                    if (!column_in_world(at)) continue;
                    const auto found = dimension.columns.find(at);
                    if (found != dimension.columns.end()) continue;
                    complete = false;
                    missing.emplace_back(urgency(*session, at), at);
                }
            session->columns_complete = complete;
            session->loaded_around = here, session->loaded_radius = radius;
        }
        const std::size_t take = std::min<std::size_t>(most - dimension.loading, missing.size());
        std::partial_sort(missing.begin(), missing.begin() + std::ptrdiff_t(take), missing.end(),
                          [](const auto& a, const auto& b) { return a.first < b.first; });
        for (std::size_t i = 0; i < take; ++i) {
            const ColumnPos at = missing[i].second;
            if (!dimension.columns.try_emplace(at).second) continue; // two sessions want it
            ++dimension.loading;
            world.pool->submit(
                [mailbox = world.mailbox, source = world.source.get(), info = dimension.dimension.info(), at] {
                    auto column = source->load(info, at);
                    std::lock_guard lock(mailbox->mutex);
                    mailbox->columns.push_back({info.id, std::move(column), at});
                },
                i64(missing[i].first * 16));
        }
    }
}

void publish_columns(ServerWorld& world, float budget_ms) {
    const u64 start = now_ns();
    std::vector<Arrived> arrived;
    {
        std::lock_guard lock(world.mailbox->mutex);
        arrived.swap(world.mailbox->columns);
    }
    std::size_t i = 0;
    for (; i < arrived.size(); ++i) {
        if (i > 0 && seconds_since(start) * 1000 > double(budget_ms)) break;
        Arrived& a = arrived[i];
        ServerDimension& dimension = world.dimensions.at(a.dimension);
        --dimension.loading;
        auto found = dimension.columns.find(a.at);
        if (found == dimension.columns.end()) continue;
        if (!a.column) {
            log_error(fmt::format("column {} {} does not load: {}", a.at.x, a.at.z, a.column.error().message));
            // Left as never made, so that nothing is generated over what may still be read one day.
            found->second = {Column::State::ready, false, true};
            ++dimension.opened;
            continue;
        }
        ColumnData& data = *a.column;
        std::vector<ChunkPos> positions;
        for (auto& c : data.chunks) {
            positions.push_back(c.at);
            dimension.dimension.put(c.at, std::move(c.chunk));
        }
        dimension.dimension.put_heights(a.at, data.heights);
        for (ChunkPos lit : relight_chunks(dimension.dimension, positions).light_chunks)
            dimension.light_changed.insert(lit);
        found->second = {Column::State::ready, data.made, data.stored};
        ++dimension.opened;
    }
    if (i < arrived.size()) {
        std::lock_guard lock(world.mailbox->mutex);
        world.mailbox->columns.insert(world.mailbox->columns.begin(),
                                      std::make_move_iterator(arrived.begin() + std::ptrdiff_t(i)),
                                      std::make_move_iterator(arrived.end()));
    }
}

void unload_columns(ServerWorld& world) {
    for (auto& [id, dimension] : world.dimensions) {
        std::vector<ColumnPos> leave;
        for (const auto& [at, column] : dimension.columns) {
            if (column.state == Column::State::loading) continue;
            bool needed = dimension.dirty_columns.contains(at);
            for (const auto& session : world.sessions)
                needed |= session->joined && session->dimension() == id &&
                          in_range(column_of_player(*session), at, i32(session->view_distance) + kKeepMargin);
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
