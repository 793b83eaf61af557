// A place where light meets matter, ready to be shaded. Kernel-safe. trace/kernel/surface.h makes it of a hit,
// trace/kernel/bsdf.h says where light goes from it.
#pragma once

#include "scene/water.h"
#include "trace/kernel/scene_view.h"

namespace vitrail::trace {

struct SurfacePoint {
    Place at;                // on the surface; `at.cell` is on the side that the ray came from
    IVec3 inner;             // the cell behind the surface: that of `at` where it lies inside a cell
    Vec3 face;               // of the geometry, unit, on the side that the ray came from
    Vec3 normal;             // for shading, unit, never below the horizon of `face` seen from the ray
    scene::Covariance waves; // of water that is rough: slopes of waves too small to be seen, around those of `normal`
    Vec3 albedo;             // linear, tint in it; thin and dielectric: what is left of light that goes through
    Vec3 emission;           // radiance towards the ray
    float roughness = 1;     // 0..1, GGX alpha is its square; of water see `waves`
    Optics optics = Optics::matte;
    float ior = 1.5f;  // dielectrics: index behind the surface over that on the ray's side; else of the coat
    float opacity = 1; // thin: share of the sheet that is painted and lets nothing through (diffuse `albedo` instead)
    u8 medium_here = 0, medium_behind = 0; // SceneView::media on either side; not of matte and metal
    float mirrored = 1; // rough water: how much brighter what it mirrors may be than what is seen in it
    bool plant = false; // crossed sheets: lit without regard to the side
    u32 surface = 0;    // state and face hashed (PixelSample::surface)
};

} // namespace vitrail::trace
