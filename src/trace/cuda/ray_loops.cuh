// Loops that run rays on a GPU, for kernels of any kind: a warp's lanes walk through air together, a step each at a
// time, and rays that stop wait until some others have, so that what is rare (a cell to look into, a step that float
// is not sure of, the next ray) is done by several lanes at once.
//
// All lanes of a warp call them together, in blocks of whole warps. A job tells of the rays:
//
//     struct Job {
//         __device__ Ray ray(u32 id) const;        // may be asked for again
//         __device__ float t_max(u32 id) const;
//         __device__ u32 medium(u32 id) const;     // that the ray starts in
//         __device__ void met(u32 id, bool any, const Hit& hit) const; // closest_rays: as closest_hit tells
//         __device__ bool pane(u32 id, const Hit& hit) const;          // shadow_rays: as shadowed asks
//         __device__ void shaded(u32 id, bool dark) const;             // shadow_rays
//     };
//
// A feed hands out the numbers of rays: PerThread (as many threads as rays) or FromCounter (warps that stay).
#pragma once

#include "trace/kernel/traverse.h"

namespace vitrail::trace::cuda {

inline constexpr u32 kNoRay = ~0u;

__device__ inline u32 lane_number() {
    return threadIdx.x & 31;
}

// Each thread one ray: that of its number in the launch.
struct PerThread {
    u32 count = 0;
    bool over = false;

    // For the lanes of `idle`, their next ray or kNoRay.
    __device__ u32 take(u32 idle) {
        (void)idle;
        over = true;
        const u32 id = blockIdx.x * blockDim.x + threadIdx.x;
        return id < count ? id : kNoRay;
    }
};

// Whoever has room takes the next ones. counter: in device memory, 0 before the launch.
struct FromCounter {
    u32 count = 0;
    u32* counter = nullptr;
    bool over = false;

    __device__ u32 take(u32 idle) {
        u32 first = 0;
        if (lane_number() == 0) first = atomicAdd(counter, u32(__popc(idle)));
        first = __shfl_sync(~0u, first, 0);
        over = first >= count || count - first <= u32(__popc(idle));
        const u32 id = first + u32(__popc(idle & ((1u << lane_number()) - 1)));
        return idle >> lane_number() & 1 && id < count && id >= first ? id : kNoRay;
    }
};

// A lane's ray.
struct RayLane {
    u32 id = kNoRay;
    float t_max = 0;
    AirWalk walk{};
};

// What closest_rays and shadow_rays share. Lanes lie in (local) memory, but while they step: all else that a ray does
// is in functions of its own, with the registers that it needs.
template <class Feed, class Look>
__device__ __forceinline__ void run_rays(const GridView& grid, Feed feed, u32 wait, const Look& look) {
    RayLane lane;
    u32 id = kNoRay;
    for (;;) {
        const u32 idle = __ballot_sync(~0u, id == kNoRay);
        if (!feed.over && idle) {
            const u32 next = feed.take(idle);
            if (next != kNoRay) {
                look.begin(next, lane);
                id = lane.id;
            }
        }
        bool running = id != kNoRay;
        const u32 count = u32(__popc(__ballot_sync(~0u, running)));
        if (count == 0) {
            if (feed.over) return;
            continue;
        }
        const u32 least = count > wait ? count - wait : 0;
        AirWalk w = lane.walk;
        u32 left;
        do {
            running = step_air(grid, w, running);
            left = u32(__popc(__ballot_sync(~0u, running)));
        } while (left > least);
        lane.walk.x = w.x, lane.walk.y = w.y, lane.walk.z = w.z, lane.walk.axis = w.axis;
        if (id != kNoRay && !running) {
            look.look(lane);
            id = lane.id;
        }
    }
}

// Sets out, in air. False: the way is over before it comes in range.
__device__ __forceinline__ bool set_out(const GridView& g, const Ray& ray, float t_max, AirWalk& w) {
    AirPlace p{{0, 0, 0}, 3, true};
    if (!in_air_range(g, ray.from.cell)) p = step_exactly(g, ray, p, t_max);
    if (p.inside) w = start_air(g, ray, p.r, p.axis, t_max);
    return p.inside;
}

template <class Job>
class ClosestLook {
public:
    __device__ __forceinline__ ClosestLook(const SceneView& s, const Job& j)
        : scene(s)
        , job(j) {}

