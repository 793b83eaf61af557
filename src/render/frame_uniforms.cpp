#include "render/frame_uniforms.h"

#include <algorithm>
#include <cmath>

namespace vitrail::render {

static Vec4 with(Vec3 v, float w) {
    return {v.x, v.y, v.z, w};
}

static Mat4 projection(const scene::View& view, float aspect) {
    return perspective_reversed_infinite(view.fov_y, aspect, kNearPlane) * view.rotation;
}

static float mean(Vec3 v) {
    return (v.x + v.y + v.z) * (1.0f / 3.0f);
}

// Light in a liquid: what comes down from the surface dims by 0.7 of the extinction a block (much of what is scattered
// goes on downwards), and the share that scatters of what is taken turns towards the eye.
static void set_medium(ViewUniforms& u, const scene::View& view, const scene::SkyState& sky) {
    const scene::Medium& m = view.medium;
    const Vec3 lost = m.absorption + m.scattering;
    u.medium = with(lost, m.depth);
    const float high = std::max(std::abs(sky.sun_direction.y), 0.0f);
    const Vec3 light =
        (sky.ambient + sky.sun_light * high) * m.open + Vec3{1, 1, 1} * (0.012f * mean(m.scattering) * 30);
    // Eyes grow used to the deep: more than kDarkest blocks are never counted (medium.glsl: told_depth).
    constexpr float kDarkest = 13;
    const float deep = kDarkest * (1 - std::exp(-m.depth / kDarkest));
    const auto murk = [&](float scatter, float extinct, float from_above, float glow) {
        if (extinct <= 0) return 0.0f;
        return glow + from_above * kWaterPhase * scatter / extinct * std::exp(-0.7f * extinct * deep);
    };
    u.murk = {murk(m.scattering.x, lost.x, light.x, m.glow.x), murk(m.scattering.y, lost.y, light.y, m.glow.y),
              murk(m.scattering.z, lost.z, light.z, m.glow.z), m.open};
}

static ViewUniforms view_uniforms(const scene::View& view, const scene::View* before, u32 width, u32 height,
                                  Vec2 jitter, const scene::SkyState& sky) {
    const float aspect = float(width) / float(height), t = std::tan(view.fov_y * 0.5f);
    const auto& m = view.rotation.m;
    const Vec3 right{m[0], m[4], m[8]}, up{m[1], m[5], m[9]}, forward{-m[2], -m[6], -m[10]};
    const Vec2 shift{2 * jitter.x / float(width), 2 * jitter.y / float(height)}; // of the picture, ndc
    ViewUniforms u;
    u.view_proj = projection(view, aspect);
    if (shift.x != 0 || shift.y != 0)
        for (u32 column = 0; column < 4; ++column) {
            auto& p = u.view_proj.m;
            p[column * 4] += shift.x * p[column * 4 + 3];
            p[column * 4 + 1] += shift.y * p[column * 4 + 3];
        }
    const scene::View& old = before ? *before : view;
    u.previous = projection(old, aspect) * translation(view_from(old.eye.at, view.eye.at).v);
    u.fraction = with(view_from(corner_of(block_of(view.eye.at)), view.eye.at).v, kNearPlane);
    u.clip_plane = view.clip_plane;
    u.ray_right = with(right * (t * aspect), 2 * t / float(height));
    u.ray_up = with(up * t, !view.underwater ? 0.0f : mean(view.medium.glow) > 0 ? 2.0f : 1.0f);
    // A jittered picture shows at ndc what lies at ndc - shift.
    u.ray_forward = with(forward - right * (t * aspect * shift.x) - up * (t * shift.y), view.scale);
    const BlockPos eye = block_of(view.eye.at);
    u.eye_block = {eye.x, eye.y, eye.z, 0};
    set_medium(u, view, sky);
    return u;
}

FrameUniforms make_frame_uniforms(const scene::FrameView& frame, Vec2 jitter, const PreviousViews& before,
                                  bool background_on, Vec3 background) {
    FrameUniforms u{};
    const bool known = before.views.size() == frame.views.size();
    for (u32 i = 0; i < std::min<u32>(u32(frame.views.size()), kViewsMost); ++i)
        u.views[i] = view_uniforms(frame.views[i], known ? &before.views[i] : nullptr, frame.width, frame.height,
                                   jitter, frame.sky);
    const scene::SkyState& sky = frame.sky;
    u.sun_direction = with(sky.sun_direction, sky.stars);
    u.moon_direction = with(sky.moon_direction, 0);
    u.light_direction = with(sky.sun_direction.y >= 0 ? sky.sun_direction : sky.moon_direction, 0);
    u.sun_light = with(sky.sun_light, 0);
    u.ambient = with(sky.ambient, frame.views.empty() ? 1.0f : frame.views[0].open_air);
    u.sky_azimuth = {sky.sun_azimuth.x, sky.sun_azimuth.y, 0, 0};
    const float w = float(frame.width), h = float(frame.height);
    u.screen = {w, h, 1 / w, 1 / h};
    u.misc = {frame.seconds, 1 / std::max(frame.view_distance, 1.0f), frame.gamma_exposure,
              sky.time / 24000.0f * 6.2831853f};
    u.background = with(background, background_on ? 1.0f : 0.0f);
    u.jitter = {2 * jitter.x / w, 2 * jitter.y / h, 0, 0};
    for (u32 i = 0; i < 9; ++i)
        u.sky_sh[i] = with(sky.irradiance.c[i], 0);
    return u;
}

} // namespace vitrail::render
