// Block pictures on the CPU: what content's files become in memory.
#include "scene/block_pictures.h"

#include <filesystem>
#include <gtest/gtest.h>

namespace vitrail::scene {
namespace {

std::shared_ptr<BlockRegistry> with_textures(std::initializer_list<const char*> names) {
    auto registry = std::make_shared<BlockRegistry>();
    registry->content_roots = {std::string(VITRAIL_SOURCE_DIR) + "/content/base"};
    for (const char* name : names)
        registry->add_texture({name, 2});
    return registry;
}

TEST(BlockPictures, LayersHoldTheFilesTexels) {
    const auto registry = with_textures({"stone", "oak_leaves", "no_such_picture"});
    const BlockPictures pictures = BlockPictures::load(*registry, nullptr);
    EXPECT_EQ(pictures.format.size, 32u);
    EXPECT_EQ(pictures.format.levels, 6u);
    EXPECT_EQ(pictures.layer_words, 1024u + 256 + 64 + 16 + 4 + 1);
    EXPECT_EQ(pictures.missing, std::vector<std::string>{"no_such_picture"});
    for (const char* name : {"stone", "oak_leaves"}) {
        const std::string stem = registry->content_roots[0] + "/textures/" + name;
        const Image albedo = read_png(stem + ".png").value(), normal = read_png(stem + "_n.png").value(),
                    rough = read_png(stem + "_r.png").value();
        const std::size_t layer = std::size_t(*registry->find_texture(name)) * pictures.layer_words;
        for (u32 i = 0; i < 1024; ++i) {
            const u32 a = pictures.albedo[layer + i], m = pictures.material[layer + i];
            if (albedo.pixels[i * 4 + 3] > 0)
                EXPECT_EQ(a & 0xffffff, u32(albedo.pixels[i * 4]) | u32(albedo.pixels[i * 4 + 1]) << 8 |
                                            u32(albedo.pixels[i * 4 + 2]) << 16);
            EXPECT_EQ(a >> 24, albedo.pixels[i * 4 + 3]);
            EXPECT_EQ(m & 255, normal.pixels[i * 4]);
            // Green is up in the file and down here; 128 is flat in both.
            EXPECT_EQ(m >> 8 & 255, std::min(256u - normal.pixels[i * 4 + 1], 255u));
            EXPECT_EQ(m >> 16 & 255, rough.pixels[i * 4]);
            EXPECT_EQ(m >> 24, 0u);
        }
    }
}

TEST(BlockPictures, AnimationsKnowTheirFrames) {
    const auto registry = with_textures({"stone", "lava_still"});
    const BlockPictures pictures = BlockPictures::load(*registry, nullptr);
    ASSERT_EQ(pictures.animations.size(), 1u);
    const PictureAnimation& a = pictures.animations[0];
    EXPECT_EQ(a.layer, u32(*registry->find_texture("lava_still")));
    const u32 frames = u32(a.steps.size());
    EXPECT_EQ(a.ticks, 2 * frames);
    EXPECT_EQ(a.albedo.size(), frames);
    for (u32 tick = 0; tick < 4 * frames; ++tick) { // frame_time 2: two ticks of a twentieth each
        const PictureAnimation::Moment m = a.at((tick + 0.5) / 20);
        EXPECT_EQ(m.from, tick / 2 % frames);
        EXPECT_EQ(m.share, 0u);
    }
    EXPECT_EQ(a.at(-5).from, 0u);

    PictureAnimation blended{
        .layer = 1, .ticks = 12, .interpolate = true, .steps = {{0, 4}, {1, 12}}, .albedo = {}, .material = {}};
    EXPECT_EQ(blended.at(2.5 / 20).share, 128u) << "half of the way to the next";
    EXPECT_EQ(blended.at(2.5 / 20).to, 1u);
    EXPECT_EQ(blended.at(10.5 / 20).from, 1u);
    EXPECT_EQ(blended.at(10.5 / 20).to, 0u) << "round";
    EXPECT_EQ(blended.at(10.5 / 20).share, 6u * 256 / 8);
    MipChain black{{{0, 0, 0, 0}}}, white{{{255, 255, 255, 255}}}, out;
    mix_frames(black, white, 64, out);
    EXPECT_EQ(out.levels[0][0], 64);
}

} // namespace
} // namespace vitrail::scene
