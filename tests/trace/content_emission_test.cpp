// Lamps of the base content light a wall one block away as emission.h promises, by rays through the grid.
#include "tests/trace/content_fixture.h"

#include "math/color.h"
#include "trace/content/emission.h"
#include "trace/kernel/surface.h"
#include "trace/kernel/traverse.h"

#include <algorithm>
#include <gtest/gtest.h>

namespace vitrail::trace {
namespace {

// Irradiance over pi in the middle of a wall one block from the cell, at its side `face`: even steps over the picture
// that the cell makes on the plane before the wall.
Vec3 wall_return(const SceneView& scene, IVec3 cell, u32 face, u32 steps) {
    const Vec3 axis = axis_of_face(face), a = face >> 1 == 0 ? Vec3{0, 1, 0} : Vec3{1, 0, 0}, b = cross(axis, a);
    const Vec3 from = Vec3{0.5f, 0.5f, 0.5f} + axis * 1.49f; // relative to the cell
    Vec3 sum;
    const float step = 1.2f / float(steps); // at distance 1: the cell's near face is one wide
    for (u32 i = 0; i < steps * steps; ++i) {
        const float u = (float(i % steps) + 0.5f) * step - 0.6f, v = (float(i / steps) + 0.5f) * step - 0.6f;
        const Vec3 way = -axis + a * u + b * v;
        const float cosine = 1 / length(way);
        const Ray ray{
            {{cell.x + i32(std::floor(from.x)), cell.y + i32(std::floor(from.y)), cell.z + i32(std::floor(from.z))},
             {from.x - std::floor(from.x), from.y - std::floor(from.y), from.z - std::floor(from.z)}},
            way * cosine};
        Hit hit;
        if (!closest_hit(scene, ray, kFar, 0, hit)) continue;
        sum +=
            surface_at(scene, ray, hit, 0).emission * (cosine * cosine * cosine * cosine * step * step / 3.14159265f);
    }
    return sum;
}

struct Lamp {
    const char* state;
    float least, most; // of the return that its level promises; below 1 where small flames are held to kRadianceMost
};

TEST(TraceEmission, LampsLightTheWallBesideThem) {
    const Lamp lamps[] = {
        {"glowstone", 0.85f, 1.15f},
        {"sea_lantern", 0.85f, 1.15f},
        {"shroomlight", 0.85f, 1.15f},
        {"lava", 0.85f, 1.15f},
        {"redstone_lamp[lit=true]", 0.85f, 1.15f},
        {"copper_bulb[lit=true]", 0.85f, 1.15f},
        {"magma_block", 0.85f, 1.15f},
        {"nether_portal", 0.85f, 1.15f},
        {"furnace[lit=true]", 0.85f, 1.15f},
        {"jack_o_lantern", 0.85f, 1.15f},
        {"redstone_torch", 0.85f, 1.15f},
        {"fire", 0.85f, 1.15f},
        {"end_rod", 0.85f, 1.15f},
        {"candle[candles=1,lit=true]", 0.85f, 1.15f},
        {"candle[candles=4,lit=true]", 0.85f, 1.15f},
        {"vitrail:cyan_crystal", 0.1f, 0.4f}, // seen through: held to kClearMost
        // Small flames, held to kRadianceMost.
        {"torch", 0.30f, 0.60f},
        {"wall_torch[facing=north]", 0.30f, 0.60f},
        {"soul_torch", 0.28f, 0.60f},
        {"lantern", 0.70f, 1.10f},
        {"soul_lantern", 0.70f, 1.10f},
        {"campfire", 0.45f, 1.10f},
        {"ender_chest", 0.60f, 1.10f},
    };
    for (const Lamp& lamp : lamps) {
        ContentChunk chunk;
        chunk.set(8, 8, 8, lamp.state);
        const SceneView& view = chunk.scene();
        Vec3 best;
        for (u32 face = 0; face < 6; ++face) {
            const Vec3 found = wall_return(view, {8, 8, 8}, face, 96);
            if (luminance_of(found) > luminance_of(best)) best = found;
        }
        const auto& light = base_content().states->info(StateId(base_content().id(lamp.state))).look->light;
        const float share = luminance_of(best) / lamp_return(std::max({light[0], light[1], light[2]}));
        EXPECT_GT(share, lamp.least) << lamp.state;
        EXPECT_LT(share, lamp.most) << lamp.state;
    }
}

TEST(TraceEmission, LevelsFallAsTheRastersLaw) {
    EXPECT_EQ(lamp_return(0), 0);
    EXPECT_FLOAT_EQ(lamp_return(15), 1);
    for (u32 level = 2; level < 15; ++level) {
        const float s = float(level - 1) / 15, most = 14.0f / 15;
        EXPECT_NEAR(lamp_return(level), s * (0.16f + 1.24f * s) / (most * (0.16f + 1.24f * most)), 1e-6f);
        EXPECT_LT(lamp_return(level), lamp_return(level + 1));
    }
    EXPECT_GT(lamp_return(1), 0);
}

} // namespace
} // namespace vitrail::trace
