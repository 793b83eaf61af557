// Sky, sun and moon by the time of day, for raster and tracer alike. Kernel-safe: values only.
// All colors are linear RGB with sRGB primaries; 1 is about the brightness of a white surface at noon.
#pragma once

#include "scene/frame_view.h"

namespace vitrail::scene {

// time: 0..24000 (wraps), 0 sunrise, 6000 noon, 12000 sunset, 18000 midnight. Smooth everywhere.
SkyState sky_at(float time);

// Color of the dome (without sun disc, moon, stars, clouds) in a direction of unit length. The fog of far land is this
// in its horizontal direction, so that land fades into the sky behind it.
Vec3 sky_color(const SkyState& sky, Vec3 direction);

// Light of the whole sky on a surface of this unit normal that sees all of its hemisphere.
Vec3 sky_irradiance(const SkyState& sky, Vec3 normal);

} // namespace vitrail::scene
