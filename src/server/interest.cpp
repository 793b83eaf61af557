#include "server/interest.h"

#include "net/heights_codec.h"
#include "server/chunk_loading.h"
#include "voxel/chunk_codec.h"
#include "voxel/connectivity.h"

#include <algorithm>

namespace vitrail::server {

namespace {

constexpr u32 kTableSliceMost = 1024; // texts a message
constexpr u32 kSectionsAMessage = 64; // well below the format's bound, so that the first are drawn early
constexpr u32 kMessageBytesGoal = 128u << 10;
constexpr std::size_t kCellsAMessage = 100000, kDeltasAMessage = 1024;
constexpr u32 kWalkTicksLeast = 4; // between walks that only follow loading
constexpr u64 kAskingTicks = 40;   // for so long a client that asked is one that asks
constexpr u64 kUnaskedShare = 4;   // of the bytes on the way, what nobody asked for gets one in this many
constexpr i32 kSkyMargin = 4;      // sections above and below the dimension that the walk may use
constexpr u32 kParts = kChunkBlocks | kChunkLight | kChunkBiomes | kChunkRevision;
constexpr u16 kOpenSky = 15; // Light bits: full sky, no block light

const std::shared_ptr<const LightVolume>& open_sky() {
    static const auto volume = std::make_shared<const LightVolume>(Light(kOpenSky));
    return volume;
}

ServerDimension& dimension_of(ServerWorld& world, const Session& session) {
    return world.dimensions.at(session.dimension());
}

bool is_open_air(const Chunk& chunk) {
    return chunk.blocks.uniform() && chunk.blocks.palette()[0] == StateId::air && chunk.light &&
           chunk.light->uniform() && chunk.light->get(LocalPos()) == Light(kOpenSky);
}

bool within(ChunkPos p, ChunkPos center, i32 radius) {
    const i64 dx = i64(p.x) - center.x, dz = i64(p.z) - center.z;
    return dx * dx + dz * dz <= i64(radius) * radius;
}

u64 connections_of(ServerDimension& dimension, ChunkPos at, const OpaqueStates& opaque) {
    const DimensionInfo& info = dimension.dimension.info();
    if (at.y < info.min_y >> 4 || at.y >= info.max_y >> 4) return kAllConnected;
    if (const auto known = dimension.connections.find(at); known != dimension.connections.end()) return known->second;
    const ChunkPtr chunk = dimension.dimension.find(at);
    if (!chunk) return ready(dimension, column_of(at)) ? kAllConnected : 0;
    return dimension.connections.emplace(at, face_connections(chunk->blocks, opaque)).first->second;
}

void let_go_beyond(Session& session, ChunkPos here) {
    const i32 radius = i32(session.view_distance) + 2;
    net::SectionsGone gone{u32(session.dimension()), {}};
    for (auto it = session.held.begin(); it != session.held.end();) {
        if (within(it->first, here, radius)) {
            ++it;
            continue;
        }
        gone.at.push_back(net::to_wire(it->first));
        it = session.held.erase(it);
        if (gone.at.size() == 4096) {
            send(session, net::Channel::world, gone);
            gone.at.clear();
        }
    }
    if (!gone.at.empty()) send(session, net::Channel::world, gone);
    std::erase_if(session.heights_told, [&](ColumnPos c) { return !within(ChunkPos{c.x, 0, c.z}, here, radius); });
}

net::WireHeights wire_heights(ColumnPos at, const ColumnHeights& heights) {
    return {at.x, at.z, net::pack_heights(heights)};
}

net::WireSection wire_section(const ServerDimension& dimension, ChunkPos at, const Chunk& chunk) {
    return {net::to_wire(at), chunk.revision, encode_chunk(surface_of(dimension, at, chunk), kParts)};
}

// One section whole, at once: what replaces an air notice.
void send_one_section(ServerDimension& dimension, Session& session, ChunkPos at, const Chunk& chunk) {
    net::Sections message{u32(session.dimension()), {}};
    message.sections.push_back(wire_section(dimension, at, chunk));
    const u64 bytes = message.sections[0].chunk.size();
    session.held[at] = {chunk.revision, chunk.light, false};
    send(session, net::Channel::world, message);
    session.bytes_sent += bytes;
}

} // namespace

OpaqueStates opaque_states(const StateTable& states) {
    return {states.flags_data(), kOpaqueCube};
}

StateId state_for_surface(const ServerDimension& dimension, BlockPos at) {
    const DimensionInfo& info = dimension.dimension.info();
    if (at.y < info.min_y || !in_world(at)) return StateId::hidden;
    if (at.y >= info.max_y) return StateId::air;
    if (const ChunkPtr chunk = dimension.dimension.find(chunk_of(at))) return chunk->blocks.get(local_of(at));
    const auto found = dimension.columns.find(column_of(chunk_of(at)));
    return found != dimension.columns.end() && found->second.made ? StateId::air : StateId::hidden;
}

Chunk surface_of(const ServerDimension& dimension, ChunkPos at, const Chunk& chunk) {
    static const Chunk air;
    std::array<ChunkPtr, 6> kept;
    std::array<const Chunk*, 6> around{};
    for (u32 f = 0; f < 6; ++f) {
        const ChunkPos p = neighbor(at, Face(f));
        kept[f] = dimension.dimension.find(p);
        if (kept[f])
            around[f] = kept[f].get();
        else if (state_for_surface(dimension, origin_of(p)) == StateId::air)
            around[f] = &air;
    }
    return make_surface_chunk(chunk, around, opaque_states(dimension.dimension.states()), true);
}

void tell_tables(ServerWorld& world, Session& session) {
    const StateTable& states = world.states();
    while (session.states_told < states.size()) {
        net::StateTexts message{session.states_told, {}};
        while (session.states_told < states.size() && message.texts.size() < kTableSliceMost)
            message.texts.push_back(states.info(StateId(session.states_told++)).state.to_string());
        send(session, net::Channel::world, message);
    }
    if (session.biomes_told < world.biomes().size()) {
        const std::vector<std::string> names = world.biomes().names();
        while (session.biomes_told < names.size()) {
            net::BiomeTexts message{session.biomes_told, {}};
            while (session.biomes_told < names.size() && message.texts.size() < kTableSliceMost)
                message.texts.push_back(names[session.biomes_told++]);
            send(session, net::Channel::world, message);
        }
    }
}

void update_interest(ServerWorld& world, Session& session) {
    ServerDimension& dimension = dimension_of(world, session);
    const DimensionInfo& info = dimension.dimension.info();
    const i32 low = (info.min_y >> 4) - kSkyMargin, high = (info.max_y >> 4) - 1 + kSkyMargin;
    auto section_of = [&](WorldPos p) {
        ChunkPos c = chunk_of(block_of(p));
        c.y = std::clamp(c.y, low, high);
        return c;
    };
    const ChunkPos eye = section_of(eye_of(session.body)), feet = section_of(session.body.feet.at);
    const bool moved = !(eye == session.walked_from) || !(feet == session.walked_feet);
    const bool opened =
        dimension.opened != session.walked_opened && world.tick >= session.walked_tick + kWalkTicksLeast;
    if (!moved && !opened && !session.walk_again) return;
    if (moved || session.walk_again) let_go_beyond(session, eye);
    session.walked_from = eye, session.walked_feet = feet;
    session.walked_opened = dimension.opened, session.walked_tick = world.tick, session.walk_again = false;

    const OpaqueStates opaque = opaque_states(world.states());
    const i32 radius = i32(session.view_distance);
    auto lookup = [&](ChunkPos at) -> u64 {
        return within(at, eye, radius + 1) ? connections_of(dimension, at, opaque) : 0;
    };
    const i32 edge = kWorldEdge / kChunkSize;
    const SectionBounds bounds{{std::max(eye.x - radius, -edge), low, std::max(eye.z - radius, -edge)},
                               {std::min(eye.x + radius, edge - 1), high, std::min(eye.z + radius, edge - 1)}};
    std::vector<ChunkPos> reached = reachable_sections(eye, lookup, bounds);
    if (!(feet == eye)) {
        // A body may touch what its eye does not see.
        const std::vector<ChunkPos> more = reachable_sections(feet, lookup, bounds);
        reached.insert(reached.end(), more.begin(), more.end());
    }
    session.wanted.clear();
    session.wanted_asked = 0, session.asked_changed = true;
    for (ChunkPos at : reached) {
        if (at.y < info.min_y >> 4 || at.y >= info.max_y >> 4 || session.held.contains(at)) continue;
        if (within(at, eye, radius + 1)) session.wanted.push_back(at);
    }
}

void take_asks(const ServerWorld& world, Session& session, const net::AskSections& asked) {
    if (asked.dimension != u32(session.dimension())) return;
    session.asked.clear();
    for (const net::WireChunkPos& wire : asked.at) {
        const ChunkPos at = net::from_wire(wire);
        if (within(at, session.walked_from, i32(session.view_distance) + 2)) session.asked.push_back(at);
    }
    session.asked_changed = true;
    session.asked_tick = world.tick;
}

// Those of the wanted that were asked for to the front, in the order asked.
static void put_asked_first(Session& session) {
    session.asked_changed = false;
    session.wanted_asked = 0;
    if (session.asked.empty()) return;
    std::unordered_map<ChunkPos, u32> place;
    for (ChunkPos at : session.asked)
        place.try_emplace(at, u32(place.size()));
    std::vector<ChunkPos> first;
    std::deque<ChunkPos> rest;
    for (ChunkPos at : session.wanted)
        place.contains(at) ? first.push_back(at) : rest.push_back(at);
    std::sort(first.begin(), first.end(), [&](ChunkPos a, ChunkPos b) { return place.at(a) < place.at(b); });
    rest.insert(rest.begin(), first.begin(), first.end());
    session.wanted = std::move(rest);
    session.wanted_asked = first.size();
}

void send_sections(ServerWorld& world, Session& session) {
    if (session.wanted.empty()) return;
    if (session.asked_changed) put_asked_first(session);
    const bool asks = session.asked_tick != 0 && world.tick - session.asked_tick < kAskingTicks;
    ServerDimension& dimension = dimension_of(world, session);
    net::Sections sections{u32(session.dimension()), {}};
    net::AirSections air{u32(session.dimension()), {}};
    net::HeightsOfColumns heights{u32(session.dimension()), {}};
    u64 message_bytes = 0, tick_bytes = 0;
    auto flush = [&] {
        if (!heights.columns.empty()) send(session, net::Channel::world, heights);
        if (!air.at.empty()) send(session, net::Channel::world, air);
        if (!sections.sections.empty()) send(session, net::Channel::world, sections);
        heights.columns.clear(), air.at.clear(), sections.sections.clear();
        message_bytes = 0;
    };
    std::unordered_map<ColumnPos, bool> settled;
    tell_tables(world, session);
    while (!session.wanted.empty() && !session.gone) {
        // What is asked for later must not stand in line behind what nobody asked for.
        const u64 on_the_way_most =
            world.options.bytes_in_flight_most / (asks && session.wanted_asked == 0 ? kUnaskedShare : 1);
        if (tick_bytes >= world.options.bytes_a_tick_most ||
            session.bytes_sent - session.bytes_acknowledged >= on_the_way_most)
            break;
        const ChunkPos at = session.wanted.front();
        session.wanted.pop_front();
        if (session.wanted_asked > 0) --session.wanted_asked;
        if (session.held.contains(at)) continue;
        const ColumnPos column = column_of(at);
        const auto [known, fresh] = settled.try_emplace(column, false);
        if (fresh) known->second = surrounded(dimension, column);
        if (!known->second) continue; // found again when its neighbors are there
        const ChunkPtr chunk = dimension.dimension.find(at);
        if (!chunk && !dimension.columns.at(column).made) continue;
        if (session.heights_told.insert(column).second)
            if (const ColumnHeights* h = dimension.dimension.heights(column))
                heights.columns.push_back(wire_heights(column, *h));
        if (!chunk || is_open_air(*chunk)) {
            air.at.push_back(net::to_wire(at));
            session.held[at] = {chunk ? chunk->revision : 0, open_sky(), true};
            tick_bytes += 8;
        } else {
            net::WireSection section = wire_section(dimension, at, *chunk);
            const u64 bytes = section.chunk.size();
            sections.sections.push_back(std::move(section));
            session.held[at] = {chunk->revision, chunk->light, false};
            session.bytes_sent += bytes, tick_bytes += bytes + 16, message_bytes += bytes;
            ++world.stats.sections_sent;
            world.stats.bytes_sent += bytes;
        }
        if (sections.sections.size() >= kSectionsAMessage || message_bytes >= kMessageBytesGoal ||
            air.at.size() >= 2048 || heights.columns.size() >= 128)
            flush();
    }
    flush();
}

void tell_block_changes(ServerWorld& world, ServerDimension& dimension, const ChangeSet& changes) {
    if (changes.blocks.empty()) return;
    const OpaqueStates opaque = opaque_states(world.states());
    bool opened = false;
    for (ChunkPos at : changes.block_chunks) {
        dimension.heights_changed.insert(column_of(at));
        const auto cached = dimension.connections.find(at);
        if (cached == dimension.connections.end()) continue;
        const ChunkPtr chunk = dimension.dimension.find(at);
        const u64 now = chunk ? face_connections(chunk->blocks, opaque) : kAllConnected;
        opened |= now != cached->second;
        cached->second = now;
    }
    if (opened) ++dimension.opened;

    const std::vector<Edit> edits = surface_edits(
        changes, [&](BlockPos p) { return state_for_surface(dimension, p); }, opaque);
    std::vector<net::WireChunkDelta> deltas;
    std::unordered_map<ChunkPos, std::size_t> index;
    for (const Edit& e : edits) {
        const ChunkPos at = chunk_of(e.at);
        const auto [entry, fresh] = index.try_emplace(at, deltas.size());
        if (fresh) {
            const ChunkPtr chunk = dimension.dimension.find(at);
            deltas.push_back({net::to_wire(at), chunk ? chunk->revision : 0, {}, {}});
        }
        deltas[entry->second].cells.push_back(local_of(e.at).index);
        deltas[entry->second].values.push_back(u32(e.state));
    }
    for (auto& session : world.sessions) {
        if (!session->joined || session->gone || session->dimension() != dimension.dimension.info().id) continue;
        session->walk_again |= opened;
        tell_tables(world, *session);
        net::BlockChanges message{u32(session->dimension()), {}};
        std::size_t cells = 0;
        for (const auto& delta : deltas) {
            const ChunkPos at = net::from_wire(delta.at);
            const auto held = session->held.find(at);
            if (held == session->held.end()) continue;
            if (held->second.air_notice) {
                if (const ChunkPtr chunk = dimension.dimension.find(at))
                    send_one_section(dimension, *session, at, *chunk);
                continue;
            }
            held->second.revision = delta.revision;
            message.chunks.push_back(delta);
            cells += delta.cells.size();
            if (cells > kCellsAMessage || message.chunks.size() >= kDeltasAMessage) {
                send(*session, net::Channel::world, message);
                message.chunks.clear(), cells = 0;
            }
        }
        if (!message.chunks.empty()) send(*session, net::Channel::world, message);
    }
}

namespace {

net::WireChunkDelta light_delta(ChunkPos at, const Chunk& chunk, const LightVolume* before) {
    static const LightVolume dark;
    const LightVolume& a = before ? *before : dark;
    const LightVolume& b = chunk.light ? *chunk.light : dark;
    net::WireChunkDelta delta{net::to_wire(at), chunk.revision, {}, {}};
    for (u32 i = 0; i < u32(kChunkVolume); ++i) {
        const Light now = b.get(LocalPos(i));
        if (a.get(LocalPos(i)) == now) continue;
        delta.cells.push_back(u16(i));
        delta.values.push_back(now.bits);
    }
    return delta;
}

} // namespace

void tell_light_changes(ServerWorld& world) {
    for (auto& [id, dimension] : world.dimensions) {
        if (dimension.light_changed.empty() && dimension.heights_changed.empty()) continue;
        for (auto& session : world.sessions) {
            if (!session->joined || session->gone || session->dimension() != id) continue;
            net::HeightsOfColumns heights{u32(id), {}};
            auto flush_heights = [&] {
                if (!heights.columns.empty()) send(*session, net::Channel::world, heights);
                heights.columns.clear();
            };
            for (ColumnPos at : dimension.heights_changed) {
                const ColumnHeights* h = session->heights_told.contains(at) ? dimension.dimension.heights(at) : nullptr;
                if (h) heights.columns.push_back(wire_heights(at, *h));
                if (heights.columns.size() == 256) flush_heights();
            }
            flush_heights();
            net::LightChanges message{u32(id), {}};
            std::size_t cells = 0;
            for (ChunkPos at : dimension.light_changed) {
                const auto held = session->held.find(at);
                if (held == session->held.end()) continue;
                const ChunkPtr chunk = dimension.dimension.find(at);
                if (!chunk || chunk->light == held->second.light) continue;
                net::WireChunkDelta delta = light_delta(at, *chunk, held->second.light.get());
                if (delta.cells.empty()) {
                    held->second.light = chunk->light;
                    continue;
                }
                if (held->second.air_notice) {
                    send_one_section(dimension, *session, at, *chunk);
                    continue;
                }
                held->second.light = chunk->light;
                held->second.revision = chunk->revision;
                cells += delta.cells.size();
                message.chunks.push_back(std::move(delta));
                if (cells > kCellsAMessage || message.chunks.size() >= kDeltasAMessage) {
                    send(*session, net::Channel::world, message);
                    message.chunks.clear(), cells = 0;
                }
            }
            if (!message.chunks.empty()) send(*session, net::Channel::world, message);
        }
        dimension.light_changed.clear();
        dimension.heights_changed.clear();
    }
}

} // namespace vitrail::server
