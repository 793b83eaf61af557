// Rays whose way is air up to an opaque cube or out of range: most, where land is blocks. What that takes needs no
// calls and no memory but the grid's, so that a GPU's kernel of nothing else stays small; whoever calls traces the
// others as traverse.h does. Kernel-safe.
#pragma once

#include "trace/kernel/air_walk.h"
#include "trace/kernel/cell_hit.h"

namespace vitrail::trace {

enum class LeanEnd : u8 {
    stopped, // the walk stands in a cell that stops rays through air
    passed,  // nothing is met before t_max
    hard,    // not known: ask closest_hit or shadowed
};

// w: where it ended.
VX_HD LeanEnd lean_walk(const SceneView& s, const Ray& ray, float t_max, u32 medium, AirWalk& w) {
    const GridView& g = s.grid;
    if (medium != 0 || s.box_count != 0 || !g.skips || !in_air_range(g, ray.from.cell)) return LeanEnd::hard;
    w = start_air(g, ray, {0, 0, 0}, 3, t_max);
    for (;;) {
        while (step_air(g, w)) {
        }
        if (stops_here(g, w)) return w.axis == 3 ? LeanEnd::hard : LeanEnd::stopped;
        // Near the end of the way, or float is not sure of the step.
        const float end = w.end;
        w.end = kAirMost;
        if (!step_air(g, w)) return LeanEnd::hard;
        w.end = end;
        const IVec3 r = cell_of(w);
        if (!in_air_range(g, cell_off(ray.from.cell, r))) return LeanEnd::passed; // it comes in range once at most
        if (t_max < kFar && !(stop_distance(ray, r, w.axis) < double(t_max))) return LeanEnd::passed;
    }
}

// As closest_hit; false: not known.
VX_HD bool lean_closest(const SceneView& s, const Ray& ray, u32 medium, Hit& hit) {
    AirWalk w;
    const LeanEnd end = lean_walk(s, ray, kFar, medium, w);
    if (end == LeanEnd::passed) hit = Hit{};
    if (end != LeanEnd::stopped) return end == LeanEnd::passed;
    const IVec3 r = cell_of(w), cell = cell_off(ray.from.cell, r);
    const u32 state = state_at(s.grid, cell);
    if (s.states[state].kind != CellKind::cube) return false;
    face_hit(hit, stop_distance(ray, r, w.axis), cell, state, face_of(w), false);
    return true;
}

// Whether something opaque lies before t_max, where nothing that light may pass does: passed or stopped.
VX_HD LeanEnd lean_shadow(const SceneView& s, const Ray& ray, float t_max, u32 medium) {
    AirWalk w;
    const LeanEnd end = lean_walk(s, ray, t_max, medium, w);
    return end == LeanEnd::stopped && !opaque_in(s.grid, w) ? LeanEnd::hard : end;
}

} // namespace vitrail::trace
