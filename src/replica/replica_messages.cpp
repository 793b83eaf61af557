// What the server tells, taken in one function a message. Everything is checked: a server is outside, too.
#include "base/clock.h"
#include "net/heights_codec.h"
#include "net/registry_codec.h"
#include "replica/replica.h"
#include "voxel/chunk_codec.h"

#include <algorithm>
#include <fmt/format.h>

namespace vitrail::replica {

namespace {

constexpr u32 kSectionBytesMost = 1u << 20; // decompressed
constexpr std::size_t kNoticesMost = 1000;
constexpr std::size_t kSectionsMost = 400000; // far above any view: a server must not fill this machine's memory

bool sound(const DimensionInfo& info) {
    return info.min_y < info.max_y && info.min_y % 16 == 0 && info.max_y % 16 == 0 && info.min_y >= -kWorldEdge &&
           info.max_y <= kWorldEdge && i64(info.max_y) - info.min_y <= 65536;
}

double seconds_now() {
    return double(now_ns()) * 1e-9;
}

} // namespace

bool Replica::poll(std::size_t most) {
    if (lost_) return false;
    const bool open = transport_->open();
    transport_->poll([&](net::Channel, ByteView bytes) { hear(bytes); }, most);
    if (!open && !lost_) lose("the connection is closed");
    if (unsettled_ && !lost_) settle();
    if (section_bytes_ != section_bytes_told_ && !lost_) {
        send(net::Channel::control, net::SectionAck{section_bytes_});
        section_bytes_told_ = section_bytes_;
    }
    return !lost_;
}

void Replica::hear(ByteView bytes) {
    if (lost_) return;
    ++stats_.messages;
    stats_.bytes += bytes.size();
    auto message = net::decode_server_message(bytes);
    if (!message) return lose(fmt::format("bad message from the server: {}", message.error().message));
    if (!joined() &&
        (message->index() > 1 && !std::holds_alternative<net::Goodbye>(*message) &&
         !std::holds_alternative<net::Notice>(*message) && !std::holds_alternative<net::TimeOfDay>(*message) &&
         !std::holds_alternative<net::BodyState>(*message)))
        return lose("the server speaks of a world before its welcome");
    auto taken = std::visit([&](auto& m) { return take(m); }, *message);
    if (!taken) lose(fmt::format("bad message from the server: {}", taken.error().message));
}

Result<> Replica::take(net::RegistryData& message) {
    if (joined()) return fail(ErrorCode::damaged, "content changed in the middle of a session");
    VX_TRY_ASSIGN(auto registry, net::decode_registry(message.data));
    // Texture folders are this machine's own.
    if (options_.registry) registry->content_roots = options_.registry->content_roots;
    registry_ = std::move(registry);
    registry_told_ = true;
    return {};
}

Result<> Replica::take(net::Welcome& message) {
    if (joined()) return fail(ErrorCode::damaged, "welcomed twice");
    if (!registry_told_) {
        if (!options_.registry || net::registry_hash(*options_.registry) != message.content_hash)
            return fail(ErrorCode::damaged, "the server did not send its content");
        registry_ = options_.registry;
    }
    for (auto& d : message.dimensions) {
        DimensionInfo info{DimensionId(d.id), std::move(d.name), d.min_y, d.max_y, d.has_sky, d.sea_level};
        if (!sound(info)) return fail(ErrorCode::damaged, "a dimension has impossible bounds");
        dimensions_.push_back(std::move(info));
    }
    const auto here = std::find_if(dimensions_.begin(), dimensions_.end(),
                                   [&](const DimensionInfo& d) { return u32(d.id) == message.body.dimension; });
    if (here == dimensions_.end()) return fail(ErrorCode::damaged, "the player is in no dimension");
    states_ = std::make_shared<StateTable>(registry_);
    own_states_ = {StateId::air, StateId::hidden};
    dimension_ = std::make_unique<Dimension>(*here, states_);
    auto air = std::make_shared<Chunk>();
    air->light = std::make_shared<const LightVolume>(Light(15, 0, 0, 0));
    open_air_ = std::move(air);
    place_body(message.body);
    view_distance_ = message.view_distance;
    hotbar_ = std::move(message.hotbar);
    hotbar_selected_ = message.hotbar_selected;
    day_clock_.hear(u64(message.day) * kDayTicks + message.time_of_day, message.day_minutes, seconds_now());
    seed_ = message.seed;
    return {};
}

Result<> Replica::take(net::StateTexts& message) {
    if (message.first != own_states_.size()) return fail(ErrorCode::damaged, "state texts with a gap");
    for (const std::string& text : message.texts) {
        VX_TRY_ASSIGN(const BlockState state, parse_block_state(text));
        VX_TRY_ASSIGN(const StateId id, states_->intern(state));
        own_states_.push_back(id);
    }
    return {};
}

Result<> Replica::take(net::BiomeTexts& message) {
    if (message.first != biomes_.size()) return fail(ErrorCode::damaged, "biome texts with a gap");
    for (const std::string& name : message.texts) {
        const u32 before = biomes_.size();
        VX_TRY_ASSIGN(const BiomeId id, biomes_.intern(name));
        if (u32(id) != before) return fail(ErrorCode::damaged, "a biome comes twice");
    }
    return {};
}

Result<StateId> Replica::own_state(u32 server_id) const {
    if (server_id >= own_states_.size()) return fail(ErrorCode::damaged, "a block state without a text");
    return own_states_[server_id];
}

Result<> Replica::check_dimension(u32 id) const {
    if (DimensionId(id) != dimension_->info().id) return fail(ErrorCode::damaged, "sections of another dimension");
    return {};
}

Result<> Replica::take(net::Sections& message) {
    VX_TRY(check_dimension(message.dimension));
    if (dimension_->chunks().size() > kSectionsMost) return fail(ErrorCode::limit, "too many sections");
    for (const net::WireSection& section : message.sections) {
        const ChunkPos at = net::from_wire(section.at);
        if (!in_world(at) || !dimension_->contains(origin_of(at)))
            return fail(ErrorCode::damaged, "a section outside the world");
        VX_TRY_ASSIGN(Chunk chunk,
                      decode_chunk(section.chunk, {u32(own_states_.size()), biomes_.size(), kSectionBytesMost}));
        std::vector<StateId> palette(chunk.blocks.palette().begin(), chunk.blocks.palette().end());
        bool same = true;
        for (StateId& id : palette) {
            const StateId own = own_states_[u32(id)];
            same &= own == id;
            id = own;
        }
        if (!same) {
            std::array<u16, kChunkVolume> indices;
            chunk.blocks.unpack_indices(indices);
            chunk.blocks = BlockStorage::from_indices(palette, indices);
        }
        if (!chunk.light) chunk.light = std::make_shared<const LightVolume>();
        chunk.block_entities.clear(), chunk.ticks.clear(), chunk.entities.clear();
        chunk.revision = section.revision;
        section_bytes_ += section.chunk.size();
        ++stats_.sections;
        put_server_chunk(at, std::make_shared<const Chunk>(std::move(chunk)));
    }
    return {};
}

Result<> Replica::take(net::AirSections& message) {
    VX_TRY(check_dimension(message.dimension));
    if (dimension_->chunks().size() > kSectionsMost) return fail(ErrorCode::limit, "too many sections");
    for (const net::WireChunkPos& p : message.at) {
        const ChunkPos at = net::from_wire(p);
        if (!in_world(at) || !dimension_->contains(origin_of(at)))
            return fail(ErrorCode::damaged, "a section outside the world");
        ++stats_.sections;
        put_server_chunk(at, open_air_);
    }
    return {};
}

Result<> Replica::take(net::SectionsGone& message) {
    VX_TRY(check_dimension(message.dimension));
    std::unordered_set<ColumnPos> columns;
    for (const net::WireChunkPos& p : message.at) {
        const ChunkPos at = net::from_wire(p);
        server_chunks_.erase(at);
        if (!dimension_->find(at)) continue;
        dimension_->erase(at);
        mark(at, kGone);
        columns.insert(column_of(at));
    }
    // The server tells heights again with a column's first section, so those of columns left behind would only grow.
    const DimensionInfo& info = dimension_->info();
    for (const ColumnPos at : columns) {
        bool held = server_heights_.contains(at);
        for (i32 y = info.min_y >> 4; y < info.max_y >> 4 && !held; ++y)
            held = dimension_->find({at.x, y, at.z}) != nullptr;
        if (!held) dimension_->erase_heights(at);
    }
    return {};
}

Result<> Replica::take(net::HeightsOfColumns& message) {
    VX_TRY(check_dimension(message.dimension));
    for (const net::WireHeights& h : message.columns) {
        VX_TRY_ASSIGN(const ColumnHeights heights, net::unpack_heights(h.packed));
        const ColumnPos at{h.x, h.z};
        if (!in_world(ChunkPos{at.x, 0, at.z})) return fail(ErrorCode::damaged, "a column outside the world");
        const auto kept = server_heights_.find(at);
        if (kept == server_heights_.end())
            dimension_->put_heights(at, heights);
        else
            kept->second = heights, unsettled_ = true;
    }
    return {};
}

Result<> Replica::take(net::BlockChanges& message) {
    VX_TRY(check_dimension(message.dimension));
    for (const net::WireChunkDelta& delta : message.chunks) {
        const ChunkPos at = net::from_wire(delta.at);
        const ChunkPtr base = server_chunk(at);
        if (!base) return fail(ErrorCode::damaged, "changes of a section that was not sent");
        auto chunk = std::make_shared<Chunk>(*base);
        for (std::size_t i = 0; i < delta.cells.size(); ++i) {
            VX_TRY_ASSIGN(const StateId id, own_state(delta.values[i]));
            chunk->blocks.set(LocalPos(delta.cells[i]), id);
        }
        chunk->revision = delta.revision;
        put_server_chunk(at, std::move(chunk));
    }
    return {};
}

Result<> Replica::take(net::LightChanges& message) {
    VX_TRY(check_dimension(message.dimension));
    for (const net::WireChunkDelta& delta : message.chunks) {
        const ChunkPos at = net::from_wire(delta.at);
        const ChunkPtr base = server_chunk(at);
        if (!base) return fail(ErrorCode::damaged, "light of a section that was not sent");
        auto light = std::make_shared<LightVolume>(*base->light);
        for (std::size_t i = 0; i < delta.cells.size(); ++i)
            light->set(LocalPos(delta.cells[i]), Light(u16(delta.values[i])));
        light->compact();
        auto chunk = std::make_shared<Chunk>(*base);
        chunk->light = std::move(light);
        chunk->revision = delta.revision;
        put_server_chunk(at, std::move(chunk));
    }
    return {};
}

Result<> Replica::take(net::EditResult& message) {
    answers_.push_back({message.sequence, message.outcome, std::move(message.reason)});
    if (message.outcome == net::EditOutcome::kept) return {};
    const auto pending = std::find_if(pending_.begin(), pending_.end(),
                                      [&](const PendingEdit& p) { return p.sequence == message.sequence; });
    if (pending == pending_.end()) return fail(ErrorCode::damaged, "an answer to no request");
    pending_.erase(pending);
    unsettled_ = true;
    return {};
}

Result<> Replica::take(net::TimeOfDay& message) {
    day_clock_.hear(u64(message.day) * kDayTicks + message.time_of_day, message.day_minutes, seconds_now());
    return {};
}

Result<> Replica::take(net::Notice& message) {
    if (notices_.size() < kNoticesMost) notices_.push_back(std::move(message));
    return {};
}

Result<> Replica::take(net::Goodbye& message) {
    lose(message.reason.empty() ? "the server ended the session" : message.reason);
    return {};
}

double Replica::day_ticks() const {
    return day_clock_.ticks(seconds_now());
}

float Replica::time_of_day() const {
    return float(std::fmod(day_ticks(), double(kDayTicks)));
}

} // namespace vitrail::replica