    // Sets out, or is done at once.
    __device__ __noinline__ void begin(u32 id, RayLane& lane) const {
        lane.id = start(id, lane.t_max, lane.walk) ? id : kNoRay;
    }
    // After a step that did not move.
    __device__ __noinline__ void look(RayLane& lane) const {
        if (stops_here(scene.grid, lane.walk) && stop(lane.id, lane.t_max, lane.walk)) {
            lane.id = kNoRay;
            return;
        }
        const AirPlace p =
            step_exactly(scene.grid, job.ray(lane.id), {cell_of(lane.walk), lane.walk.axis, true}, lane.t_max);
        if (p.inside)
            put_cell(lane.walk, p.r, p.axis);
        else
            none(lane.id), lane.id = kNoRay;
    }

private:
    __device__ __forceinline__ bool start(u32 id, float& t_max, AirWalk& w) const {
        const Ray ray = job.ray(id);
        t_max = job.t_max(id);
        if (job.medium(id) != 0 || !scene.grid.skips) {
            Hit hit;
            const bool any = closest_hit(scene, ray, t_max, job.medium(id), hit);
            job.met(id, any, hit);
            return false;
        }
        if (scene.box_count != 0) {
            Hit hit;
            if (meet_boxes(scene, ray, t_max, false, hit)) t_max = hit.t;
        }
        if (set_out(scene.grid, ray, t_max, w)) return true;
        none(id);
        return false;
    }
    __device__ __forceinline__ bool stop(u32 id, float t_max, const AirWalk& w) const {
        const Ray ray = job.ray(id);
        const IVec3 r = cell_of(w), c = ray.from.cell;
        const IVec3 cell{i32(u32(c.x) + u32(r.x)), i32(u32(c.y) + u32(r.y)), i32(u32(c.z) + u32(r.z))};
        const u32 state = state_at(scene.grid, cell);
        Hit hit;
        if (w.axis != 3 && scene.states[state].kind == CellKind::cube) {
            face_hit(hit, stop_distance(ray, r, w.axis), cell, state, face_of(w), false);
            job.met(id, true, hit);
            return true;
        }
        if (w.axis == 3 && !looks_in(scene, cell)) return false;
        const Walk here = walk_in(ray, r, w.axis);
        CellProgress progress;
        u32 behind;
        if (!meet_cell(scene, ray, here, 0, t_max, progress, hit, behind)) return false;
        job.met(id, true, hit);
        return true;
    }
    __device__ __forceinline__ void none(u32 id) const {
        Hit hit;
        bool any = false;
        if (scene.box_count != 0) any = meet_boxes(scene, job.ray(id), job.t_max(id), false, hit);
        job.met(id, any, hit);
    }

    const SceneView& scene;
    const Job& job;
};

template <class Job>
class ShadowLook {
public:
    __device__ __forceinline__ ShadowLook(const SceneView& s, const Job& j)
        : scene(s)
        , job(j) {}

    // Sets out, or is done at once.
    __device__ __noinline__ void begin(u32 id, RayLane& lane) const {
        lane.id = start(id, lane.t_max, lane.walk) ? id : kNoRay;
    }
    // After a step that did not move.
    __device__ __noinline__ void look(RayLane& lane) const {
        if (stops_here(scene.grid, lane.walk) && stop(lane.id, lane.t_max, lane.walk)) {
            lane.id = kNoRay;
            return;
        }
        const AirPlace p =
            step_exactly(scene.grid, job.ray(lane.id), {cell_of(lane.walk), lane.walk.axis, true}, lane.t_max);
        if (p.inside)
            put_cell(lane.walk, p.r, p.axis);
        else
            none(lane.id), lane.id = kNoRay;
    }

private:
    __device__ __forceinline__ bool start(u32 id, float& t_max, AirWalk& w) const {
        const Ray ray = job.ray(id);
        t_max = job.t_max(id);
        if (job.medium(id) != 0 || !scene.grid.skips) {
            job.shaded(id, all_the_way(id, ray, t_max));
            return false;
        }
        if (scene.box_count != 0) {
            Hit hit;
            if (meet_boxes(scene, ray, t_max, true, hit)) {
                job.shaded(id, true);
                return false;
            }
        }
        if (set_out(scene.grid, ray, t_max, w)) return true;
        none(id);
        return false;
    }
    __device__ __forceinline__ bool stop(u32 id, float t_max, const AirWalk& w) const {
        if (w.axis != 3 && opaque_in(scene.grid, w)) {
            job.shaded(id, true);
            return true;
        }
        const Ray ray = job.ray(id);
        Walk at = walk_in(ray, cell_of(w), w.axis);
        if (w.axis == 3 && !looks_in(scene, at.cell())) return false;
        u32 medium = 0;
        CellProgress progress;
        bool dark = leaves_dark(scene, ray, at, t_max, medium, progress, pane_of(id));
        if (!dark && medium == 0) return false;
        if (!dark) dark = go_on_in(id, ray, at, t_max, medium);
        job.shaded(id, dark);
        return true;
    }
    __device__ __forceinline__ void none(u32 id) const { job.shaded(id, false); }
    __device__ __noinline__ bool all_the_way(u32 id, const Ray& ray, float t_max) const {
        return shadowed(scene, ray, t_max, job.medium(id), pane_of(id));
    }
    __device__ __noinline__ bool go_on_in(u32 id, const Ray& ray, Walk& w, float t_max, u32 medium) const {
        return shadowed_from(scene, ray, w, t_max, medium, pane_of(id));
    }
    __device__ __forceinline__ auto pane_of(u32 id) const {
        return [this, id](const Hit& hit) { return job.pane(id, hit); };
    }

    const SceneView& scene;
    const Job& job;
};

// wait: how many lanes stop before the others wait for them, 1..32.
template <class Feed, class Job>
__device__ __forceinline__ void closest_rays(const SceneView& scene, const Feed& feed, u32 wait, const Job& job) {
    run_rays(scene.grid, feed, wait, ClosestLook<Job>(scene, job));
}
template <class Feed, class Job>
__device__ __forceinline__ void shadow_rays(const SceneView& scene, const Feed& feed, u32 wait, const Job& job) {
    run_rays(scene.grid, feed, wait, ShadowLook<Job>(scene, job));
}

} // namespace vitrail::trace::cuda
