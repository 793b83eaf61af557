#include "client/frame_builder.h"

#include "math/angle.h"
#include "scene/sky.h"
#include "world/day_clock.h"

#include <algorithm>
#include <cmath>

namespace vitrail::client {

WorldPos interpolate(WorldPos before, WorldPos after, float alpha) {
    const Vec3 step = view_from(before, after).v;
    if (dot(step, step) > 64.0f) return after;
    return offset_by(before, step * alpha);
}

bool eye_in_liquid(const Dimension& dimension, WorldPos eye) {
    const BlockPos at = block_of(eye);
    const StateId state = dimension.state_at(at);
    const auto wet = [&](StateId id) { return dimension.states().flags(id) & kLiquid || dimension.states().info(id).in_water; };
    if (!wet(state)) return false;
    if (wet(dimension.state_at({at.x, at.y + 1, at.z}))) return true;
    const float height = float(liquid_height(dimension.states().info(state).liquid_level)) / float(kShapeUnit);
    return view_from(corner_of(at), eye).v.y < height;
}

scene::FrameView build_frame(const CameraPose& pose, const Dimension& dimension, u32 width, u32 height, double day_ticks,
                             u32 view_distance, float seconds) {
    scene::FrameView frame;
    frame.width = width;
    frame.height = height;
    const double day = std::floor(std::max(day_ticks, 0.0) / kDayTicks);
    frame.sky = scene::sky_at(float(day_ticks - day * kDayTicks), u64(day));
    frame.view_distance = float(view_distance * kChunkSize);
    frame.seconds = std::fmod(seconds, 65536.0f);
    scene::View view;
    view.eye = pose.eye;
    view.rotation = view_rotation(pose.yaw_deg * kRadiansADegree, pose.pitch_deg * kRadiansADegree);
    view.fov_y = pose.fov_deg * kRadiansADegree;
    view.underwater = eye_in_liquid(dimension, pose.eye.at);
    const float sky = std::min(float(dimension.light_at(block_of(pose.eye.at)).sky()) / 8.0f, 1.0f);
    view.open_air = dimension.info().has_sky ? sky * sky : 1.0f;
    frame.views.push_back(view);
    return frame;
}

} // namespace vitrail::client
