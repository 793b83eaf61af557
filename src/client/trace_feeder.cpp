#include "client/trace_feeder.h"

#include "base/clock.h"

namespace vitrail::client {

TraceFeeder::TraceFeeder(trace::Tracer& tracer, const BlockRegistry& registry, const scene::PackLooks* packs)
    : tracer_(tracer)
    , pictures_(scene::BlockPictures::load(registry, packs)) {}

void TraceFeeder::take_all(const replica::Replica& replica) {
    for (const auto& [at, chunk] : replica.dimension().chunks())
        waiting_.insert(at);
}

void TraceFeeder::mark(const replica::DirtySection& dirty) {
    // Light is what is traced; biomes of neighbors tint along borders.
    if (dirty.what & (replica::kBlocksChanged | replica::kBorderBlocks | replica::kGone)) waiting_.insert(dirty.at);
}

void TraceFeeder::set_packs(const BlockRegistry& registry, const scene::PackLooks* packs) {
    pictures_ = scene::BlockPictures::load(registry, packs);
    pictures_new_ = true;
}

Result<> TraceFeeder::update(const replica::Replica& replica, SectionFeeder& sections, double budget_ms) {
    const u64 start = now_ns();
    const StateTable& states = *replica.states();
    if (pictures_new_ || states_ != states.size() || models_ != &sections.models()) {
        sections.models().ensure(states);
        states_ = states.size(), models_ = &sections.models();
        VX_TRY(tracer_.set_content(sections.models(), states, pictures_new_ ? &pictures_ : nullptr));
        pictures_new_ = false;
    }
    const Dimension& dimension = replica.dimension();
    const DimensionId id = dimension.info().id;
    u32 done = 0;
    for (auto it = waiting_.begin(); it != waiting_.end(); it = waiting_.erase(it)) {
        if (++done % 16 == 0 && seconds_since(start) * 1e3 > budget_ms) break;
        const ChunkPos at = *it;
        const ChunkPtr chunk = dimension.find(at);
        if (!chunk || (chunk->blocks.uniform() && chunk->blocks.palette()[0] == StateId::air)) {
            tracer_.set_chunk(at, id, nullptr, nullptr); // air, as where nothing is known
            continue;
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
        tracer_.set_chunk(at, id, chunk, &tints);
    }
    return {};
}

} // namespace vitrail::client
