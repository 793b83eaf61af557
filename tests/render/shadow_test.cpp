// Shadows of the sun against analysis: where they end, how soft, that nothing lit is dark and nothing inside is lit.
#include "shadow_scene.h"

#include <algorithm>

namespace vitrail::render {

// Blocks with caves, overhangs and towers: every pixel has the light that a ray to the sun says, but within two texels
// of where rays change their mind. Near and far, so that all cascades and their seams take part.
TEST_F(ShadowTest, AgreesWithRaysOverLand) {
    BoxScene scene;
    Rng rng(3);
    for (i32 z = -40; z < 40; ++z)
        for (i32 x = -40; x < 40; ++x) {
            const float hill = 3 * std::sin(float(x) * 0.31f) * std::cos(float(z) * 0.23f) + 2 * rng.unit();
            scene.fill({x, -4, z}, {x, i32(hill), z}, "white");
            if (rng.unit() < 0.02f) scene.fill({x, 1, z}, {x, 3 + i32(rng.unit() * 8), z}, "white");
            if (rng.unit() < 0.02f) scene.set(x, 7, z, "white");
        }
    auto renderer = make_renderer();
    ASSERT_TRUE(renderer);
    scene.give(*renderer);
    u32 compared = 0, dark = 0;
    for (const Vec3 sun : {Vec3{0.4f, 1, 0.3f}, Vec3{-1, 0.45f, 0.25f}, Vec3{0.3f, 0.15f, -1}}) {
        const Vec3 eye{0.3f, 12.4f, -30.2f}, toward = normalized(sun);
        const scene::FrameView frame = frame_of(eye, 10, 20, sun, 120, 90);
        const Effects e = effects(1);
        const Sunlight light = sunlight(*renderer, frame, e);
        const auto ends = cascade_ends(3, e.shadows.distance);
        u32 wrong = 0;
        for (u32 y = 0; y < frame.height; ++y)
            for (u32 x = 0; x < frame.width; ++x) {
                if (!light.seen(x, y)) continue;
                const Vec3 ray = pixel_ray(frame, x, y);
                const auto hit = scene.trace(eye, ray, 200);
                if (!hit || hit->distance > 80) continue;
                // Where the rasterizer and the ray took different sides of an edge, nothing can be compared.
                const auto& m = frame.views[0].rotation.m;
                const float along = -(m[2] * ray.x + m[6] * ray.y + m[10] * ray.z) * hit->distance;
                if (std::abs(light.depth[std::size_t(y) * frame.width + x] - along) > 2e-4f * along) continue;
                const Vec3 n{float(hit->normal.x), float(hit->normal.y), float(hit->normal.z)};
                const Vec3 at = eye + ray * hit->distance + n * 1e-3f;
                if (dot(n, toward) < 0.02f) continue;
                // The next cascade may have a say in the last tenth.
                const float texel = 2.3f / 1024 *
                                    (hit->distance < ends[0] * 0.9f   ? ends[0] + 3
                                     : hit->distance < ends[1] * 0.9f ? ends[1] + 3
                                                                      : ends[2] + 3);
                // Neighbors in the light's own plane.
                const Vec3 a = normalized(cross(toward, {0.3f, 0.1f, 1})), b = cross(toward, a);
                u32 open = 0, rays = 0;
                for (float u = -2; u <= 2; u += 1)
                    for (float v = -2; v <= 2; v += 1, ++rays) {
                        // On the surface: moved along the light until the plane is met again.
                        const Vec3 aside = a * (u * texel) + b * (v * texel);
                        const Vec3 from = at + n * (1.8f * texel) + aside - toward * (dot(aside, n) / dot(toward, n));
                        open += !scene.trace(from, toward, 120) &&
                                !scene.solid(i32(std::floor(from.x)), i32(std::floor(from.y)), i32(std::floor(from.z)));
                    }
                if (open != 0 && open != rays) continue;
                ++compared;
                dark += open == 0;
                wrong += open == 0 ? light.at(x, y).x > 0.02f : light.at(x, y).x < 0.98f;
            }
        // A gap between two corners may be narrower than the rays' spacing.
        EXPECT_LE(wrong, 1u) << "sun " << sun.x << " " << sun.y << " " << sun.z;
    }
    EXPECT_GT(compared, 6000u);
    EXPECT_GT(dark, 1000u);
}

// A pillar's shadow on a floor: every pixel farther than a texel from the true outline is right.
TEST_F(ShadowTest, OutlineLiesWithinATexel) {
    BoxScene scene;
    scene.fill({-24, -1, -24}, {24, -1, 24}, "white");
    scene.fill({0, 0, 0}, {0, 5, 0}, "white");
    auto renderer = make_renderer();
    ASSERT_TRUE(renderer);
    scene.give(*renderer);
    const Vec3 sun = normalized(Vec3{0.8f, 1.0f, 0.37f});
    const Vec3 eye{-1.2f, 9.3f, -0.8f};
    const scene::FrameView frame = frame_of(eye, 0, 90, sun, 160, 120);
    for (i32 samples : {1, 16}) {
        const Effects e = effects(samples, 0);
        const Sunlight light = sunlight(*renderer, frame, e);
        const float texel = float(place_shadow_map({}, frame.views[0].eye, sun, cascade_ends(3, 96)[0], 1024).texel);
        u32 edge = 0, wrong = 0, dark = 0;
        for (u32 y = 0; y < frame.height; ++y)
            for (u32 x = 0; x < frame.width; ++x) {
                const Vec3 at = eye + on_plane(frame, x, y, 9.3f);
                if (length(at - eye) > cascade_ends(3, 96)[0] * 0.9f) continue;
                if (std::abs(light.depth[std::size_t(y) * frame.width + x] - 9.3f) > 0.01f) continue; // the pillar
                // The true outline, and a texel (in the light's plane; longer on the floor) to each side.
                auto shaded = [&](float dx, float dz) {
                    return scene.trace({at.x + dx, 1e-4f, at.z + dz}, sun, 50).has_value();
                };
                const bool here = shaded(0, 0);
                const float r = 1.1f * texel, l = r / sun.y;
                const Vec2 along = {sun.x / std::hypot(sun.x, sun.z), sun.z / std::hypot(sun.x, sun.z)};
                bool sure = true;
                for (float s : {-1.0f, 1.0f})
                    for (float t : {-1.0f, 0.0f, 1.0f})
                        sure = sure &&
                               shaded(s * l * along.x - t * r * along.y, s * l * along.y + t * r * along.x) == here &&
                               shaded(-s * r * along.y, s * r * along.x) == here;
                if (!sure) {
                    ++edge;
                    continue;
                }
                dark += here;
                wrong += here != (light.at(x, y).x < 0.5f);
            }
        EXPECT_EQ(wrong, 0u) << samples;
        EXPECT_GT(edge, 10u);
        EXPECT_GT(dark, 150u);
    }
}

// The outline of a roof's shadow grows soft as the sun's disc says: mean |share - step| over the profile is 4 R / 3 pi
// for a disc of radius R.
TEST_F(ShadowTest, PenumbraGrowsWithDistance) {
    const Vec3 sun = normalized(Vec3{0.5f, 1, 0});
    for (float softness : {1.0f, 2.0f})
        for (i32 height : {4, 12}) {
            BlockRegistry registry;
            registry.content_roots = {test_content()};
            const TextureId white = registry.texture_id("white");
            auto renderer = make_renderer();
            ASSERT_TRUE(renderer);
            ASSERT_TRUE(renderer->load_textures(registry));
            give_floor(*renderer, white, -1, 15, 2); // y = 0
            renderer->set_section({0, 0, 0}, {},
                                  quads_of(QuadPass::opaque, {{3, Quad::cube({0, height - 1, 0}, 16, 16, Face::up, 255,
                                                                             white, TintKind::none, 0)}}));
            // The roof's edge x = 0 casts to x = -height / 2. Looked at from straight above.
            const float edge = -float(height) * 0.5f;
            scene::FrameView frame = frame_of({edge, 6, 8}, 0, 90, sun, 480, 60);
            frame.views[0].fov_y = 2 * std::atan(0.5f * 60 / 480 * 1.6f / 6); // 1.6 blocks wide
            const Effects e = effects(32, softness);
            const Sunlight light = sunlight(*renderer, frame, e);
            // With few samples too the outline is a gradient, not grains: along the edge all pixels are alike.
            const Sunlight few = sunlight(*renderer, frame, effects(8, softness));
            double sum = 0;
            for (u32 x = 0; x < frame.width; ++x) {
                double share = 0, mean = 0, squares = 0;
                for (u32 y = 0; y < frame.height; ++y) {
                    share += double(light.at(x, y).x) / frame.height;
                    mean += double(few.at(x, y).x) / frame.height;
                    squares += double(few.at(x, y).x) * double(few.at(x, y).x) / frame.height;
                }
                EXPECT_LT(std::sqrt(std::max(squares - mean * mean, 0.0)), 0.06) << "column " << x;
                const Vec3 at = on_plane(frame, x, 30, 6);
                sum += std::abs(share - (at.x < 0 ? 1.0 : 0.0)) * (1.6 / frame.width);
            }
            const double radius = sum * 3 * 3.14159265 / 4 * double(sun.y); // across the light
            const double wanted = double(height) / double(sun.y) * double(kSunTangent) * double(softness);
            EXPECT_NEAR(radius, wanted, 0.12 * wanted + 0.012) << "softness " << softness << ", height " << height;
        }
}

// A floor under suns from straight above to 85 degrees down: lit everywhere, near and far.
TEST_F(ShadowTest, NoAcneOnSlopes) {
    BlockRegistry registry;
    registry.content_roots = {test_content()};
    const TextureId white = registry.texture_id("white");
    auto renderer = make_renderer();
    ASSERT_TRUE(renderer);
    ASSERT_TRUE(renderer->load_textures(registry));
    give_floor(*renderer, white, -1, 15, 6);
    for (const Effects& e : {effects(1), effects(8, 4)})
        for (float slope : {0.0f, 15.0f, 30.0f, 45.0f, 60.0f, 70.0f, 80.0f, 85.0f})
            for (float turn : {0.4f + slope}) {
                const float a = slope * 0.017453293f;
                const Vec3 sun{std::sin(a) * std::cos(turn), std::cos(a), std::sin(a) * std::sin(turn)};
                const scene::FrameView frame = frame_of({0.37f, 1.62f, 0.21f}, 30, 8, sun, 64, 48);
                const Sunlight light = sunlight(*renderer, frame, e);
                u32 seen = 0;
                float least = 1;
                for (u32 y = 0; y < frame.height; ++y)
                    for (u32 x = 0; x < frame.width; ++x)
                        if (light.seen(x, y)) ++seen, least = std::min(least, light.at(x, y).x);
                EXPECT_GT(least, 0.99f) << "slope " << slope << " turn " << turn << " samples " << e.shadows.samples;
                EXPECT_GT(seen, 1000u);
            }
}

// Tilted quads of models, whose normals are only bytes.
TEST_F(ShadowTest, NoAcneOnTiltedModels) {
    BlockRegistry registry;
    registry.content_roots = {test_content()};
    const TextureId white = registry.texture_id("white");
    for (float tilt : {10.0f, 22.5f, 37.0f, 45.0f, 60.0f, 75.0f, 85.0f}) {
        auto renderer = make_renderer();
        ASSERT_TRUE(renderer);
        ASSERT_TRUE(renderer->load_textures(registry));
        const float a = tilt * 0.017453293f;
        const Vec3 n{std::sin(a), std::cos(a), 0}, along{std::cos(a), -std::sin(a), 0};
        scene::ModelQuad quad;
        const float corner[4][2] = {{0, 0}, {0, 1}, {1, 1}, {1, 0}};
        for (u32 k = 0; k < 4; ++k) {
            const Vec3 p = along * (corner[k][0] * 6) + Vec3{0, 8, corner[k][1] * 10};
            quad.corners[k] = {i16(p.x * 256), i16(p.y * 256), i16(p.z * 256), 0};
        }
        quad.normal = {i8(std::lround(n.x * 127)), i8(std::lround(n.y * 127)), 0};
        scene::BlockModels models;
        const u32 index = models.intern_quad(quad);
        renderer->sync_models(models);
        renderer->set_section(
            {0, 0, 0}, {}, quads_of(QuadPass::opaque, {{6, Quad::model({4, 0, 2}, index, white, TintKind::none, 0)}}));
        const Vec3 middle = Vec3{4, 8, 7} + along * 3, eye = middle + n * 5;
        const scene::FrameView frame = frame_of(eye, 90, 90 - tilt, {0, 1, 0}, 64, 64); // looks along -n
        const Sunlight light = sunlight(*renderer, frame, effects(8));
        u32 seen = 0;
        float least = 1;
        for (u32 y = 0; y < 64; ++y)
            for (u32 x = 0; x < 64; ++x)
                if (light.seen(x, y)) ++seen, least = std::min(least, light.at(x, y).x);
        EXPECT_GT(least, 0.98f) << "tilt " << tilt;
        EXPECT_GT(seen, 800u) << "tilt " << tilt;
    }
}

// A closed room with walls of one block: no pixel of it gets any sun.
TEST_F(ShadowTest, NothingLeaksIntoARoom) {
    BoxScene scene;
    scene.fill({-6, 0, -6}, {6, 6, 6}, "white");
    for (i32 y = 1; y <= 5; ++y)
        for (i32 z = -5; z <= 5; ++z)
            for (i32 x = -5; x <= 5; ++x)
                scene.clear(x, y, z);
    auto renderer = make_renderer();
    ASSERT_TRUE(renderer);
    scene.give(*renderer);
    for (const Vec3 sun : {Vec3{0.1f, 1, 0.2f}, Vec3{1, 0.5f, 0.4f}, Vec3{-0.3f, 0.1f, 1}})
        for (float yaw : {45.0f, 225.0f})
            for (const Effects& e : {effects(1), effects(16, 3)}) {
                const Sunlight light = sunlight(*renderer, frame_of({0.4f, 3.3f, 0.2f}, yaw, 25, sun), e);
                u32 seen = 0;
                float most = 0;
                for (u32 y = 0; y < light.height; ++y)
                    for (u32 x = 0; x < light.width; ++x)
                        if (light.seen(x, y)) ++seen, most = std::max(most, light.at(x, y).x);
                EXPECT_LT(most, 1e-3f) << "sun " << sun.x << " " << sun.y << " yaw " << yaw;
                EXPECT_GT(seen, 3000u);
            }
}

// Where no light of the sky comes there is no sun, even without anything that casts; beyond the maps light levels
// decide.
TEST_F(ShadowTest, NoSkyNoSun) {
    BlockRegistry registry;
    registry.content_roots = {test_content()};
    const TextureId white = registry.texture_id("white");
    auto renderer = make_renderer();
    ASSERT_TRUE(renderer);
    ASSERT_TRUE(renderer->load_textures(registry));
    give_floor(*renderer, white, -1, 15, 9);
    const scene::FrameView frame = frame_of({8, 3, 8}, 0, 5, {0.3f, 1, 0.2f}, 64, 96);
    auto shares = [&](u32 sky) {
        LightBrick brick;
        brick.uniform = true, brick.value = Light(15, 0, 0, 0);
        const Effects e = effects(4);
        std::pair<float, float> out{-1, -1}; // near, and beyond the maps
        for (i32 z = -9; z <= 9; ++z)
            for (i32 x = -9; x <= 9; ++x)
                renderer->set_section_light({x, -1, z}, {}, brick);
        // Full light as the measure, then the asked level.
        EXPECT_TRUE(renderer->set_effects(e));
        renderer->set_background(true);
        const TargetPixels full = color(*renderer, frame);
        brick.value = Light(sky, 0, 0, 0);
        for (i32 z = -9; z <= 9; ++z)
            for (i32 x = -9; x <= 9; ++x)
                renderer->set_section_light({x, -1, z}, {}, brick);
        const TargetPixels now = color(*renderer, frame);
        for (u32 y = 0; y < 96; ++y) {
            const float away = length(on_plane(frame, 32, y, 3));
            if (pixel_ray(frame, 32, y).y > -1e-3f) continue;
            const float share = (now.at(32, y)[0] - 0.01f) / std::max(full.at(32, y)[0] - 0.01f, 1e-3f);
            if (away < 60) out.first = share;
            if (away > 100 && away < 140 && out.second < 0) out.second = share;
        }
        return out;
    };
    const auto none = shares(0), some = shares(8), all = shares(15);
    EXPECT_LT(none.first, 0.03f);
    EXPECT_LT(none.second, 0.03f);
    EXPECT_GT(some.first, 0.9f); // the map says lit
    EXPECT_LT(some.second, 0.03f);
    EXPECT_NEAR(all.first, 1, 0.01f);
    EXPECT_NEAR(all.second, 1, 0.01f);
}

// Red glass over a white floor: red light; red over green: the product of both.
TEST_F(ShadowTest, GlassColorsTheLight) {
    BlockRegistry registry;
    registry.content_roots = {test_content()};
    const TextureId white = registry.texture_id("white");
    for (const char* name : {"red", "green", "glass"})
        registry.texture_id(name);
    auto renderer = make_renderer();
    ASSERT_TRUE(renderer);
    ASSERT_TRUE(renderer->load_textures(registry));
    give_floor(*renderer, white, -1, 15, 2);
    auto mean_through = [&](std::vector<std::pair<i32, const char*>> panes, bool colored) {
        std::vector<std::pair<u32, Quad>> quads;
        for (const auto& [y, name] : panes) // tops, and undersides as a block of glass has them
            for (Face f : {Face::up, Face::down})
                quads.emplace_back(u32(f),
                                   Quad::cube({0, y, 0}, 16, 16, f, 255, registry.texture_id(name), TintKind::none, 0));
        renderer->set_section({0, 0, 0}, {}, quads_of(QuadPass::translucent, quads));
        const scene::FrameView frame = frame_of({8, 3, 8}, 0, 90, {0.2f, 1, 0.1f}, 64, 64);
        Effects e = effects(8);
        e.shadows.colored = colored;
        const Sunlight light = sunlight(*renderer, frame, e);
        Vec3 sum{};
        for (const Vec3& share : light.share)
            sum += share * (1.0f / float(light.share.size()));
        return sum;
    };
    const Vec3 red = mean_through({{10, "red"}}, true), green = mean_through({{13, "green"}}, true);
    EXPECT_GT(red.x, 0.8f);
    EXPECT_LT(std::max(red.y, red.z), 0.1f);
    EXPECT_GT(green.y, 0.8f);
    EXPECT_LT(std::max(green.x, green.z), 0.1f);
    const Vec3 glass = mean_through({{9, "glass"}}, true);
    EXPECT_GT(std::min({glass.x, glass.y, glass.z}), 0.6f);
    const Vec3 both = mean_through({{10, "glass"}, {13, "glass"}}, true);
    for (auto c : {&Vec3::x, &Vec3::y, &Vec3::z})
        EXPECT_NEAR(both.*c, glass.*c * (glass.*c), 0.02f);
    const Vec3 crossed = mean_through({{10, "red"}, {13, "green"}}, true);
    for (auto c : {&Vec3::x, &Vec3::y, &Vec3::z})
        EXPECT_NEAR(crossed.*c, red.*c * (green.*c), 0.02f);
    const Vec3 off = mean_through({{10, "red"}}, false);
    EXPECT_GT(std::min({off.x, off.y, off.z}), 0.98f);
    // What lies nearer to the sun than the glass keeps its light.
    renderer->set_section(
        {0, 0, 0}, {},
        quads_of(QuadPass::opaque, {{3, Quad::cube({0, 1, 0}, 16, 16, Face::up, 255, white, TintKind::none, 0)}}));
    SectionMesh under =
        quads_of(QuadPass::translucent,
                 {{3, Quad::cube({0, 14, 0}, 16, 16, Face::up, 255, registry.texture_id("red"), TintKind::none, 0)}});
    renderer->set_section({0, -1, 0}, {}, under);
    const Sunlight above = sunlight(*renderer, frame_of({8, 5, 8}, 0, 90, {0.2f, 1, 0.1f}, 16, 16), effects(8));
    EXPECT_GT(above.at(8, 8).y, 0.99f);
}

// Light on the floor of water grows weaker and bluer with depth.
TEST_F(ShadowTest, WaterTakesLightByDepth) {
    Vec3 before{1, 1, 1};
    for (i32 depth : {1, 4, 12}) {
        BlockRegistry registry;
        registry.content_roots = {test_content()};
        const TextureId white = registry.texture_id("white"), water = registry.texture_id("water_still");
        auto renderer = make_renderer();
        ASSERT_TRUE(renderer->load_textures(registry));
        give_floor(*renderer, white, -1, 15, 2);
        const SectionMesh sheet = quads_of(
            QuadPass::translucent,
            {{3, Quad::cube({0, depth - 1, 0}, 16, 16, Face::up, 255, water, TintKind::none, 0, kQuadLiquid)}});
        for (i32 z = -1; z <= 1; ++z)
            for (i32 x = -1; x <= 1; ++x)
                renderer->set_section({x, 0, z}, {}, sheet);
        const Vec3 sun = normalized(Vec3{0.3f, 1, 0.2f});
        const Sunlight light = sunlight(*renderer, frame_of({8, 0.8f, 8}, 0, 90, sun, 16, 16), effects(8));
        const Vec3 share = light.at(8, 8);
        EXPECT_LT(share.x, before.x - 0.02f);
        EXPECT_LT(share.x, share.y);
        EXPECT_LT(share.y, share.z);
        EXPECT_GT(share.z, 0.2f);
        before = share;
    }
}

// Leaves let through the share of light that their texture has holes, near and far.
TEST_F(ShadowTest, CutoutCastsItsHoles) {
    BlockRegistry registry;
    registry.content_roots = {test_content()};
    const TextureId white = registry.texture_id("white"), leaves = registry.texture_id("oak_leaves");
    const auto image = read_png(test_content() + "/textures/oak_leaves.png");
    ASSERT_TRUE(image);
    double holes = 0;
    for (u32 y = 0; y < image->height; ++y)
        for (u32 x = 0; x < image->width; ++x)
            holes += (image->at(x, y)[3] < 128) / double(image->width * image->height);
    ASSERT_GT(holes, 0.1);
    auto renderer = make_renderer();
    ASSERT_TRUE(renderer->load_textures(registry));
    give_floor(*renderer, white, -1, 15, 3);
    const SectionMesh sheet =
        quads_of(QuadPass::cutout, {{3, Quad::cube({0, 5, 0}, 16, 16, Face::up, 255, leaves, TintKind::none, 0)}});
    for (i32 z = -2; z <= 2; ++z)
        for (i32 x = -2; x <= 2; ++x)
            renderer->set_section({x, 0, z}, {}, sheet);
    for (const Vec3 eye : {Vec3{8, 3, 8}, Vec3{8, 30, 8}, Vec3{8, 70, 8}}) {
        scene::FrameView frame = frame_of(eye, 0, 90, {0.25f, 1, 0.15f}, 128, 128);
        frame.views[0].fov_y = 2 * std::atan(4 / eye.y); // 8 blocks of floor
        if (eye.y > 6) // the leaves are in the way: look from below the sheet through its own section being far
            frame.views[0].clip_plane = {0, -1, 0, -(eye.y - 4)};
        const Sunlight light = sunlight(*renderer, frame, effects(8));
        double sum = 0;
        for (const Vec3& share : light.share)
            sum += double(share.x) / double(light.share.size());
        EXPECT_NEAR(sum, holes, 0.04) << "eye " << eye.y;
    }
}

// The moon casts at night as the sun does by day.
TEST_F(ShadowTest, MoonCastsToo) {
    BoxScene scene;
    scene.fill({-16, -1, -16}, {16, -1, 16}, "white");
    scene.fill({-2, 4, -2}, {2, 4, 2}, "white");
    auto renderer = make_renderer();
    scene.give(*renderer);
    const Sunlight light = sunlight(*renderer, frame_of({0.5f, 3, 0.5f}, 0, 90, {0.1f, -1, 0.05f}, 33, 33), effects(8));
    EXPECT_LT(light.at(16, 16).x, 1e-3f);
}

// Small steps of the eye, and turning, leave every texel as it was; long ones show the same texels elsewhere.
TEST_F(ShadowTest, TexelsStayWhereTheyAre) {
    bench::SampleScene scene(2);
    scene.registry.content_roots = {test_content()};
    auto renderer = make_renderer();
    ASSERT_TRUE(renderer);
    scene.give(*renderer);
    ASSERT_TRUE(renderer->load_textures(scene.registry));
    Effects e = effects(1);
    e.shadows.cascades = 1, e.shadows.size = 256, e.shadows.distance = 16;
    ASSERT_TRUE(renderer->set_effects(e));
    const Vec3 sun = normalized(Vec3{0.4f, 1, 0.3f});
    const float up = float(scene.ground(6, 8)) + 3;
    auto frame_at = [&](float x, float yaw) { return frame_of({x, up, 8.3f}, yaw, 20, sun, 32, 32); };
    auto texels = [&](float x, float yaw) {
        EXPECT_TRUE(renderer->render(frame_at(x, yaw)));
        auto depth = renderer->read_target("shadow_depth");
        EXPECT_TRUE(depth);
        return depth ? depth->values : std::vector<float>();
    };
    const std::vector<float> first = texels(6, 0);
    const auto [low, high] = std::minmax_element(first.begin(), first.end());
    ASSERT_GT(*high - *low, 0.1f);
    for (float step : {0.003f, 0.01f, 0.07f, 0.4f})
        EXPECT_EQ(texels(6 + step, step * 400), first) << step;
    const float radius = cascade_ends(1, 16)[0];
    const auto at = [&](float x) { return frame_at(x, 0).views[0].eye; };
    const ShadowMapPlace before = place_shadow_map({}, at(6), sun, radius, 256);
    // What of the section lies at the map's border may or may not be drawn: its inside is compared.
    for (float x : {10.137f, 12.71f, 18.03f}) {
        if (covers(before, at(x), radius)) ADD_FAILURE() << "the map need not move for " << x;
        renderer->forget_frames();
        const std::vector<float> fresh = texels(6, 0);
        EXPECT_EQ(fresh, first);
        const std::vector<float> moved = texels(x, 0);
        const ShadowMapPlace now = place_shadow_map(before, at(x), sun, radius, 256);
        const i32 du = i32(now.u - before.u), dv = i32(now.v - before.v);
        ASSERT_TRUE(du != 0 || dv != 0);
        const double rise = double(now.w - before.w) * before.texel / before.depth_range();
        u32 same = 0, other = 0;
        for (i32 v = 0; v < 256; ++v)
            for (i32 u = 0; u < 256; ++u) {
                if (u + du < 0 || u + du > 255 || v + dv < 0 || v + dv > 255) continue;
                const float a = first[std::size_t(255 - v - dv) * 256 + std::size_t(u + du)];
                const float b = moved[std::size_t(255 - v) * 256 + std::size_t(u)];
                if (a <= 0 || b <= 0 || a >= 1 || b >= 1) continue; // held at the ends of depth
                (std::abs(double(b) - double(a) - rise) < 2e-5 ? same : other) += 1;
            }
        EXPECT_EQ(other, 0u) << x;
        EXPECT_GT(same, 10000u);
    }
}

// A block that is set casts in the next frame, one taken away no more; the sun's way is followed.
TEST_F(ShadowTest, FollowsEditsAndTheSun) {
    BlockRegistry registry;
    registry.content_roots = {test_content()};
    const TextureId white = registry.texture_id("white");
    auto renderer = make_renderer();
    ASSERT_TRUE(renderer);
    ASSERT_TRUE(renderer->load_textures(registry));
    renderer->set_background(true);
    give_floor(*renderer, white, -1, 15, 5);
    ASSERT_TRUE(renderer->set_effects(effects(1)));
    // Far from the eye's cascade too: looked at from above.
    for (float height : {6.0f, 60.0f}) {
        auto frame = frame_of({8, height, 8}, 0, 90, {0, 1, 0.2f}, 32, 32);
        auto look = [&] { return color(*renderer, frame).at(16, 15)[0]; };
        const float lit = look();
        renderer->set_section(
            {0, 0, 1}, {},
            quads_of(QuadPass::opaque,
                     {{4, Quad::cube({0, 0, 0}, 16, 16, Face::north, 255, white, TintKind::none, 0)},
                      {5, Quad::cube({0, 0, 0}, 16, 16, Face::south, 255, white, TintKind::none, 0)}}));
        frame.sky.sun_direction = normalized({0, 0.5f, 1}), frame.sky.moon_direction = -frame.sky.sun_direction;
        float shaded = 0;
        for (u32 i = 0; i < 6; ++i)
            shaded = look();
        EXPECT_LT(shaded, lit * 0.3f) << height;
        renderer->remove_section({0, 0, 1}, {});
        float again = 0;
        for (u32 i = 0; i < 6; ++i)
            again = look();
        EXPECT_GT(again, shaded * 3) << height;
    }
    // In steps of a thousandth of a degree, a quarter of a degree in all, no map stays behind.
    renderer->set_section(
        {0, 0, 1}, {},
        quads_of(QuadPass::opaque, {{5, Quad::cube({0, 0, 0}, 16, 16, Face::south, 255, white, TintKind::none, 0)}}));
    auto frame = frame_of({8, 6, 8}, 0, 90, {0, 1, 1}, 32, 32);
    ASSERT_TRUE(renderer->render(frame));
    const auto depth_before = renderer->read_target("shadow_depth");
    ASSERT_TRUE(depth_before);
    u32 drawn = 0;
    for (u32 i = 1; i <= 250; ++i) {
        const float a = 0.78539816f + float(i) * 0.001f * 0.017453293f;
        frame.sky.sun_direction = {0, std::cos(a), std::sin(a)};
        ASSERT_TRUE(renderer->render(frame));
        drawn += renderer->stats().shadow_draws > 0;
    }
    EXPECT_GT(drawn, 3u); // and not in every frame
    EXPECT_LT(drawn, 12u);
}

// Geometry of the maps alone, anywhere in the world.
TEST(ShadowCascades, CoverTheEyeAndAllThatCasts) {
    Rng rng(11);
    auto random = [&](float most) { return (rng.unit() * 2 - 1) * most; };
    for (u32 i = 0; i < 300; ++i) {
        const double far = i % 3 == 0 ? 0 : i % 3 == 1 ? 2.1e9 : 5e5;
        Located<WorldPos> eye;
        eye.at =
            world_pos_from_numbers(far * (rng.unit() - 0.5) * 2, far * (rng.unit() - 0.5), far * (rng.unit() - 0.5));
        const Vec3 sun = normalized(Vec3{random(1), rng.unit(), random(1)});
        const float radius = 4 + 100 * rng.unit();
        const ShadowMapPlace place = place_shadow_map({}, eye, sun, radius, 1024);
        ASSERT_TRUE(covers(place, eye, radius));
        const ShadowRows rows = rows_from_eye(place, eye.at);
        auto row = [](Vec4 r, Vec3 p) { return r.x * p.x + r.y * p.y + r.z * p.z + r.w; };
        for (u32 k = 0; k < 20; ++k) {
            // A point of the ball lies in the map, and the section of anything on its way to the sun may cast.
            const Vec3 p = normalized(Vec3{random(1), random(1), random(1)}) * (radius * rng.unit());
            for (Vec4 r : {rows.u, rows.v, rows.z}) {
                ASSERT_GT(row(r, p), 0);
                ASSERT_LT(row(r, p), 1);
            }
            const WorldPos caster = offset_by(eye.at, p + sun * (300 * rng.unit()));
            ASSERT_TRUE(may_cast(place, chunk_of(block_of(caster))));
            // Drawn and asked for alike.
            const auto draw = rows_from_anchor(place, 1024);
            const Vec3 from_anchor = view_from(corner_of(place.anchor), offset_by(eye.at, p)).v;
            const float u = ((row(draw[0], from_anchor) - draw[3].x) * draw[3].z + 1) / 2;
            const float z = row(draw[2], from_anchor);
            ASSERT_NEAR(u, row(rows.u, p), 2e-5f);
            ASSERT_NEAR(z, row(rows.z, p), 2e-5f);
        }
        ASSERT_FALSE(may_cast(place, chunk_of(block_of(offset_by(eye.at, sun * -(3 * radius + 60))))));
        ASSERT_FALSE(covers(place, {eye.dimension, offset_by(eye.at, {0.2f * radius + 5, 0, 0})}, radius));
    }
    const auto ends = cascade_ends(4, 256);
    EXPECT_NEAR(ends[3], 256, 1e-2f);
    for (u32 i = 1; i < 4; ++i)
        EXPECT_GT(ends[i], 1.8f * ends[i - 1]);
}

} // namespace vitrail::render
