// Rays through the world. Kernel-safe; exact: cells, faces and distances are those of brute force over every cell.
//
//     Hit hit;
//     if (closest_hit(scene, ray, kFar, medium, hit)) ...
//     bool dark = shadowed(scene, ray, kFar, medium, [&](const Hit& pane) { light *= ...; return false; });
//
// A ray has to be told the medium that it starts in (SceneView::media); it is believed.
#pragma once

#include "trace/kernel/air_walk.h"
#include "trace/kernel/box_hit.h"
#include "trace/kernel/cell_hit.h"
#include "trace/kernel/water_walk.h"

namespace vitrail::trace {

VX_HD Seek seek_in(const SceneView& s, u32 medium) {
    return medium == 0 ? Seek::air : medium == s.grid.water ? Seek::water : Seek::any;
}

// The next cell to look into.
VX_HD Walked next_look(const GridView& g, const Ray& ray, Walk& w, Seek seek, float t_max, u32& steps) {
    if (seek == Seek::water) return next_in_water(g, ray, w, double(t_max), steps);
    if (seek == Seek::any || !g.skips) return next_stop(g, ray, w, seek, double(t_max), steps);
    for (;;) {
        const Walked walked = next_in_air(g, ray, w, t_max, steps);
        if (walked != Walked::stopped || !is_high(g, ray, w)) return walked;
        const Walked past = pass_above_water(g, ray, w, double(t_max));
        if (past != Walked::lost) return past;
    }
}

// What the start cell can show from inside.
VX_HD bool looks_in(const SceneView& s, IVec3 cell) {
    if (s.grid.skips && !stops_air(s.grid, cell)) return false; // as most do: less is read
    const StateRecord& r = s.states[state_at(s.grid, cell)];
    return r.quads != 0 || r.medium != 0 || has_sheets(r);
}

// The nearest border or surface before t_max. False: nothing; or, with HitKind::unknown, the ray passed more than
// kCellsMost boxes of cells.
VX_HD_CALL bool closest_hit(const SceneView& s, const Ray& ray, float t_max, u32 medium, Hit& hit) {
    hit = Hit{};
    bool found = false;
    if (meet_boxes(s, ray, t_max, false, hit)) t_max = hit.t, found = true;
    Walk w = start_walk(ray);
    bool look = looks_in(s, w.cell());
    const Seek seek = seek_in(s, medium);
    u32 steps = kCellsMost, behind;
    for (;;) {
        if (look) {
            CellProgress progress;
            Hit met;
            const Walk here = w; // whose address a call may take, while the walk stays in registers
            if (meet_cell(s, ray, here, medium, t_max, progress, met, behind)) {
                hit = met;
                return true;
            }
        }
        const Walked walked = next_look(s.grid, ray, w, seek, t_max, steps);
        if (walked == Walked::lost) {
            hit = Hit{};
            hit.kind = HitKind::unknown;
            return false;
        }
        if (walked == Walked::ended) return found;
        look = true;
    }
}

// Light may pass what was hit, perhaps weakened.
VX_HD bool passes_light(const SceneView& s, const Hit& hit) {
    if (hit.kind == HitKind::box) return false;
    const StateRecord& r = s.states[hit.state];
    u32 optics = r.optics;
    if (hit.kind == HitKind::quad && hit.quad != kLiquidSurface)
        optics = s.quads[hit.quad].look >> 16 & 15;
    else if (r.kind == CellKind::model)
        return true; // the fluid that it stands in
    else if (is_opaque_cube(r))
        return false;
    return optics == u32(Optics::leaf) || optics == u32(Optics::thin) || optics == u32(Optics::dielectric) ||
           optics == u32(Optics::water);
}

// True: something opaque lies before t_max, or pane said so. pane(const Hit&) -> bool is called, in order along the
// ray, for each border that light may pass (media, thin glass, water, leaves).
template <class OnPane>
VX_HD bool shadowed(const SceneView& s, const Ray& ray, float t_max, u32 medium, OnPane&& pane) {
    Hit hit;
    if (meet_boxes(s, ray, t_max, true, hit)) return true;
    Walk w = start_walk(ray);
    u32 steps = kCellsMost, behind;
    bool look = looks_in(s, w.cell());
    for (;;) {
        CellProgress progress;
        const Walk here = w; // as in closest_hit
        while (look && meet_cell(s, ray, here, medium, t_max, progress, hit, behind)) {
            if (!passes_light(s, hit) || pane(static_cast<const Hit&>(hit)) || steps-- == 0) return true;
            medium = behind;
        }
        const Walked walked = next_look(s.grid, ray, w, seek_in(s, medium), t_max, steps);
        if (walked != Walked::stopped) return walked == Walked::lost;
        look = true;
    }
}

} // namespace vitrail::trace
