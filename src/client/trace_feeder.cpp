#include "client/trace_feeder.h"

#include "base/clock.h"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

namespace vitrail::client {

namespace {

constexpr std::size_t kChunksBetweenClocks = 16;

i64 distance_squared(ChunkPos a, ChunkPos b) {
    const i64 x = i64(a.x) - b.x, y = i64(a.y) - b.y, z = i64(a.z) - b.z;
    return x * x + y * y + z * z;
}

} // namespace

TraceFeeder::TraceFeeder(trace::Tracer& tracer)
    : tracer_(tracer) {}

void TraceFeeder::take_all(const replica::Replica& replica) {
    for (const auto& [at, chunk] : replica.dimension().chunks())
        waiting_.insert(at);
}

void TraceFeeder::mark(const replica::DirtySection& dirty) {
    // Light is what is traced; biomes of neighbors tint along borders.
    if (dirty.what & (replica::kBlocksChanged | replica::kBorderBlocks | replica::kGone)) waiting_.insert(dirty.at);
}

void TraceFeeder::set_packs(const BlockRegistry& registry, const scene::PackLooks* packs) {
    set_pictures(scene::BlockPictures::load(registry, packs));
}

void TraceFeeder::set_pictures(scene::BlockPictures pictures) {
    pictures_ = std::move(pictures);
    pictures_new_ = true;
}

void TraceFeeder::give(const replica::Replica& replica, const SectionFeeder& sections, ChunkPos at) {
    const Dimension& dimension = replica.dimension();
    const ChunkPtr chunk = dimension.find(at);
    if (!chunk || (chunk->blocks.uniform() && chunk->blocks.palette()[0] == StateId::air)) {
        tracer_.set_chunk(at, *dimension_, nullptr, nullptr); // air, as where nothing is known
        return;
    }
    std::array<ChunkPtr, 9> around;
    std::array<const Chunk*, 9> plain{};
    for (i32 dz = -1; dz <= 1; ++dz)
        for (i32 dx = -1; dx <= 1; ++dx) {
            const std::size_t k = std::size_t((dx + 1) + 3 * (dz + 1));
            around[k] = dimension.find({at.x + dx, at.y, at.z + dz});
            plain[k] = around[k].get();
        }
    const scene::TintGrid tints = scene::build_tint_grid(plain, sections.tints());
    tracer_.set_chunk(at, *dimension_, chunk, &tints);
}

Result<> TraceFeeder::update(const replica::Replica& replica, SectionFeeder& sections, BlockPos eye, double budget_ms,
                             std::size_t most) {
    const u64 start = now_ns();
    if (const DimensionId now = replica.dimension().info().id; dimension_ != now) {
        if (dimension_) {
            tracer_.clear();
            waiting_.clear();
            take_all(replica);
        }
        dimension_ = now;
    }
    const StateTable& states = *replica.states();
    if (pictures_new_ || states_ != states.size() || models_ != &sections.models()) {
        sections.models().ensure(states);
        states_ = states.size(), models_ = &sections.models();
        VX_TRY(tracer_.set_content(sections.models(), states, pictures_new_ ? &pictures_ : nullptr));
        pictures_ = {};
        pictures_new_ = false;
    }
    if (waiting_.empty()) return {};
    const ChunkPos center = chunk_of(eye);
    std::vector<std::pair<i64, ChunkPos>> nearest;
    nearest.reserve(waiting_.size());
    for (ChunkPos at : waiting_)
        nearest.emplace_back(-distance_squared(at, center), at);
    const auto farther = [](const auto& a, const auto& b) { return a.first < b.first; };
    std::make_heap(nearest.begin(), nearest.end(), farther);
    for (std::size_t done = 0; !nearest.empty() && done < most; ++done) {
        if (done > 0 && done % kChunksBetweenClocks == 0 && seconds_since(start) * 1e3 > budget_ms) break;
        std::pop_heap(nearest.begin(), nearest.end(), farther);
        const ChunkPos at = nearest.back().second;
        nearest.pop_back();
        waiting_.erase(at);
        give(replica, sections, at);
    }
    return {};
}

} // namespace vitrail::client
