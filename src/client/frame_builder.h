// From a pose to the FrameView that renderers take.
#pragma once

#include "scene/frame_view.h"
#include "world/dimension.h"

namespace vitrail::client {

struct CameraPose {
    Located<WorldPos> eye;
    float yaw_deg = 0, pitch_deg = 0;
    float fov_deg = 70; // vertical
};

// view_distance in chunks; day_ticks since the world began, 24000 a day; seconds since the start, for animation.
scene::FrameView build_frame(const CameraPose& pose, const Dimension& dimension, u32 width, u32 height, double day_ticks,
                             u32 view_distance, float seconds);

// The pose between two steps, alpha 0 before .. 1 after; positions further than 8 blocks apart are not interpolated.
WorldPos interpolate(WorldPos before, WorldPos after, float alpha);

// Whether the eye is inside a liquid.
bool eye_in_liquid(const Dimension& dimension, WorldPos eye);

} // namespace vitrail::client
