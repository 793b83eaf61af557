#include "trace/sky_source.h"

#include "scene/mist.h"
#include "scene/sky.h"
#include "trace/kernel/sky_clouds.h"
#include "trace/kernel/sky_discs.h"

#include <algorithm>

namespace vitrail::trace {

namespace {

// Light of a place without sky: what eyes used to the dark still see.
constexpr Vec3 kDark{0.0200f, 0.0210f, 0.0240f};
constexpr float kCloudsLeast = 60; // blocks: clouds stay overhead, however high one climbs

} // namespace

SkyView sky_view_of(const scene::FrameView& frame) {
    const scene::SkyState& sky = frame.sky;
    const scene::View view = frame.views.empty() ? scene::View{} : frame.views[0];
    const bool day = sky.sun_direction.y >= 0;
    SkyView v;
    v.sun_direction = sky.sun_direction, v.moon_direction = sky.moon_direction, v.pole = sky.pole;
    v.star_turn = sky.star_turn, v.stars = sky.stars;
    v.moon_phase = float(sky.moon_phase) * 0.785398163f;
    v.light_direction = day ? sky.sun_direction : sky.moon_direction;
    v.light_radius = day ? kSunRadius : kMoonRadius;
    v.sun_disc = sky.sun_disc, v.moon_disc = sky.moon_disc;
    v.cloud_light = sky.cloud_light, v.cloud_direction = sky.cloud_direction;
    v.sun_azimuth = sky.sun_azimuth;
    v.above = scene::sky_irradiance(sky, {0, 1, 0}), v.below = scene::sky_irradiance(sky, {0, -1, 0});
    v.open = view.misty;
    v.sun_light = v.open ? sky.sun_light : Vec3{};
    v.ground = v.open ? scene::surrounding_light(sky, {0, -1, 0}) : kDark;
    const scene::Mist mist = scene::mist_at(sky);
    v.open_air = v.open ? view.open_air : 0.0f;
    v.haze = mist.haze * v.open_air, v.mist = mist.mist * v.open_air;
    v.mist_height = mist.height;
    v.sea_level = view.sea_level;
    v.view_distance = std::max(frame.view_distance, 1.0f);
    v.dome = &sky.dome;
    v.cloud_noise = scene::cloud_noise().data();
    const BlockPos eye = block_of(view.eye.at);
    const Vec3 in_block = view_from(corner_of(eye), view.eye.at).v;
    v.cloud_place = {float(eye.x & 4095) + in_block.x + kCloudWind.x * frame.seconds,
                     float(eye.z & 4095) + in_block.z + kCloudWind.y * frame.seconds};
    v.cloud_above = std::max(kCloudBase - float(eye.y), kCloudsLeast);
    v.seconds = frame.seconds;
    return v;
}

} // namespace vitrail::trace
