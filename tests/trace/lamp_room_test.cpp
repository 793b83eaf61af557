// Rooms that one lamp of the base content lights: as bright in sum as the raster renderer shows them by light levels.
#include "tests/trace/content_fixture.h"

#include "math/color.h"
#include "scene/lamp_light.h"
#include "tests/trace/statistics.h"
#include "trace/kernel/path.h"
#include "trace/lights/light_store.h"

#include <cmath>
#include <cstdlib>
#include <gtest/gtest.h>
#include <memory>

namespace vitrail::trace {
namespace {

struct Lamp {
    const char* state;
    bool ceiling; // in it; else on the floor
};

// A closed room from (1, 1, 1), in one chunk.
struct Room {
    Room(i32 side, i32 height, const Lamp& lamp, const char* wall)
        : side(side)
        , height(height) {
        for (i32 y = 0; y <= height + 1; ++y)
            for (i32 z = 0; z <= side + 1; ++z)
                for (i32 x = 0; x <= side + 1; ++x)
                    if (x == 0 || y == 0 || z == 0 || x > side || y > height || z > side) chunk.set(x, y, z, wall);
        const i32 middle = 1 + side / 2;
        at = {middle, lamp.ceiling ? height + 1 : 1, middle};
        chunk.set(at.x, at.y, at.z, lamp.state);
        levels = base_content().states->info(StateId(base_content().id(lamp.state))).look->light;
        view = chunk.lit_scene(lights);
    }
    // What the raster renderer shows there, as white: levels fall by one a step, in corners as anywhere.
    Vec3 shown(IVec3 cell) const {
        const i32 steps = std::abs(cell.x - at.x) + std::abs(cell.y - at.y) + std::abs(cell.z - at.z);
        const auto share = [&](u8 level) { return float(std::max(i32(level) - steps, 0)) / scene::kLevelMost; };
        return scene::lamp_light({share(levels[0]), share(levels[1]), share(levels[2])});
    }

    i32 side, height;
    IVec3 at{};
    std::array<u8, 3> levels{};
    ContentChunk chunk;
    SceneView view;
    LightStore lights;
};

struct Brightness {
    double traced = 0, shown = 0; // means of luminance around the eye
};

// All around from an eye in the room, but for the lamp itself.
Brightness brightness_of(const Room& room, Vec3 eye, u32 samples) {
    PathSettings settings;
    settings.fog = false;
    SkyView sky;
    sky.open = false;
    Brightness sum;
    for (u32 i = 0; i < samples; ++i) {
        PathState path;
        path.sampler = make_sampler(i & 63, i >> 6, 0, 1);
        const Vec2 u = next_2d(path.sampler);
        const float y = 1 - 2 * u.x, r = std::sqrt(std::max(0.0f, 1 - y * y));
        const Vec2 turn = on_circle(u.y);
        path.ray = {moved({{0, 0, 0}, {}}, eye, 1), {r * turn.x, y, r * turn.y}};
        Hit first;
        EXPECT_TRUE(closest_hit(room.view, path.ray, kFar, 0, first));
        const SurfacePoint p = surface_at(room.view, path.ray, first, 0);
        if (luminance_of(p.emission) == 0) {
            const Vec3 ambient{0.0200f, 0.0210f, 0.0240f}; // shade.glsl
            sum.shown += double(luminance_of(p.albedo * (room.shown(p.at.cell) + ambient)));
        }
        PixelSample found{};
        const auto send = [&](const LightRay& to) {
            Vec3 value = to.value;
            if (light_passes(room.view, to.ray, to.distance, to.medium, value))
                add_arrived(found, to.counts, value, settings);
        };
        for (bool on = true; on;) {
            Hit hit;
            if (!closest_hit(room.view, path.ray, kFar, path.medium, hit)) {
                ADD_FAILURE() << "the room is closed";
                break;
            }
            on = path_event(room.view, sky, settings, 0, hit, path, found, send);
        }
        sum.traced += double(luminance_of(found.light));
    }
    return {sum.traced / samples, sum.shown / samples};
}

TEST(LampRoom, IsAsBrightAsLevelsShowIt) {
    const Lamp lamps[] = {{"glowstone", true}, {"sea_lantern", true}, {"torch", false}, {"lantern", false}};
    double product = 1;
    int rooms = 0;
    for (const Lamp& lamp : lamps)
        for (const auto& [side, height] : {std::pair{5, 4}, {9, 5}, {13, 6}}) {
            const Room room(side, height, lamp, "stone_bricks");
            const Brightness b = brightness_of(room, {1.6f, 2.7f, 1.6f}, 4096);
            const double ratio = b.traced / b.shown;
            EXPECT_GT(ratio, 1 / 2.8) << lamp.state << " in " << side << " blocks";
            EXPECT_LT(ratio, 2.8) << lamp.state << " in " << side << " blocks";
            product *= ratio, ++rooms;
        }
    // What hangs in a ceiling sends light to one side alone and is darker than its levels, what stands free brighter;
    // both together are alike.
    EXPECT_NEAR(std::log(product) / rooms, 0, std::log(1.4));
}

} // namespace
} // namespace vitrail::trace
