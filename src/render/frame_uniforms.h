// The uniform block `Frame` of passes/common/frame.glsl, byte for byte (std140).
#pragma once

#include "scene/frame_view.h"

namespace vitrail::render {

inline constexpr u32 kViewsMost = 8;
inline constexpr float kNearPlane = 0.05f; // blocks

struct ViewUniforms {
    Mat4 view_proj;
    Vec4 fraction, clip_plane, ray_right, ray_up, ray_forward;
};

struct FrameUniforms {
    ViewUniforms views[kViewsMost];
    Vec4 sun_direction, moon_direction, light_direction, sun_light, ambient, zenith, horizon, glow, screen, misc,
        background;
};
static_assert(sizeof(ViewUniforms) == 144 && sizeof(FrameUniforms) == 8 * 144 + 11 * 16);

// background: used where `background_on`, instead of sky and fog. Exact to float rounding wherever the eye is.
FrameUniforms make_frame_uniforms(const scene::FrameView& frame, bool background_on, Vec3 background);

} // namespace vitrail::render
