// From a pose to the FrameView that renderers take.
#pragma once

#include "replica/replica.h"
#include "scene/frame_view.h"
#include "world/dimension.h"

#include <array>

namespace vitrail::client {

struct CameraPose {
    Located<WorldPos> eye;
    float yaw_deg = 0, pitch_deg = 0;
    float fov_deg = 70; // vertical
};

// view_distance in chunks; day_ticks since the world began, 24000 a day; seconds since the start, for animation.
// water_tint: of the biome at the eye, sRGB bytes.
scene::FrameView build_frame(const CameraPose& pose, const Dimension& dimension, u32 width, u32 height, double day_ticks,
                             u32 view_distance, float seconds, std::array<u8, 3> water_tint = BiomeDef{}.water);

// The water's tint in the eye's biome.
std::array<u8, 3> water_tint_at(const replica::Replica& replica, BlockPos eye);

// What the eye sees through: all 0 outside of liquids. Clear liquids (drawn translucent) take their color from the tint;
// others glow as the light they give and are as dense as they are viscous.
scene::Medium medium_at(const Dimension& dimension, WorldPos eye, std::array<u8, 3> water_tint);

// The pose between two steps, alpha 0 before .. 1 after; positions further than 8 blocks apart are not interpolated.
WorldPos interpolate(WorldPos before, WorldPos after, float alpha);

// Whether the eye is inside a liquid.
bool eye_in_liquid(const Dimension& dimension, WorldPos eye);

} // namespace vitrail::client
