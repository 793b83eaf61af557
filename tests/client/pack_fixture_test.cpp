// The fixture packs over the whole registry of the base game, and a picture with one.
#include "client/packs.h"

#include "base/clock.h"

#include "client/still.h"
#include "formats/fixtures.h"
#include "pipeline/new_world.h"
#include "script/content_loader.h"

#include <chrono>
#include <cmath>
#include <functional>
#include <gtest/gtest.h>
#include <thread>

using namespace vitrail;
namespace fs = std::filesystem;

namespace {

struct PackFixture : testing::Test {
    Content content;
    void SetUp() override {
        const std::vector<fs::path> roots{fs::path(VITRAIL_SOURCE_DIR) / "content/base"};
        auto loaded = load_content(roots);
        ASSERT_TRUE(loaded) << loaded.error().message;
        content = *loaded;
    }
    // All states that the registry's blocks can have, blocks of more than `most` states only with the defaults and each
    // value by itself.
    std::vector<BlockState> all_states(std::size_t most) const {
        std::vector<BlockState> out;
        for (const BlockDef& block : content.registry->blocks()) {
            if (block.name == "vitrail:unknown") continue;
            BlockState plain{block.name, {}};
            std::size_t count = 1;
            for (const PropertyDef& p : block.properties)
                plain.set(p.name, p.default_value), count *= std::max<std::size_t>(p.values.size(), 1);
            if (count <= most) {
                const std::function<void(std::size_t, BlockState&)> each = [&](std::size_t i, BlockState& s) {
                    if (i == block.properties.size()) return out.push_back(s);
                    for (const std::string& value : block.properties[i].values)
                        s.set(block.properties[i].name, value), each(i + 1, s);
                };
                BlockState s = plain;
                each(0, s);
                continue;
            }
            for (const PropertyDef& p : block.properties)
                for (const std::string& value : p.values)
                    out.push_back(plain), out.back().set(p.name, value);
        }
        return out;
    }
};

struct Sums {
    u32 states = 0, changed = 0, by_model = 0, opaque = 0, detailed = 0, varied = 0;
};

double mean_difference(const render::Image& a, const render::Image& b) {
    u64 apart = 0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i)
        apart += u64(std::abs(int(a.pixels[i]) - int(b.pixels[i])));
    return double(apart) / double(a.pixels.size());
}

} // namespace

// Every state compiles with and without the pack; what hides, collides and is picked stays what it is.
TEST_F(PackFixture, EveryStateOfTheBaseGameTakesThePack) {
    const fs::path path = test::fixtures() / "packs/pixel-perfection-ce.zip";
    VX_NEED_FIXTURE(path);
    const auto packs = client::open_packs({path.string()}, *content.registry);
    ASSERT_TRUE(packs) << packs.error().message;
    const scene::PackLooks& looks = **packs;
    EXPECT_EQ(looks.report().problems, 0u) << looks.report().lines[0];
    EXPECT_TRUE(looks.missing().empty()) << looks.missing()[0];

    StateTable states(content.registry);
    Sums sums;
    for (const BlockState& state : all_states(512)) {
        ASSERT_TRUE(states.intern(state));
        ++sums.states;
    }
    scene::BlockModels plain, packed(*packs);
    plain.ensure(states);
    packed.ensure(states);
    ASSERT_LT(packed.model_quad_count(), scene::BlockModels::kMaxModelQuads / 4);
    for (u32 i = 0; i < states.size(); ++i) {
        const StateId id{i};
        ASSERT_EQ(scene::hides(packed.kinds()[i]), scene::hides(plain.kinds()[i])) << states.info(id).state.to_string();
        ASSERT_EQ(packed.kinds()[i] == scene::ModelKind::nothing, plain.kinds()[i] == scene::ModelKind::nothing)
            << states.info(id).state.to_string();
        ASSERT_EQ(packed.liquid(id) != nullptr, plain.liquid(id) != nullptr) << states.info(id).state.to_string();
        sums.opaque += packed.kinds()[i] == scene::ModelKind::opaque;
        sums.detailed += packed.kinds()[i] == scene::ModelKind::detailed;
        sums.by_model += !looks.look(states.info(id)).empty();
        sums.varied += looks.look(states.info(id)).choices.size() > 1;
        bool changed = false;
        const auto see = [&](u64 bits) { changed |= looks.replaces(TextureId(bits >> 32 & 0xffff)); };
        for (const scene::FaceLook look : packed.faces(id))
            see(look);
        for (const scene::StateQuad& q : packed.quads(id)) {
            see(q.bits);
            ASSERT_LT(u32(q.bits >> 32 & 0xffff), looks.texture_count());
        }
        if (const auto* liquid = packed.liquid(id)) see(liquid->still);
        sums.changed += changed;
    }
    // Measured with our content of November 2026: of
    // 29,714 states 1,380 have models of the pack, 1,179 of them several, and 20,951 show a picture of it, the rest
    // being blocks that are newer than the pack or ours. Content grows, so these are floors.
    EXPECT_EQ(looks.counts().blockstates, 84u);
    EXPECT_GE(looks.counts().replaced_textures, 570u);
    EXPECT_GE(looks.counts().own_textures, 104u);
    EXPECT_EQ(looks.counts().made_textures, 1u); // the side of grass
    EXPECT_GE(sums.by_model, 1380u);
    EXPECT_GE(sums.varied, 1179u);
    EXPECT_GE(sums.changed, 20900u);
    EXPECT_GE(sums.states, 29000u);
}

