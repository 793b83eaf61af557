// Sky and air as kernels read them: the same numbers as the raster renderer's (scene/sky.h, scene/mist.h), in device
// memory. Kernel-safe.
#pragma once

#include "scene/cloud_noise.h"
#include "scene/sky_table.h"
#include "trace/kernel/ray.h"

namespace vitrail::trace {

struct SkyView {
    // scene::SkyState, field by field; see there.
    Vec3 sun_direction{0, 1, 0}, moon_direction{0, -1, 0}, pole{0, 0, 1};
    float star_turn = 0, stars = 0, moon_phase = 0; // phase in radians, 0 full
    Vec3 sun_light;                                 // irradiance over pi of a surface that faces the light
    Vec3 light_direction{0, 1, 0};                  // of sun_light: sun or moon, whichever is up
    float light_radius = 0.030f;                    // radians: of the disc that gives sun_light
    Vec3 sun_disc, moon_disc, cloud_light, cloud_direction{0, 1, 0};
    Vec2 sun_azimuth{1, 0};
    Vec3 ground;       // radiance of the land beyond the window (below the horizon)
    Vec3 above, below; // irradiance over pi of level surfaces from above and from below (clouds' light)
    bool open = true;  // false: a dimension without sky; then `ground` is all around
    // Air (scene::Mist), extinction a block; none deep in caves.
    float haze = 0, mist = 0, mist_height = 10;
    float open_air = 1; // 0..1: how open to the sky the eye stands
    i32 sea_level = 63;
    float view_distance = 192; // blocks: land beyond fades into the sky's color
    const scene::SkyTable* dome = nullptr;
    const u8* cloud_noise = nullptr;       // scene/cloud_noise.h; null: no clouds, no milky way, an even moon
    bool clouds = true, star_field = true; // wanted
    Vec2 cloud_place;        // where the eye stands in the clouds' noise: blocks modulo 4096, wind taken in
    float cloud_above = 456; // blocks from the eye up to the clouds
    u32 cloud_steps = 6;     // of the march through them; the raster's 9 differ by 0.005 in the mean
    float seconds = 0;       // stars twinkle, clouds change
};

} // namespace vitrail::trace
