// What one path tells of its pixel: light split so that it can be filtered, and what guides the filter. Kernel-safe.
//
//     radiance = base + albedo * light + air
//
// The guides are those of the first surface that is not seen through or mirrored sharply: behind still water or glass
// and in mirrors the filter follows what is seen there. Of far water, which its waves roughen, they are of its level
// surface: what it mirrors and what is seen in it, sky and lamps too, is light that arrives there.
#pragma once

#include "trace/kernel/ray.h"

namespace vitrail::trace {

struct PixelSample {
    Vec3 base;            // needs no filter: sky and lamps seen, sharply or through glass
    Vec3 light;           // arrives at that surface, over its albedo (diffuse and glossy together)
    Vec3 air;             // scattered towards the eye by mist and water on the way
    Vec3 albedo{1, 1, 1}; // of that surface, times what glass and water on the way leave; above 0.01
    Vec3 normal;          // unit; 0 where there is none (sky)
    float distance = 0;   // blocks along the whole way; 0: sky
    float roughness = 1;  // of that surface; glossy light moves with the eye, so its history counts less
    u32 surface = 0;      // state and face hashed: another surface has another number
};

VX_HD Vec3 radiance_of(const PixelSample& p) {
    return p.base + p.albedo * p.light + p.air;
}

} // namespace vitrail::trace
