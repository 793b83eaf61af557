// Parts of the renderer that need no OpenGL.
#include "base/rng.h"
#include "render/culling.h"
#include "render/draw_list.h"
#include "render/image.h"
#include "render/texture_set.h"

#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <gtest/gtest.h>
#include <unistd.h>

namespace vitrail::render {

// A group is left out only when none of its faces can be seen from anywhere in the eye's block.
TEST(DrawList, FacingDirectionsEqualBruteForce) {
    for (i32 o = -40; o <= 40; ++o)
        for (u32 axis = 0; axis < 3; ++axis) {
            i32 offset[3] = {3, -7, 60};
            offset[axis] = o;
            const u32 mask = facing_directions({offset[0], offset[1], offset[2]});
            bool low = false, high = false;
            for (float eye : {0.0f, 0.01f, 0.5f, 0.99f})
                for (i32 cell = 0; cell < 16; ++cell) {
                    low |= eye < float(o + cell);
                    high |= eye > float(o + cell + 1);
                }
            EXPECT_EQ(bool(mask >> (axis * 2) & 1), low) << o;
            EXPECT_EQ(bool(mask >> (axis * 2 + 1) & 1), high) << o;
            EXPECT_TRUE(mask >> 6 & 1);
        }
}

TEST(DrawList, MergesNeighborsAndSplitsWhatIndicesCannotReach) {
    Section s;
    s.first_quad = 100;
    for (u32 g = 0; g <= SectionMesh::kGroups; ++g)
        s.first[g] = g == 0 ? 0 : g == 1 ? 20000 : 20010;
    s.quad_count = 20010; // group 0 (-x): 20000, group 1 (+x): 10
    DrawList list;
    build_draw_list({{&s, {-4, 0, 0}, 0}}, false, list); // around the eye: both directions
    const auto& cubes = list.commands[u32(DrawKind::opaque_cubes)];
    ASSERT_EQ(cubes.size(), 2u);
    EXPECT_EQ(cubes[0].count, DrawList::kQuadsADraw * 6);
    EXPECT_EQ(cubes[0].base_vertex, 400);
    EXPECT_EQ(cubes[1].count, (20010 - DrawList::kQuadsADraw) * 6);
    build_draw_list({{&s, {40, 0, 0}, 0}}, false, list); // to the east: only -x faces
    EXPECT_EQ(list.quads, 20000u);
    build_draw_list({{&s, {-40, 0, 0}, 0}}, false, list);
    EXPECT_EQ(list.quads, 10u);
}

TEST(Culling, FrustumKeepsEveryBoxWithAVisiblePoint) {
    Rng rng(11);
    u32 kept = 0;
    for (int i = 0; i < 20000; ++i) {
        scene::View view;
        view.rotation = view_rotation(rng.unit() * 6.28f, (rng.unit() - 0.5f) * 3.1f);
        view.fov_y = 0.3f + rng.unit() * 1.5f;
        const float aspect = 0.5f + 2 * rng.unit();
        const Frustum frustum = make_frustum(view, aspect);
        const Vec3 min{rng.unit() * 400 - 200, rng.unit() * 400 - 200, rng.unit() * 400 - 200},
            max = min + Vec3{16, 16, 16};
        const bool kept_box = box_in_frustum(frustum, min, max);
        kept += kept_box;
        for (int k = 0; k < 8 && !kept_box; ++k) {
            const Vec3 p{lerp(min.x, max.x, rng.unit()), lerp(min.y, max.y, rng.unit()),
                         lerp(min.z, max.z, rng.unit())};
            const Vec4 v = view.rotation * Vec4{p.x, p.y, p.z, 1};
            const float t = std::tan(view.fov_y / 2);
            const bool seen = -v.z > 0 && std::abs(v.x) < -v.z * t * aspect && std::abs(v.y) < -v.z * t;
            ASSERT_FALSE(seen) << "a visible box was left out";
        }
    }
    EXPECT_LT(kept, 12000u); // and it does leave out
}

TEST(Textures, MipsKeepTheDensityOfLeaves) {
    Image leaves{32, 32, 4, std::vector<u8>(32 * 32 * 4, 200)};
    Rng rng(5);
    u32 solid = 0;
    for (u32 i = 0; i < 32 * 32; ++i) {
        const bool hole = rng.unit() < 0.45f;
        leaves.pixels[i * 4 + 3] = hole ? 0 : 255;
        solid += !hole;
    }
    const scene::MipChain chain = scene::make_albedo_mips(leaves, 0);
    ASSERT_EQ(chain.levels.size(), scene::PictureFormat{}.levels);
    for (u32 level = 0; level < 4; ++level) {
        const auto& pixels = chain.levels[level];
        u32 passed = 0;
        for (std::size_t i = 3; i < pixels.size(); i += 4)
            passed += pixels[i] >= 128;
        const float texels = float(pixels.size() / 4);
        EXPECT_NEAR(float(passed) / texels, float(solid) / 1024, 1.5f / texels + 0.04f) << "level " << level;
    }
}

TEST(Textures, MipsAverageInLinearLight) {
    Image checks{32, 32, 4, std::vector<u8>(32 * 32 * 4, 255)};
    for (u32 y = 0; y < 32; ++y)
        for (u32 x = 0; x < 32; ++x)
            if ((x + y) % 2) checks.at(x, y)[0] = checks.at(x, y)[1] = checks.at(x, y)[2] = 0;
    const scene::MipChain chain = scene::make_albedo_mips(checks, 0);
    for (u32 level = 1; level < scene::PictureFormat{}.levels; ++level)
        EXPECT_NEAR(chain.levels[level][0], 188, 1); // not 128
}

TEST(Textures, AnimationStripsGiveTheirFrames) {
    Image strip{16, 48, 4, std::vector<u8>(16 * 48 * 4, 255)};
    for (u32 y = 0; y < 48; ++y)
        for (u32 x = 0; x < 16; ++x)
            strip.at(x, y)[0] = u8(10 + y / 16 * 50);
    for (u32 frame = 0; frame < 3; ++frame)
        EXPECT_EQ(scene::make_albedo_mips(strip, frame).levels[0][4 * 500], 10 + frame * 50);
}

class PngFiles : public testing::Test {
protected:
    std::string path = fmt::format("{}/vitrail_png_{}.png", std::filesystem::temp_directory_path().string(), getpid());
    void TearDown() override { std::remove(path.c_str()); }
};

TEST_F(PngFiles, ComeBackAsWritten) {
    Rng rng(2);
    for (u32 channels : {3u, 4u}) {
        Image image{37, 11, channels, std::vector<u8>(37 * 11 * channels)};
        for (u8& p : image.pixels)
            p = u8(rng.below(256));
        ASSERT_TRUE(write_png(path, image));
        const auto back = read_png(path);
        ASSERT_TRUE(back) << back.error().message;
        for (u32 y = 0; y < 11; ++y)
            for (u32 x = 0; x < 37; ++x)
                for (u32 c = 0; c < channels; ++c)
                    ASSERT_EQ(back->at(x, y)[c], image.at(x, y)[c]);
    }
}

TEST_F(PngFiles, BadOnesAreRefused) {
    EXPECT_EQ(read_png("/nowhere/x.png").error().code, ErrorCode::not_found);
    EXPECT_EQ(write_png("/nowhere/x.png", Image{1, 1, 3, {1, 2, 3}}).error().code, ErrorCode::io);
    std::ofstream(path) << "this is no picture";
    EXPECT_EQ(read_png(path).error().code, ErrorCode::damaged);
    ASSERT_TRUE(write_png(path, Image{64, 64, 3, std::vector<u8>(64 * 64 * 3, 7)}));
    std::filesystem::resize_file(path, 60);
    EXPECT_FALSE(read_png(path));
    EXPECT_FALSE(decode_png({}));
}

} // namespace vitrail::render
