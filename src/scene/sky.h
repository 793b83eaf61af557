// Sky, sun and moon by the time of day, for raster and tracer alike: the physics of atmosphere.h, with what players'
// eyes want of it laid on top (all such numbers stand together in sky.cpp). Kernel-safe: values only.
//
// All colors are linear RGB with sRGB primaries. The unit: a white level surface under the open sky sends back 2 at
// noon (three quarters from the sun, one quarter from the dome); grass, stone and earth then send 0.1 to 0.4, what a
// picture shows well unchanged. Radiance of a surface is albedo x (irradiance / pi), so `sun_light` and `irradiance`
// are given divided by pi. Real light falls a millionfold until midnight; here it falls to a twentieth under a full
// moon and an eightieth under a new one, which automatic exposure, held to a gain of 4, leaves as night. A lamp's light
// on a wall beside it is about 1: it rules the night, shows at dusk, and at noon is a glow in the shade.
#pragma once

#include "scene/frame_view.h"

namespace vitrail::scene {

// time: 0..24000 (wraps), 0 sunrise, 6000 noon, 12000 sunset, 18000 midnight. Smooth everywhere. day: days since the
// world began; the moon's phase is its remainder by 8, and changes at noon, when the moon is down.
SkyState sky_at(float time, u64 day = 0);

// Color of the dome (without sun disc, moon, stars, clouds) in a direction of unit length; below the horizon that of
// the horizon. The fog of far land is this in its horizontal direction, so that land fades into the sky behind it.
Vec3 sky_color(const SkyState& sky, Vec3 direction);

// Irradiance over pi of a surface of this unit normal that sees all of its hemisphere; without the direct light.
Vec3 sky_irradiance(const SkyState& sky, Vec3 normal);

// What lights a surface from that direction: the dome, and below the horizon the ground that dome and sun light.
// `SkyState::irradiance` is made of it.
Vec3 surrounding_light(const SkyState& sky, Vec3 direction);

} // namespace vitrail::scene
