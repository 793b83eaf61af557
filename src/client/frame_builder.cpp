#include "client/frame_builder.h"

#include "math/angle.h"
#include "scene/sky.h"
#include "scene/water.h"
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

std::array<u8, 3> water_tint_at(const replica::Replica& replica, BlockPos eye) {
    const ChunkPtr chunk = replica.dimension().find(chunk_of(eye));
    if (!chunk) return BiomeDef{}.water;
    const u32 cell = u32(eye.x & 15) / 4 | u32(eye.z & 15) / 4 << 2 | u32(eye.y & 15) / 4 << 4;
    return replica.registry()->biome_named(replica.biomes().name(BiomeId(chunk->biomes.cells[cell]))).water;
}

namespace {

bool is_wet(const Dimension& dimension, StateId id) {
    return dimension.states().flags(id) & kLiquid || dimension.states().info(id).in_water;
}

// Blocks of liquid above a cell, and the share of sky light over its surface; rock above ends the search.
struct Above {
    float depth = 0, open = 0;
    bool found = false;
};
Above above(const Dimension& dimension, BlockPos at) {
    constexpr i32 kFarthest = 64;
    for (i32 dy = 0; dy <= kFarthest; ++dy) {
        const BlockPos cell{at.x, at.y + dy, at.z};
        const StateId state = dimension.state_at(cell);
        if (is_wet(dimension, state)) continue;
        if (dimension.states().flags(state) & kOpaqueCube) return {};
        return {float(dy), float(dimension.light_at(cell).sky()) / 15.0f, true};
    }
    return {float(kFarthest), 1, true}; // so deep that it is dark anyway
}

} // namespace

scene::Medium medium_at(const Dimension& dimension, WorldPos eye, std::array<u8, 3> water_tint) {
    const BlockPos at = block_of(eye);
    const StateInfo& info = dimension.states().info(dimension.state_at(at));
    scene::Medium medium;
    const BlockLook& look = *info.look;
    if (!info.in_water && look.layer != RenderLayer::translucent) {
        const float dense = 5 * std::max(look.viscosity, 0.1f);
        medium.absorption = {dense, dense, dense};
        const auto glow = [](u8 level) { return float(level) * float(level) * (0.9f / 225.0f); };
        medium.glow = {glow(look.light[0]), glow(look.light[1]), glow(look.light[2])};
    } else {
        const auto optics = scene::water_optics(Vec3{float(water_tint[0]), float(water_tint[1]), float(water_tint[2])} * (1.0f / 255.0f));
        medium.absorption = optics.absorption, medium.scattering = optics.scattering;
    }
    // The mean of the columns around, so that swimming below a ledge is no step from light to darkness.
    float weights = 0, open = 0, depths = 0, depth = 0;
    for (i32 dz = -4; dz <= 4; dz += 4)
        for (i32 dx = -4; dx <= 4; dx += 4) {
            const BlockPos cell{at.x + dx, at.y, at.z + dz};
            const float weight = dx == 0 && dz == 0 ? 4 : dx == 0 || dz == 0 ? 2 : 1;
            if (!is_wet(dimension, dimension.state_at(cell))) continue;
            const Above a = above(dimension, cell);
            weights += weight, open += weight * a.open * a.open;
            if (a.found) depths += weight, depth += weight * a.depth;
        }
    medium.open = weights > 0 ? open / weights : 0;
    // From the bottom of the eye's cell to the liquid's surface, 1/9 block below the top.
    const Above here = above(dimension, at);
    medium.depth = here.found ? here.depth : depths > 0 ? depth / depths : 64;
    medium.depth = std::max(medium.depth - 1.0f / 9.0f - view_from(corner_of(at), eye).v.y, 0.0f);
    return medium;
}

scene::FrameView build_frame(const CameraPose& pose, const Dimension& dimension, u32 width, u32 height, double day_ticks,
                             u32 view_distance, float seconds, std::array<u8, 3> water_tint) {
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
    if (view.underwater) view.medium = medium_at(dimension, pose.eye.at, water_tint);
    const float sky = std::min(float(dimension.light_at(block_of(pose.eye.at)).sky()) / 8.0f, 1.0f);
    view.sea_level = dimension.info().sea_level;
    view.misty = dimension.info().has_sky;
    view.open_air = dimension.info().has_sky ? sky * sky : 1.0f;
    frame.views.push_back(view);
    return frame;
}

} // namespace vitrail::client
