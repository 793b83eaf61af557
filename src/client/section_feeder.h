// SectionFeeder: keeps the renderer's sections equal to the replica's world. Dirty sections are meshed by workers from
// snapshots, nearest first, and uploaded on the main thread within a budget, so that no frame waits for a burst.
//
// Sections of air need no job. As many sections are given to the workers as they make in a frame, so that slow frames do
// not leave them idle while land comes in.
//
//     SectionFeeder feeder(renderer, pool);
//     each frame: feeder.update(replica, eye, feed_budget_ms(seconds));
//     a still picture: while (!feeder.settled()) feeder.update(...);
#pragma once

#include "jobs/thread_pool.h"
#include "render/meshing/light_brick.h"
#include "render/meshing/mesher.h"
#include "render/renderer.h"
#include "replica/replica.h"
#include "scene/block_model.h"
#include "scene/pack_looks.h"

#include <functional>
#include <memory>
#include <mutex>
#include <unordered_map>
#include <vector>

namespace vitrail::client {

// Milliseconds that `update` may take in a frame, after one of `frame_seconds`: little, but of slow frames a share, else
// land would come the slower the slower the machine draws.
double feed_budget_ms(double frame_seconds);

struct FeederStats {
    u32 waiting = 0, in_flight = 0;
    u32 in_flight_most = 0;               // as of now; follows what the workers make in a frame
    u64 meshed = 0, uploaded = 0, quads = 0; // meshed: by workers
    u64 without_job = 0;                  // of air: nothing to draw
};

class SectionFeeder {
public:
    // packs: what blocks look like, of the registry that the replica has, or null.
    SectionFeeder(render::Renderer& renderer, ThreadPool& pool, std::shared_ptr<const scene::PackLooks> packs = nullptr);
    ~SectionFeeder(); // waits for its jobs
    SectionFeeder(const SectionFeeder&) = delete;
    SectionFeeder& operator=(const SectionFeeder&) = delete;

    // Takes the replica's dirty sections, starts jobs nearest to `eye` first for at most a third of budget_ms, uploads
    // what is ready until budget_ms are over (but at least one section, so that it always goes on).
    void update(replica::Replica& replica, BlockPos eye, double budget_ms);
    // Other packs while playing: waits for the jobs that run, then meshes everything anew. Load the renderer's textures before.
    void set_packs(std::shared_ptr<const scene::PackLooks> packs);
    // Off: sections only wait, for a renderer that needs no meshes (the tracer); `settled` leaves them out then.
    void set_meshing(bool on) { meshing_ = on; }
    // Hears of every change that `update` takes from the replica; before it is used.
    void on_dirty(std::function<void(const replica::DirtySection&)> listener) { listener_ = std::move(listener); }
    // Nothing waits, runs or lies ready.
    bool settled() const;
    FeederStats stats() const;
    const scene::BlockModels& models() const { return *models_; }
    scene::BlockModels& models() { return *models_; }
    std::span<const render::BiomeTint> tints() const { return tints_; } // by BiomeId

private:
    struct Section {
        bool mesh = false, light = false; // what waits to be done
        bool in_flight = false;
        bool listed = false; // in waiting_at_
        u64 job = 0; // the last one begun; an answer of another is of a section that went and came again
        bool air = false;  // uploaded as such: only its own blocks can change that
        bool draws = true; // false: what is uploaded has no quads, so its light matters to nobody
        u64 dirty_since_ns = 0;
    };
    struct Answer {
        ChunkPos at;
        u64 job = 0;
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
    void mark_by_neighbor(ChunkPos at, u64 now);
    void take_answers();
    void start_jobs(replica::Replica& replica, BlockPos eye, u64 now, double budget_ms);
    void submit(const replica::Replica& replica, ChunkPos at, u64 job, bool mesh, i64 priority);
    void upload(const Answer& answer);
    void return_memory();

    render::Renderer& renderer_;
    ThreadPool& pool_;
    std::shared_ptr<const scene::PackLooks> packs_;
    std::unique_ptr<scene::BlockModels> models_;
    std::vector<render::BiomeTint> tints_; // by BiomeId
    std::function<void(const replica::DirtySection&)> listener_;
    std::unordered_map<ChunkPos, Section> sections_;
    std::vector<ChunkPos> waiting_at_; // all that wait; and some that went or were begun since it was last looked through
    std::shared_ptr<Shared> shared_ = std::make_shared<Shared>();
    std::vector<Answer> taken_;
    DimensionId dimension_{};
    bool meshing_ = true;
    u32 waiting_ = 0, in_flight_ = 0, in_flight_most_;
    u64 meshed_ = 0, uploaded_ = 0, without_job_ = 0, jobs_ = 0;
    u64 uploaded_at_return_ = 0;
    render::MeshScratch scratch_; // for sections without a job
    render::SectionMesh no_mesh_;
};

} // namespace vitrail::client
