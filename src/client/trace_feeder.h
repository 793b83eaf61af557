// TraceFeeder: keeps a tracer's chunks and looks equal to the replica's world. SectionFeeder tells what changed (it
// takes the replica's list) and lends models and tints.
//
//     TraceFeeder feeder(tracer, registry, packs);
//     feeder.take_all(replica);                          // once: what is here already
//     sections.on_dirty([&](auto& d) { feeder.mark(d); });
//     each frame, after sections.update: feeder.update(replica, sections, budget_ms);
#pragma once

#include "client/section_feeder.h"
#include "scene/block_pictures.h"
#include "trace/tracer.h"

#include <unordered_set>

namespace vitrail::client {

class TraceFeeder {
public:
    TraceFeeder(trace::Tracer& tracer, const BlockRegistry& registry, const scene::PackLooks* packs);

    void take_all(const replica::Replica& replica);
    void mark(const replica::DirtySection& dirty);
    // Other packs: looks are read again.
    void set_packs(const BlockRegistry& registry, const scene::PackLooks* packs);
    // Gives chunks to the tracer for about budget_ms, at least one. Errors: the tracer's.
    Result<> update(const replica::Replica& replica, SectionFeeder& sections, double budget_ms);
    bool settled() const { return waiting_.empty(); }
    std::size_t waiting() const { return waiting_.size(); }

private:
    trace::Tracer& tracer_;
    scene::BlockPictures pictures_;
    bool pictures_new_ = true;
    const scene::BlockModels* models_ = nullptr; // of the last update
    u32 states_ = 0;
    std::unordered_set<ChunkPos> waiting_;
};

} // namespace vitrail::client
