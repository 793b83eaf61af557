#include "render/frame_uniforms.h"

#include <algorithm>
#include <cmath>

namespace vitrail::render {

static Vec4 with(Vec3 v, float w) {
    return {v.x, v.y, v.z, w};
}

static ViewUniforms view_uniforms(const scene::View& view, u32 width, u32 height) {
    const float aspect = float(width) / float(height), t = std::tan(view.fov_y * 0.5f);
    const auto& m = view.rotation.m;
    const Vec3 right{m[0], m[4], m[8]}, up{m[1], m[5], m[9]}, forward{-m[2], -m[6], -m[10]};
    ViewUniforms u;
    u.view_proj = perspective_reversed_infinite(view.fov_y, aspect, kNearPlane) * view.rotation;
    u.fraction = with(view_from(corner_of(block_of(view.eye.at)), view.eye.at).v, kNearPlane);
    u.clip_plane = view.clip_plane;
    u.ray_right = with(right * (t * aspect), 2 * t / float(height));
    u.ray_up = with(up * t, view.underwater ? 1.0f : 0.0f);
    u.ray_forward = with(forward, view.scale);
    return u;
}

FrameUniforms make_frame_uniforms(const scene::FrameView& frame, bool background_on, Vec3 background) {
    FrameUniforms u{};
    for (u32 i = 0; i < std::min<u32>(u32(frame.views.size()), kViewsMost); ++i)
        u.views[i] = view_uniforms(frame.views[i], frame.width, frame.height);
    const scene::SkyState& sky = frame.sky;
    u.sun_direction = with(sky.sun_direction, sky.stars);
    u.moon_direction = with(sky.moon_direction, 0);
    u.light_direction = with(sky.sun_direction.y >= 0 ? sky.sun_direction : sky.moon_direction, 0);
    u.sun_light = with(sky.sun_light, 0);
    u.ambient = with(sky.ambient, frame.views.empty() ? 1.0f : frame.views[0].open_air);
    u.zenith = with(sky.zenith, 0);
    u.horizon = with(sky.horizon, 0);
    u.glow = with(sky.glow, 0);
    const float w = float(frame.width), h = float(frame.height);
    u.screen = {w, h, 1 / w, 1 / h};
    u.misc = {frame.seconds, 1 / std::max(frame.view_distance, 1.0f), frame.gamma_exposure,
              sky.time / 24000.0f * 6.2831853f};
    u.background = with(background, background_on ? 1.0f : 0.0f);
    return u;
}

} // namespace vitrail::render
