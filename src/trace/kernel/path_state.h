// What a path carries from one event to the next, and the rays that it sends straight to lights. Kernel-safe.
#pragma once

#include "trace/kernel/pixel.h"
#include "trace/kernel/ray.h"
#include "trace/kernel/sampler.h"

namespace vitrail::trace {

// How the ray came here since the last scattering, at which lamps were sampled, or rough water.
enum class Since : u8 {
    nothing,  // there was none
    straight, // right after it
    borders,  // through borders alone
    mirrors,  // by a mirror
};

struct PathState {
    Ray ray; // to be traced next
    u32 medium = 0;
    Vec3 carried{1, 1, 1}; // light found ahead counts so much
    Vec3 scatter_side;     // geometric normal at the last scattering; 0 where it takes light from all sides
    float pdf = 0;         // of the ray's direction there
    float way = 0;         // blocks since the eye, while all is sharp
    // Cone of the pixel, while all is sharp: blocks that it is wide at the ray's start, and grows a block
    // (Akenine-Moeller et al., "Improved Shader and Texture Level of Detail using Ray Cones", 2021).
    float wide = 0, spread = 0;
    u32 bounces = 0, events = 0;
    Since since = Since::nothing;
    bool sharp = true; // the eye sees this stretch sharply, or as sharply as the waves of far water let it
    bool bent = false; // by a mirror or a border that bends
    Sampler sampler;
};

// Straight to a light: light_passes (passage.h) says what of `value` arrives, add_arrived (path.h) counts it.
struct LightRay {
    Ray ray;
    float distance = kFar; // blocks to the light; kFar: sun or sky
    u32 medium = 0;        // that it starts in
    Vec3 value;            // where nothing is in its way
    enum class Counts : u8 { direct, indirect, air };
    Counts counts = Counts::direct;
};

} // namespace vitrail::trace