TEST_F(PackFixture, BarePicturesUnderOldNames) {
    const fs::path path = test::fixtures() / "packs/programmerart";
    VX_NEED_FIXTURE(path);
    const auto packs = client::open_packs({path.string()}, *content.registry);
    ASSERT_TRUE(packs) << packs.error().message;
    const scene::PackLooks& looks = **packs;
    EXPECT_EQ(looks.report().problems, 0u) << looks.report().lines[0];
    EXPECT_EQ(looks.counts().blockstates, 0u);
    EXPECT_TRUE(looks.missing().empty());
    EXPECT_GE(looks.counts().replaced_textures,
              346u); // of 430 pictures; the others are blocks that were never in Minecraft, or parts of a block's art
    for (const char* name : {"oak_planks", "stone", "grass_block_top", "dark_oak_log", "light_gray_wool", "poppy",
                             "wheat_stage7", "oak_door_top", "lily_pad"})
        EXPECT_TRUE(looks.replaces(*content.registry->find_texture(name))) << name;
}

// The same view of passing land with both packs over each other and without: another picture, nothing missing.
TEST_F(PackFixture, PicturesOfLandTakeThePack) {
    const fs::path path = test::fixtures() / "packs/pixel-perfection-ce.zip";
    VX_NEED_FIXTURE(path);
    client::StillOptions options;
    options.seed = 7;
    options.view_distance = 2;
    options.effects = render::preset_effects(render::Preset::low);
    options.effects.exposure.automatic = false; // it remembers the picture before
    const auto generator = open_generator(kGeneratorName, kGeneratorVersion, content.terrain.get(), options.seed);
    ASSERT_TRUE(generator);
    const BlockPos spawn = spawn_point(**generator);
    options.pose.eye.at = world_pos_from_numbers(spawn.x + 0.5, spawn.y + 9.0, spawn.z + 0.5);
    options.pose.pitch_deg = 50;
    render::Image images[2];
    for (u32 with = 0; with < 2; ++with) {
        if (with) options.packs = {(test::fixtures() / "packs/programmerart").string(), path.string()};
        auto still = client::Still::open(options, content);
        if (!still && !with) GTEST_SKIP() << still.error().message;
        ASSERT_TRUE(still) << still.error().message;
        EXPECT_EQ((*still)->renderer().missing_textures(), 0u);
        auto image = (*still)->draw(options.pose, 96, 64, 6000);
        ASSERT_TRUE(image);
        images[with] = *image;
        if (!with) continue;
        // Without packs while playing: the first picture again.
        ASSERT_TRUE((*still)->renderer().load_textures(*content.registry));
        (*still)->feeder().set_packs(nullptr);
        const u64 begin = now_ns();
        do {
            ASSERT_TRUE((*still)->replica().poll());
            (*still)->feeder().update((*still)->replica(), block_of(options.pose.eye.at), 50);
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        } while (!(*still)->feeder().settled() && seconds_since(begin) < 60);
        ASSERT_TRUE((*still)->feeder().settled());
        const auto again = (*still)->draw(options.pose, 96, 64, 6000);
        ASSERT_TRUE(again);
        EXPECT_LT(mean_difference(*again, images[0]), 0.5); // dithered
    }
    EXPECT_GT(mean_difference(images[0], images[1]), 5);
}

TEST_F(PackFixture, WhatIsNoPackIsAnErrorInOneLine) {
    const auto none = client::open_packs({"/nowhere/pack.zip"}, *content.registry);
    ASSERT_FALSE(none);
    EXPECT_EQ(none.error().code, ErrorCode::not_found);
    EXPECT_NE(none.error().message.find("/nowhere/pack.zip"), std::string::npos);
    EXPECT_EQ(*client::open_packs({}, *content.registry), nullptr);
}
