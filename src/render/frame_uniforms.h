// The uniform block `Frame` of passes/common/frame.glsl, byte for byte (std140).
#pragma once

#include "scene/frame_view.h"

#include <array>
#include <vector>

namespace vitrail::render {

inline constexpr u32 kViewsMost = 8;
inline constexpr float kNearPlane = 0.05f; // blocks
inline constexpr float kWaterPhase = 0.30f; // share of scattered light that a liquid turns to the eye (medium.glsl: kPhase)

struct ViewUniforms {
    Mat4 view_proj;            // camera-relative world to clip space, reversed depth; jitter included
    Mat4 previous;             // camera-relative place of this frame to clip space of the frame before, without jitter
    Vec4 fraction, clip_plane; // the eye inside its block, near plane
    Vec4 ray_right, ray_up, ray_forward;
    std::array<i32, 4> eye_block{}; // the eye's block (shaders take it modulo what they repeat by)
    Vec4 medium; // extinction of the liquid around the eye, a block; the eye's depth below its surface
    Vec4 murk;   // radiance that an endless way through it scatters towards the eye; how open to the sky
};

struct FrameUniforms {
    ViewUniforms views[kViewsMost];
    Vec4 sun_direction, moon_direction, light_direction, sun_light, ambient, sky_azimuth, screen, misc,
        background, jitter;
    Vec4 sky_sh[9];
};
static_assert(sizeof(ViewUniforms) == 256 && sizeof(FrameUniforms) == 8 * 256 + 19 * 16);

// The views of the frame before, for `previous`; none where nothing may be taken from it.
struct PreviousViews {
    std::vector<scene::View> views;
    u32 width = 0, height = 0;
};

// jitter: pixels. background: used where `background_on`, instead of sky and fog. Exact to float rounding wherever the
// eye is.
FrameUniforms make_frame_uniforms(const scene::FrameView& frame, Vec2 jitter, const PreviousViews& before,
                                  bool background_on, Vec3 background);

} // namespace vitrail::render
