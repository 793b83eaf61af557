// Lamps of the base content light a wall that faces them as emission.h promises, by rays through the grid.
#include "tests/trace/content_fixture.h"

#include "math/color.h"
#include "scene/lamp_light.h"
#include "trace/content/emission.h"
#include "trace/kernel/lights.h"
#include "trace/kernel/sampler.h"
#include "trace/kernel/surface.h"
#include "trace/kernel/traverse.h"
#include "trace/lights/light_store.h"

#include <algorithm>
#include <gtest/gtest.h>

namespace vitrail::trace {
namespace {

// Irradiance over pi in the middle of a wall `distance` blocks from the cell's middle, at its side `face`: even steps
// over the picture that the cell makes on the plane before the wall.
Vec3 wall_return(const SceneView& scene, IVec3 cell, u32 face, u32 steps, float distance) {
    const Vec3 axis = axis_of_face(face), a = face >> 1 == 0 ? Vec3{0, 1, 0} : Vec3{1, 0, 0}, b = cross(axis, a);
    const Vec3 from = Vec3{0.5f, 0.5f, 0.5f} + axis * (distance - 0.01f); // relative to the cell
    Vec3 sum;
    const float wide = 1.2f / (distance - 0.5f), step = wide / float(steps); // at distance 1; the near face is one wide
    for (u32 i = 0; i < steps * steps; ++i) {
        const float u = (float(i % steps) + 0.5f) * step - 0.5f * wide,
                    v = (float(i / steps) + 0.5f) * step - 0.5f * wide;
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
    float share = 1;     // of the return that its level promises
    float least = 0.85f; // of that: what stands before itself is known roughly
};

TEST(TraceEmission, LampsLightTheWallThatFacesThem) {
    const Lamp lamps[] = {
        {"glowstone"},
        {"sea_lantern"},
        {"shroomlight"},
        {"lava", 1 / kAlike},
        {"redstone_lamp[lit=true]"},
        {"copper_bulb[lit=true]"},
        {"magma_block"},
        {"nether_portal"},
        {"furnace[lit=true]"},
        {"jack_o_lantern"},
        {"redstone_torch"},
        {"fire"},
        {"end_rod"},
        {"candle[candles=1,lit=true]"},
        {"candle[candles=4,lit=true]"},
        {"vitrail:cyan_crystal", 1 / kAlike},
        {"torch"},
        {"wall_torch[facing=north]"},
        {"soul_torch"},
        {"lantern"},
        {"soul_lantern"},
        {"campfire", 1, 0.45f},
        {"ender_chest", 1, 0.55f},
    };
    for (const Lamp& lamp : lamps) {
        ContentChunk chunk;
        chunk.set(8, 8, 8, lamp.state);
        const SceneView& view = chunk.scene();
        const auto& light = base_content().states->info(StateId(base_content().id(lamp.state))).look->light;
        const float level = std::max({light[0], light[1], light[2]});
        Vec3 best;
        for (u32 face = 0; face < 6; ++face) {
            const Vec3 found = wall_return(view, {8, 8, 8}, face, 96, scene::lamp_distance(level));
            if (luminance_of(found) > luminance_of(best)) best = found;
        }
        const float share = luminance_of(best) / (scene::lamp_return(level) * lamp.share);
        EXPECT_GT(share, lamp.least) << lamp.state;
        EXPECT_LT(share, 1.15f) << lamp.state;
    }
}

// Lamps that are aimed at bring what rays all over their cell find, though only the parts that shine are aimed at.
TEST(TraceEmission, ShiningPartsBringTheWhole) {
    const struct {
        const char* state;
        float aimed; // share of the samples that find light, at least
    } lamps[] = {{"torch", 0.7f}, {"wall_torch[facing=north]", 0.5f}, {"lantern", 0.25f}, {"campfire", 0.05f}};
    for (const auto& lamp : lamps) {
        ContentChunk chunk;
        chunk.set(8, 8, 8, lamp.state);
        LightStore lights;
        const SceneView view = chunk.lit_scene(lights);
        constexpr u32 kSamples = 16384;
        for (const u32 face : {1u, 4u}) {
            const Vec3 axis = axis_of_face(face), side = -axis;
            const Place at = moved({{8, 8, 8}, {0.5f, 0.5f, 0.5f}}, axis, 2.49f);
            Vec3 sum;
            u32 found = 0;
            for (u32 i = 0; i < kSamples; ++i) {
                Sampler draws = make_sampler(i & 127, i >> 7, 0, 1);
                const float choose = next_1d(draws);
                EmitterSample to;
                if (!sample_emitter(view, at, side, choose, next_2d(draws), to)) continue;
                Hit hit;
                if (!closest_hit(view, {at, to.dir}, kFar, 0, hit) || hit.t < to.distance - 2e-3f) continue;
                const Vec3 light = surface_at(view, {at, to.dir}, hit, 0).emission;
                found += luminance_of(light) > 0;
                sum += light * (std::max(0.0f, dot(to.dir, side)) / (to.pdf * 3.14159265f * float(kSamples)));
            }
            const float want = luminance_of(wall_return(view, {8, 8, 8}, face, 256, 2.5f));
            EXPECT_NEAR(luminance_of(sum), want, 0.08f * want) << lamp.state << " " << face;
            EXPECT_GT(float(found) / kSamples, lamp.aimed) << lamp.state << " " << face;
        }
    }
}

TEST(TraceEmission, LevelsFallAsTheRastersLaw) {
    EXPECT_EQ(scene::lamp_return(0), 0);
    // Level 15: three blocks from its middle, two and a half from its side, 2.5 levels are gone.
    EXPECT_FLOAT_EQ(scene::lamp_distance(15), 3);
    EXPECT_FLOAT_EQ(scene::lamp_return(15), 12.5f / 15 * (0.16f + 1.24f * 12.5f / 15));
    // A dim one: the next block, a level less.
    EXPECT_FLOAT_EQ(scene::lamp_distance(4), 1.5f);
    EXPECT_FLOAT_EQ(scene::lamp_return(4), 3.0f / 15 * (0.16f + 1.24f * 3.0f / 15));
    EXPECT_GT(scene::lamp_return(1), 0);
    // The stronger the level, the more light in all.
    const auto strength = [](float level) {
        const float d = scene::lamp_distance(level);
        return scene::lamp_return(level) * d * d;
    };
    for (float level = 2; level < 15; ++level)
        EXPECT_LT(strength(level), strength(level + 1)) << level;
}

} // namespace
} // namespace vitrail::trace
