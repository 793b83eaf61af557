// What streams do with single rays: the whole way, or the end of it. Kernel-style code, inlined into each build.
#pragma once

#include "trace/cpu/ray_stream.h"

namespace vitrail::trace::stream {

// As spans are not for files that are built for one vector set.
struct Rays {
    const Ray* rays = nullptr;
    const float* t_max = nullptr; // null: kFar
    const u8* media = nullptr;    // null: air
    u32 count = 0;
};

VX_HD float t_max_of(const Rays& r, u32 i) {
    return r.t_max ? r.t_max[i] : kFar;
}
VX_HD u32 medium_of(const Rays& r, u32 i) {
    return r.media ? r.media[i] : 0;
}

VX_HD void trace_one(const SceneView& s, const Rays& r, u32 i, Hit* hits) {
    closest_hit(s, r.rays[i], t_max_of(r, i), medium_of(r, i), hits[i]);
}

VX_HD bool is_leaf(const SceneView& s, const Hit& hit) {
    if (hit.kind == HitKind::quad && hit.quad != kLiquidSurface)
        return (s.quads[hit.quad].look >> 16 & 15) == u32(Optics::leaf);
    const StateRecord& r = s.states[hit.state];
    return r.kind != CellKind::model && r.optics == u8(Optics::leaf);
}
// What a light ray's first hit does to it. Leaves let light through, but none of it straight.
VX_HD Lit lit_behind(const SceneView& s, const Hit& hit) {
    return passes_light(s, hit) && !is_leaf(s, hit) ? Lit::panes : Lit::shadow;
}

VX_HD void shadow_one(const SceneView& s, const Rays& r, u32 i, Lit* lit) {
    bool pane = false;
    const bool dark = shadowed(s, r.rays[i], t_max_of(r, i), medium_of(r, i), [&](const Hit& hit) {
        pane = !is_leaf(s, hit);
        return true;
    });
    lit[i] = pane ? Lit::panes : dark ? Lit::shadow : Lit::open;
}

void trace_avx512(const SceneView& s, const Rays& r, Hit* hits);
void shadow_avx512(const SceneView& s, const Rays& r, Lit* lit);

} // namespace vitrail::trace::stream
