// What a ray meets at the border of a cell and inside of it. Kernel-safe.
//
// The world is made of: opaque cubes, met from outside only (a ray that starts in one leaves it); sheets on the faces
// of cutout cubes and of thin glass cubes, met from both sides; borders between media; quads of models; surfaces of
// fluids. Where two cubes with sheets touch there is one sheet, the lower cube's (on that axis), so that geometry does
// not depend on who looks; none between equal thin glass; none against opaque cubes.
//
// Of things at one distance: sheet, border or cube of the face, then what is inside.
#pragma once

#include "trace/kernel/grid_walk.h"
#include "trace/kernel/liquid.h"
#include "trace/kernel/texture.h"

namespace vitrail::trace {

// How much of a cell a ray has behind it, when it goes on after something that lets it pass.
struct CellProgress {
    u32 parts = 0;      // bits: kEntrySheet, kBorder, kInside, kExitSheet
    float inside_t = 0; // the last thing met inside; of equal ones the last quad. Nothing lies behind a ray's start
    u32 inside_quad = 0;
    static constexpr u32 kEntrySheet = 1, kBorder = 2, kInside = 4, kExitSheet = 8;
};

VX_HD bool is_opaque_cube(const StateRecord& r) {
    return r.kind == CellKind::cube || r.kind == CellKind::detailed;
}
VX_HD bool is_thin_cube(const StateRecord& r) {
    return r.kind == CellKind::medium && r.medium == 0;
}
VX_HD bool has_sheets(const StateRecord& r) {
    return r.kind == CellKind::cutout || is_thin_cube(r);
}
// Holds a fluid: its medium ends at a surface.
VX_HD bool has_fluid(const StateRecord& r) {
    return r.medium != 0 && r.kind != CellKind::medium && !is_opaque_cube(r);
}

// The ray at distance t, in the cell's own coordinates.
VX_HD Vec3 in_cell(const Ray& ray, IVec3 relative, double t) {
    return {float(double(ray.from.at.x) + double(ray.dir.x) * t - double(relative.x)),
            float(double(ray.from.at.y) + double(ray.dir.y) * t - double(relative.y)),
            float(double(ray.from.at.z) + double(ray.dir.z) * t - double(relative.z))};
}

// The sheet on a face lets the ray pass: its texel is a hole.
VX_HD bool sheet_hole(const SceneView& s, const StateRecord& r, u32 face, Vec3 at) {
    if (r.kind != CellKind::cutout) return false;
    const u64 look = r.faces[face];
    return hole_at(s.textures, look_texture(look), face_uv(look, at));
}

VX_HD IVec3 beside(IVec3 cell, u32 face) {
    const i32 d = face & 1 ? 1 : -1;
    return {i32(u32(cell.x) + u32(face >> 1 == 0 ? d : 0)), i32(u32(cell.y) + u32(face >> 1 == 1 ? d : 0)),
            i32(u32(cell.z) + u32(face >> 1 == 2 ? d : 0))};
}

VX_HD void face_hit(Hit& hit, double t, IVec3 cell, u32 state, u32 face, bool leaving) {
    hit.t = float(t), hit.cell = cell, hit.state = state;
    hit.kind = HitKind::cube, hit.face = u8(face), hit.leaving = leaving;
    hit.quad = 0, hit.u = hit.v = 0;
}

VX_HD void surface_hit(Hit& hit, float t, IVec3 cell, u32 state, Vec3 at, bool leaving) {
    hit.t = t, hit.cell = cell, hit.state = state;
    hit.kind = HitKind::quad, hit.face = 3, hit.leaving = leaving;
    hit.quad = kLiquidSurface, hit.u = clamp(at.x, 0.0f, 1.0f), hit.v = clamp(at.z, 0.0f, 1.0f);
}

// A quad that the ray comes upon after distance `after` (of equal distances: after quad `after_quad`) and not beyond
// hit.t. at: where the ray is at distance t, in the cell.
VX_HD bool meet_quad(const SceneView& s, u32 index, Vec3 at, Vec3 dir, float t, u32 medium, float after, u32 after_quad,
                     float t_most, Hit& hit, u32& behind) {
    const TraceQuad& q = s.quads[index];
    const float facing = dot(dir, q.normal);
    if (facing == 0) return false;
    // From behind: sheets that show both sides, and bodies that the ray is inside of.
    bool leaving = false;
    if (q.medium != 0) {
        leaving = facing > 0;
        if (leaving != (medium == q.medium)) return false;
    } else if (facing > 0) {
        if (!(q.look & TraceQuad::kTwoSided)) return false;
        leaving = true;
    }
    const float along = dot(q.corner - at, q.normal) / facing, total = t + along;
    // A ray that starts on a quad's plane never meets it again; rounding may say otherwise.
    const float off = total * facing;
    if (!(total <= t_most) || !(off > 1e-4f || off < -1e-4f)) return false;
    if (total < after || (total == after && index <= after_quad)) return false;
    const Vec3 p = at + dir * along - q.corner;
    // Solves p = a edge_a + b edge_b in the quad's plane.
    const float aa = dot(q.edge_a, q.edge_a), ab = dot(q.edge_a, q.edge_b), bb = dot(q.edge_b, q.edge_b),
                pa = dot(p, q.edge_a), pb = dot(p, q.edge_b), det = aa * bb - ab * ab;
    constexpr float kHair = 1e-5f; // quads that share an edge overlap by a hair, so that no ray slips between them
    const float a = (pa * bb - pb * ab) / det, b = (pb * aa - pa * ab) / det;
    if (!(a >= -kHair && b >= -kHair)) return false;
    if (q.look & TraceQuad::kTriangle ? a + b > 1 + kHair : (a > 1 + kHair || b > 1 + kHair)) return false;
    const Vec2 uv = quad_uv(q, a, b);
    if (q.look & TraceQuad::kCutout && hole_at(s.textures, q.texture, uv)) return false;
    hit.t = total, hit.kind = HitKind::quad, hit.quad = index, hit.u = uv.x, hit.v = uv.y;
    hit.leaving = leaving, hit.face = 0;
    behind = q.medium == 0 ? medium : leaving ? 0 : q.medium;
    return true;
}

// Quads and the fluid's surface, the nearest after `progress` and up to t_out. top: null where no surface is met.
VX_HD bool meet_inside(const SceneView& s, const Ray& ray, const Walk& w, u32 state, const StateRecord& r, u32 medium,
                       const LiquidTop* top, float t_out, const CellProgress& progress, Hit& hit, u32& behind) {
    const Vec3 at = in_cell(ray, {w.x, w.y, w.z}, w.t);
    const float t = float(w.t);
    bool found = false;
    Hit best;
    best.t = t_out;
    for (u32 i = 0; i < r.quads; ++i)
        if (meet_quad(s, r.first_quad + i, at, ray.dir, t, medium, progress.inside_t, progress.inside_quad, best.t,
                      best, behind))
            found = true;
    if (top) {
        const bool leaving = medium == r.medium;
        float along;
        const float least = progress.inside_t > t ? progress.inside_t - t : 0.0f;
        if (hit_liquid_top(*top, at, ray.dir, least, best.t - t, leaving, along) &&
            !(progress.inside_quad == kLiquidSurface && t + along <= progress.inside_t)) {
            surface_hit(best, t + along, w.cell(), state, at + ray.dir * along, leaving);
            behind = leaving ? 0 : r.medium;
            found = true;
        }
    }
    if (!found) return false;
    hit = best;
    hit.cell = w.cell(), hit.state = state;
    return true;
}

// The first thing that the ray, in `medium`, meets in the cell where the walk stands, after what `progress` holds;
// `behind`: the medium beyond it. Nothing beyond t_most counts. A start cell has no border.
VX_HD_CALL bool meet_cell(const SceneView& s, const Ray& ray, const Walk& w, u32 medium, float t_most,
                          CellProgress& progress, Hit& hit, u32& behind) {
    const IVec3 cell = w.cell();
    const u32 state = state_at(s.grid, cell);
    const StateRecord& r = s.states[state];
    const bool entered = w.axis != 3;
    behind = medium;
    bool fluid = has_fluid(r) && !(progress.parts & CellProgress::kInside);
    const bool looks_inside = r.quads != 0 || fluid || has_sheets(r);
    Walk next = w;
    if (looks_inside) step_cell(next);
    LiquidTop top;
    bool over = false; // in air above the fluid
    if (fluid) {
        const IVec3 relative{w.x, w.y, w.z};
        over = medium == 0 &&
               above_liquid(s, cell, r.medium, in_cell(ray, relative, w.t).y, in_cell(ray, relative, next.t).y);
        fluid = !over;
        if (fluid) top = liquid_top(s, cell, r.medium);
    }

    if (entered && !(progress.parts & (CellProgress::kBorder | CellProgress::kInside))) {
        const u32 face = w.face(), out = face ^ 1; // of this cell; of the one before
        if (is_opaque_cube(r)) {
            // What stands out of the cube lies before it.
            if (r.kind == CellKind::detailed &&
                meet_inside(s, ray, w, state, r, medium, nullptr, float(w.t) + 1e-5f, progress, hit, behind)) {
                progress.inside_t = hit.t, progress.inside_quad = hit.quad;
                return hit.t < t_most;
            }
            progress.parts |= CellProgress::kBorder;
            face_hit(hit, w.t, cell, state, face, false);
            return true;
        }
        const IVec3 before = beside(cell, face);
        const bool sheets = has_sheets(r);
        if (sheets && !(progress.parts & CellProgress::kEntrySheet)) {
            progress.parts |= CellProgress::kEntrySheet;
            const u32 other = state_at(s.grid, before);
            const StateRecord& p = s.states[other];
            const bool shared = has_sheets(p);
            if (!(shared && other == state && r.kind == CellKind::medium)) {
                const bool others = shared && !(face & 1); // the cell before is the lower one
                const Vec3 at = in_cell(ray, {w.x, w.y, w.z}, w.t);
                if (others) {
                    const Vec3 q = in_cell(
                        ray, {w.x + (w.axis == 0 ? -1 : 0), w.y + (w.axis == 1 ? -1 : 0), w.z + (w.axis == 2 ? -1 : 0)},
                        w.t);
                    if (!sheet_hole(s, p, out, q)) {
                        face_hit(hit, w.t, before, other, out, true);
                        return true;
                    }
                } else if (!sheet_hole(s, r, face, at)) {
                    face_hit(hit, w.t, cell, state, face, false);
                    return true;
                }
            }
        }
        progress.parts |= CellProgress::kEntrySheet | CellProgress::kBorder;
        // The medium here, where the ray comes in.
        if (!over && (r.medium != medium || fluid)) {
            const Vec3 at = in_cell(ray, {w.x, w.y, w.z}, w.t);
            bool full = true;
            u32 here = r.medium;
            if (fluid) {
                full = top.full;
                if (!full && at.y > liquid_height_at(top, clamp(at.x, 0.0f, 1.0f), clamp(at.z, 0.0f, 1.0f))) here = 0;
            }
            if (here != medium) {
                const u32 other = state_at(s.grid, before);
                const StateRecord& p = s.states[other];
                behind = here;
                if (fluid && (p.medium == r.medium || (!full && face == 3)))
                    // Both cells hold the fluid: no face is between them, the ray is a hair beside the surface.
                    surface_hit(hit, float(w.t), cell, state, at, here == 0);
                else if (here != 0)
                    face_hit(hit, w.t, cell, state, face, false);
                else
                    face_hit(hit, w.t, before, other, out, true);
                return true;
            }
        }
    }
    if (is_opaque_cube(r)) return false;

    if (looks_inside) {
        if (!(progress.parts & CellProgress::kInside)) {
            const float t_out = float(next.t) + 1e-5f;
            if ((r.quads != 0 || fluid) &&
                meet_inside(s, ray, w, state, r, medium, fluid ? &top : nullptr, t_out, progress, hit, behind)) {
                progress.parts |= CellProgress::kBorder;
                progress.inside_t = hit.t, progress.inside_quad = hit.quad;
                return hit.t < t_most;
            }
            progress.parts |= CellProgress::kInside;
        }
        if (has_sheets(r) && !(progress.parts & CellProgress::kExitSheet)) {
            progress.parts |= CellProgress::kExitSheet;
            const u32 out = next.face() ^ 1;
            const StateRecord& n = s.states[state_at(s.grid, next.cell())];
            if (!has_sheets(n) && !is_opaque_cube(n) && float(next.t) < t_most &&
                !sheet_hole(s, r, out, in_cell(ray, {w.x, w.y, w.z}, next.t))) {
                face_hit(hit, next.t, cell, state, out, true);
                return true;
            }
        }
    }
    return false;
}

} // namespace vitrail::trace
