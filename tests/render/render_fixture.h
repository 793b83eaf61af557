// One OpenGL context for all tests of the renderer; generated textures, so that pictures do not change with the art.
#pragma once

#include "base/rng.h"
#include "bench/render/sample_scene.h"
#include "gfx/context.h"
#include "platform/headless.h"
#include "render/renderer.h"

#include <cstdlib>
#include <filesystem>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

namespace vitrail::render {

inline Image test_texture(std::array<u8, 3> color, u8 alpha, float holes, u64 seed) {
    Image image{32, 32, 4, std::vector<u8>(32 * 32 * 4)};
    Rng rng(seed);
    for (u32 y = 0; y < 32; y += 2)
        for (u32 x = 0; x < 32; x += 2) {
            const float shade = 0.82f + 0.36f * rng.unit();
            const bool hole = rng.unit() < holes;
            for (u32 k = 0; k < 4; ++k) {
                u8* p = image.at(x + k % 2, y + k / 2);
                for (u32 c = 0; c < 3; ++c)
                    p[c] = u8(std::min(float(color[c]) * shade, 255.0f));
                p[3] = hole ? 0 : alpha;
            }
        }
    return image;
}

inline Image flat_texture(std::array<u8, 3> color, u8 alpha) {
    Image image{32, 32, 4, std::vector<u8>(32 * 32 * 4)};
    for (u32 i = 0; i < 32 * 32; ++i)
        for (u32 c = 0; c < 4; ++c)
            image.pixels[i * 4 + c] = c < 3 ? color[c] : alpha;
    return image;
}

// A folder with textures/ of everything the sample scene shows.
struct TestFolder {
    std::string path;
    ~TestFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(path, ignored);
    }
};

inline const std::string& test_content() {
    static const TestFolder root{[] {
        const std::string folder =
            fmt::format("{}/vitrail_render_test_{}", std::filesystem::temp_directory_path().string(), getpid());
        std::filesystem::create_directories(folder + "/textures");
        struct Entry {
            const char* name;
            std::array<u8, 3> color;
            u8 alpha;
            float holes;
        };
        const Entry entries[] = {{"stone", {128, 128, 130}, 255, 0},
                                 {"dirt", {121, 85, 58}, 255, 0},
                                 {"grass_block_top", {190, 190, 190}, 255, 0},
                                 {"grass_block_side", {112, 110, 60}, 255, 0},
                                 {"sand", {219, 207, 163}, 255, 0},
                                 {"water_still", {150, 170, 200}, 180, 0},
                                 {"oak_log", {102, 81, 50}, 255, 0},
                                 {"oak_log_top", {160, 130, 80}, 255, 0},
                                 {"oak_leaves", {150, 150, 150}, 255, 0.3f},
                                 {"glowstone", {240, 200, 120}, 255, 0},
                                 {"glass", {210, 230, 235}, 60, 0},
                                 {"oak_planks", {162, 131, 79}, 255, 0},
                                 {"red", {255, 0, 0}, 128, 0},
                                 {"green", {0, 255, 0}, 128, 0},
                                 {"white", {210, 210, 210}, 255, 0}};
        (void)write_png(folder + "/textures/flat_white.png", flat_texture({255, 255, 255}, 255));
        (void)write_png(folder + "/textures/flat_red.png", flat_texture({255, 0, 0}, 128));
        (void)write_png(folder + "/textures/flat_blue.png", flat_texture({0, 0, 255}, 128));
        u64 seed = 1;
        for (const Entry& e : entries)
            (void)write_png(folder + "/textures/" + e.name + ".png", test_texture(e.color, e.alpha, e.holes, seed++));
        (void)write_png(folder + "/textures/glowstone_e.png", test_texture({220, 220, 220}, 255, 0, 99));
        return folder;
    }()};
    return root.path;
}

// Quads of one pass, and opaque ones, as a section; direction 6: model quads.
inline SectionMesh quads_of(QuadPass pass, const std::vector<std::pair<u32, Quad>>& quads,
                            const std::vector<std::pair<u32, Quad>>& solid = {}) {
    SectionMesh mesh;
    for (u32 g = 0; g < SectionMesh::kGroups; ++g) {
        mesh.first[g] = u32(mesh.quads.size());
        for (const auto& [direction, quad] : quads)
            if (SectionMesh::group(pass, direction) == g) mesh.quads.push_back(quad);
        for (const auto& [direction, quad] : solid)
            if (SectionMesh::group(QuadPass::opaque, direction) == g) mesh.quads.push_back(quad);
    }
    mesh.first[SectionMesh::kGroups] = u32(mesh.quads.size());
    mesh.connections = (u64(1) << 36) - 1;
    return mesh;
}

class RenderTest : public testing::Test {
protected:
    void SetUp() override {
        static std::unique_ptr<platform::HeadlessContext> context;
        static std::string reason;
        if (!context && reason.empty()) {
            // Pictures are compared with those of Mesa's software renderer, the same on every machine.
            setenv("VITRAIL_GL", "software", 0);
            auto made = platform::HeadlessContext::create();
            if (made)
                context = std::move(*made);
            else
                reason = made.error().message;
        }
        if (!context) GTEST_SKIP() << reason;
        errors_before_ = gfx::debug_error_count();
    }
    void TearDown() override { EXPECT_EQ(gfx::debug_error_count(), errors_before_) << "OpenGL reported errors"; }

    static std::unique_ptr<Renderer> make_renderer(Preset preset = Preset::low) {
        auto made = Renderer::create({.effects = preset_effects(preset), .quad_bytes_start = 16384}); // small, so that it grows
        EXPECT_TRUE(made) << made.error().message;
        return made ? std::move(*made) : nullptr;
    }
    static Image draw(Renderer& renderer, const scene::FrameView& frame) {
        const Result<> drawn = renderer.render(frame);
        EXPECT_TRUE(drawn) << drawn.error().message;
        Result<Image> image = renderer.read_pixels();
        EXPECT_TRUE(image);
        return image ? std::move(*image) : Image{};
    }
    static WorldPos eye_at(double x, double y, double z, ChunkPos base = {}) {
        const WorldPos corner = corner_of(origin_of(base)), local = world_pos_from_numbers(x, y, z);
        return {corner.x + local.x, corner.y + local.y, corner.z + local.z};
    }
    u64 errors_before_ = 0;
};

} // namespace vitrail::render
