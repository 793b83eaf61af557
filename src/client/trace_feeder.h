// TraceFeeder: keeps a tracer's chunks and looks equal to the replica's world. SectionFeeder tells what changed (it
// takes the replica's list) and lends models and tints.
//
//     TraceFeeder feeder(tracer);
//     feeder.set_packs(registry, packs);                 // or set_pictures, read elsewhere
//     feeder.take_all(replica);                          // once: what is here already
//     sections.on_dirty([&](auto& d) { feeder.mark(d); });
//     each frame, after sections.update: feeder.update(replica, sections, eye, budget_ms);
#pragma once

#include "client/section_feeder.h"
#include "scene/block_pictures.h"
#include "trace/tracer.h"

#include <optional>
#include <unordered_set>

namespace vitrail::client {

class TraceFeeder {
public:
    explicit TraceFeeder(trace::Tracer& tracer);

    void take_all(const replica::Replica& replica);
    void mark(const replica::DirtySection& dirty);
    // Looks are read again, from these packs (null: none).
    void set_packs(const BlockRegistry& registry, const scene::PackLooks* packs);
    void set_pictures(scene::BlockPictures pictures);
    // Gives chunks to the tracer, nearest to the eye first, for about budget_ms and at most `most` of them, but some.
    // Errors: the tracer's.
    Result<> update(const replica::Replica& replica, SectionFeeder& sections, BlockPos eye, double budget_ms,
                    std::size_t most = std::size_t(-1));
    bool settled() const { return waiting_.empty(); }
    std::size_t waiting() const { return waiting_.size(); }

private:
    void give(const replica::Replica& replica, const SectionFeeder& sections, ChunkPos at);

    trace::Tracer& tracer_;
    scene::BlockPictures pictures_; // until the tracer has them
    bool pictures_new_ = false;
    const scene::BlockModels* models_ = nullptr; // of the last update
    u32 states_ = 0;
    std::optional<DimensionId> dimension_;
    std::unordered_set<ChunkPos> waiting_;
};

} // namespace vitrail::client
