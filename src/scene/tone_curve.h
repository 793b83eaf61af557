// From linear light to what a screen shows, for tracer and tests; the raster renderer's shader is
// render/passes/common/tone.glsl. Kernel-safe: values only. Linear RGB with sRGB primaries, 1 about a white surface at
// noon.
#pragma once

#include "math/vec.h"

namespace vitrail::scene {

// Filmic curve: the ACES reference rendering and output transforms for an sRGB screen as fitted by Stephen Hill
// (BakingLab, 2016). Linear light 0.. (exposure already in it) to linear screen values 0..1.
Vec3 filmic(Vec3 color);

// IEC 61966-2-1: linear 0..1 to the screen's encoding 0..1.
float srgb_encode(float linear);

} // namespace vitrail::scene
