// SectionFeeder: keeps the renderer's sections equal to the replica's world. Dirty sections are meshed by workers from
// snapshots, nearest first, and uploaded on the main thread within a budget, so that no frame waits for a burst.
//
//     SectionFeeder feeder(renderer, pool);
//     each frame: feeder.update(replica, eye, budget_ms);
//     a still picture: while (!feeder.settled()) feeder.update(...);
#pragma once

#include "jobs/thread_pool.h"
#include "render/meshing/light_brick.h"
#include "render/meshing/mesher.h"
#include "render/renderer.h"
#include "replica/replica.h"
#include "scene/block_model.h"

#include <memory>
#include <mutex>
#include <unordered_map>
#include <vector>

namespace vitrail::client {

struct FeederStats {
    u32 waiting = 0, in_flight = 0;
    u64 meshed = 0, uploaded = 0, quads = 0;
};

class SectionFeeder {
public:
    SectionFeeder(render::Renderer& renderer, ThreadPool& pool);
    ~SectionFeeder(); // waits for its jobs
    SectionFeeder(const SectionFeeder&) = delete;
    SectionFeeder& operator=(const SectionFeeder&) = delete;

    // Takes the replica's dirty sections, starts jobs nearest to `eye` first, uploads what is ready for at most
    // budget_ms (but at least one section, so that it always goes on).
    void update(replica::Replica& replica, BlockPos eye, double budget_ms);
    // Nothing waits, runs or lies ready.
    bool settled() const;
    FeederStats stats() const;
    const scene::BlockModels& models() const { return models_; }
    scene::BlockModels& models() { return models_; }

private:
    struct Section {
        bool mesh = false, light = false; // what waits to be done
        bool in_flight = false;
        u64 dirty_since_ns = 0;
    };
    struct Answer {
        ChunkPos at;
        bool has_mesh = false, light_needed = false;
        render::SectionMesh mesh;
        std::unique_ptr<render::LightBrick> brick;
        render::TintGrid tints;
    };
    struct Shared { // outlives the feeder where a job is late
        std::mutex mutex;
        std::vector<Answer> ready;
    };
    void mark(ChunkPos at, bool mesh, u64 now);
    void start_jobs(replica::Replica& replica, BlockPos eye, u64 now);
    void upload(const Answer& answer);

    render::Renderer& renderer_;
    ThreadPool& pool_;
    scene::BlockModels models_;
    std::vector<render::BiomeTint> tints_; // by BiomeId
    std::unordered_map<ChunkPos, Section> sections_;
    std::shared_ptr<Shared> shared_ = std::make_shared<Shared>();
    std::vector<Answer> taken_;
    DimensionId dimension_{};
    u32 waiting_ = 0, in_flight_ = 0;
    u64 meshed_ = 0, uploaded_ = 0;
};

} // namespace vitrail::client
