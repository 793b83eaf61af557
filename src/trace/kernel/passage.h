// Ways of light through borders: the straight one of shadow rays, and where a ray goes on behind a surface.
// Kernel-safe.
#pragma once

#include "trace/kernel/bsdf.h"
#include "trace/kernel/lights.h"
#include "trace/kernel/medium.h"
#include "trace/kernel/surface.h"
#include "trace/kernel/traverse.h"

// Parts of a path that are large and seldom or once run stay calls, so that the loop around them is small. A copy for
// each source file, which may have vector flags of its own (base/hd.h).
#ifdef __CUDACC__
#define VX_COLD [[maybe_unused]] static __host__ __device__ __noinline__
#else
#define VX_COLD [[maybe_unused]] __attribute__((noinline)) static
#endif

namespace vitrail::trace {

// The place of a surface point on its far side: across a cell's face it belongs to the next cell.
VX_HD Place other_side(const SurfacePoint& p) {
    Place at = p.at;
    if (p.inner == at.cell) return at;
    const i32 dx = p.face.x > 0.5f    ? 1
                   : p.face.x < -0.5f ? -1
                                      : 0,
              dy = p.face.y > 0.5f    ? 1
                   : p.face.y < -0.5f ? -1
                                      : 0,
              dz = p.face.z > 0.5f    ? 1
                   : p.face.z < -0.5f ? -1
                                      : 0;
    at.cell = {at.cell.x - dx, at.cell.y - dy, at.cell.z - dz};
    at.at = {at.at.x + float(dx), at.at.y + float(dy), at.at.z + float(dz)};
    return at;
}

// Share of light that goes straight through what it meets, from whichever side; 0: nothing does. At a border it loses
// what would be mirrored were it to come from the thinner medium: nothing is mirrored totally.
VX_HD Vec3 straight_through(const SurfacePoint& p, Vec3 dir) {
    switch (p.optics) {
    case Optics::thin:
        return thin_passage(p, dir);
    case Optics::dielectric:
    case Optics::water: {
        const float ior = p.ior > 1 ? p.ior : 1 / p.ior;
        return p.albedo * (1 - fresnel_dielectric(clamp(std::fabs(dot(p.face, dir)), 0.0f, 1.0f), ior));
    }
    default:
        return {};
    }
}

// A shadow ray meets a border: value loses what it and the stretch before it take. since: where that stretch began;
// medium: in it. True: nothing is left.
VX_COLD bool cross_pane(const SceneView& scene, const Ray& ray, const Hit& pane, float& since, u32& medium,
                        Vec3& value) {
    const SurfacePoint p = surface_at(scene, ray, pane, 0.0f);
    value = value * straight_through(p, ray.dir);
    if (medium != 0) value = value * medium_left(scene, moved(ray.from, ray.dir, since), pane.t - since, medium);
    since = pane.t;
    if (p.optics != Optics::thin) medium = p.medium_behind;
    return !(greatest(value) > 0);
}

// How far a ray to a light `distance` ahead (kFar: the sky) is traced: not onto the lamp itself. Not above 0: nothing
// can be in its way.
VX_HD float light_reach(float distance) {
    const float margin = 1e-4f * distance;
    return distance < kFar ? distance - (margin > 1e-3f ? margin : 1e-3f) : kFar;
}

// value loses what the medium of a light ray's last stretch takes, which begins `since` blocks from the ray's start.
VX_HD void cross_last(const SceneView& scene, const Ray& ray, float distance, float since, u32 medium, Vec3& value) {
    if (medium != 0) value = value * medium_left(scene, moved(ray.from, ray.dir, since), distance - since, medium);
}

// Light goes from `distance` ahead straight back to the ray's start, through borders; value loses what they take.
// medium: of the start. False: none arrives.
VX_HD_CALL bool light_passes(const SceneView& scene, const Ray& ray, float distance, u32 medium, Vec3& value) {
    const float most = light_reach(distance);
    if (!(most > 0)) return true;
    float since = 0;
    const bool dark = shadowed(scene, ray, most, medium,
                               [&](const Hit& pane) { return cross_pane(scene, ray, pane, since, medium, value); });
    if (dark) return false;
    cross_last(scene, ray, distance, since, medium, value);
    return true;
}

// What the sampled point of a lamp sends here.
VX_COLD Vec3 lamp_emission(const SceneView& scene, Place from, const EmitterSample& lamp) {
    return surface_at(scene, {from, lamp.dir}, lamp.hit, 0.0f).emission;
}

} // namespace vitrail::trace
