// The renderer's sections against the replica's, each meshed directly: after loading, and after edits that make and
// unmake sections of air.
#include "client/section_feeder.h"

#include "base/clock.h"
#include "client/frame_builder.h"
#include "client/local_game.h"
#include "platform/headless.h"
#include "rules/pick.h"
#include "script/content_loader.h"

#include <chrono>
#include <filesystem>
#include <gtest/gtest.h>
#include <thread>
#include <unistd.h>

using namespace vitrail;
namespace fs = std::filesystem;

namespace {

struct FeederTest : testing::Test {
    fs::path folder = fs::temp_directory_path() / ("vitrail_feeder_" + std::to_string(getpid()));
    Content content;
    u64 seed = 7;
    std::unique_ptr<platform::HeadlessContext> context;
    std::unique_ptr<render::Renderer> renderer;
    std::unique_ptr<ThreadPool> pool;
    std::unique_ptr<client::LocalGame> game;
    std::unique_ptr<client::SectionFeeder> feeder;

    void SetUp() override {
        fs::remove_all(folder);
        auto made = platform::HeadlessContext::create();
        if (!made) GTEST_SKIP() << made.error().message;
        context = std::move(*made);
        const std::vector<fs::path> roots{fs::path(VITRAIL_SOURCE_DIR) / "content/base"};
        auto loaded = load_content(roots);
        ASSERT_TRUE(loaded) << loaded.error().message;
        content = *loaded;
    }
    void TearDown() override {
        close();
        fs::remove_all(folder);
    }
    void close() {
        feeder.reset();
        pool.reset();
        game.reset();
        renderer.reset();
    }
    void open(unsigned workers, std::optional<WorldPos> eye = {}) {
        close();
        auto drawn_by = render::Renderer::create({.effects = render::preset_effects(render::Preset::low)});
        ASSERT_TRUE(drawn_by) << drawn_by.error().message;
        renderer = std::move(*drawn_by);
        client::LocalGameOptions options;
        options.server.folder = folder.string();
        options.server.seed = seed;
        options.replica.view_distance = 4;
        if (eye) options.server.start = server::StartPlace{"", *eye};
        auto opened = client::LocalGame::open(options, content);
        ASSERT_TRUE(opened) << opened.error().message;
        game = std::move(*opened);
        ASSERT_TRUE(game->wait_joined(60));
        pool = std::make_unique<ThreadPool>(workers);
        feeder = std::make_unique<client::SectionFeeder>(*renderer, *pool);
        ASSERT_NO_FATAL_FAILURE(settle());
    }
    replica::Replica& replica() { return game->replica(); }
    void settle() {
        const u64 begin = now_ns();
        for (;;) {
            const bool idle = game->server().stats().idle;
            ASSERT_TRUE(replica().poll()) << replica().lost_reason();
            feeder->update(replica(), block_of(replica().body().feet.at), 3);
            if (idle && feeder->settled()) return;
            ASSERT_LT(seconds_since(begin), 60.0);
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
    }
    u64 quads_of(ChunkPos at) {
        render::MeshInput input;
        std::array<ChunkPtr, 27> kept;
        const Chunk open_air;
        for (i32 dx = -1; dx <= 1; ++dx)
            for (i32 dy = -1; dy <= 1; ++dy)
                for (i32 dz = -1; dz <= 1; ++dz) {
                    const u32 i = render::MeshInput::index(dx, dy, dz);
                    kept[i] = replica().dimension().find({at.x + dx, at.y + dy, at.z + dz});
                    input.chunks[i] = kept[i].get();
                    if ((at.y + dy) * 16 >= replica().dimension().info().max_y) input.chunks[i] = &open_air;
                }
        input.models = &feeder->models();
        static render::MeshScratch scratch;
        render::SectionMesh mesh;
        render::mesh_section(input, mesh, scratch);
        return mesh.quads.size();
    }
    void expect_same_as_meshed_directly(const char* when) {
        u64 expected = 0;
        for (const auto& [at, chunk] : replica().dimension().chunks()) {
            EXPECT_TRUE(renderer->has_section(at, replica().dimension().info().id)) << when;
            expected += quads_of(at);
        }
        client::CameraPose pose;
        pose.eye = {replica().body().feet.dimension, eye_of(replica().body())};
        ASSERT_TRUE(renderer->render(client::build_frame(pose, replica().dimension(), 64, 64, 6000, 3, 0)));
        EXPECT_EQ(renderer->stats().quads_held, expected) << when;
        EXPECT_GT(expected, 1000u);
    }
    // A block of ground whose top is a section's, with nothing but air in the section above.
    std::optional<BlockPos> ground_below_air() {
        const BlockPos middle = block_of(replica().body().feet.at);
        for (i32 z = middle.z - 56; z < middle.z + 56; ++z)
            for (i32 x = middle.x - 56; x < middle.x + 56; ++x) {
                const ColumnHeights* h = replica().dimension().heights(column_of(chunk_of(BlockPos{x, 0, z})));
                const i32 above = h ? h->above[u32(z & 15) * 16 + u32(x & 15)] : 1;
                if (above % 16 != 0) continue;
                const ChunkPtr air = replica().dimension().find(chunk_of(BlockPos{x, above, z}));
                const StateId top = replica().dimension().state_at({x, above - 1, z});
                if (air && air->blocks.uniform() && replica().states()->flags(top) & kOpaqueCube)
                    return BlockPos{x, above - 1, z};
            }
        return {};
    }
};

TEST_F(FeederTest, SectionsAreWhatMeshingThemGives) {
    for (const unsigned workers : {0u, 2u}) {
        ASSERT_NO_FATAL_FAILURE(open(workers));
        expect_same_as_meshed_directly("loaded");
        const client::FeederStats stats = feeder->stats();
        EXPECT_GT(stats.without_job, 50u) << "sections of air need no job";
        EXPECT_GT(stats.meshed, 50u);
        EXPECT_LE(stats.in_flight_most, 512u);
        EXPECT_GE(stats.in_flight_most, 48u);
    }
}

TEST_F(FeederTest, AirThatIsBuiltInIsDrawnAndAirAgainIsNot) {
    std::optional<BlockPos> ground;
    for (seed = 7; !ground && seed < 20;) {
        close();
        fs::remove_all(folder);
        ++seed;
        ASSERT_NO_FATAL_FAILURE(open(1));
        ground = ground_below_air();
    }
    ASSERT_TRUE(ground);
    // Beside and above it, looking down at its top.
    ASSERT_NO_FATAL_FAILURE(open(1, world_pos_from_numbers(ground->x + 2.5, ground->y + 3.5, ground->z + 0.5)));
    expect_same_as_meshed_directly("loaded");
    const BlockPos lamp{ground->x, ground->y + 1, ground->z};
    EXPECT_EQ(quads_of(chunk_of(lamp)), 0u);
    const auto placed = replica().place_block(*ground, Face::up, {0.5f, 1, 0.5f}, "minecraft:glowstone");
    ASSERT_TRUE(placed) << placed.error().message;
    ASSERT_NO_FATAL_FAILURE(settle());
    EXPECT_GT(quads_of(chunk_of(lamp)), 0u);
    expect_same_as_meshed_directly("built in");
    const auto broken = replica().break_block(lamp, Face::up, {0.5f, 1, 0.5f});
    ASSERT_TRUE(broken) << broken.error().message;
    ASSERT_NO_FATAL_FAILURE(settle());
    EXPECT_EQ(quads_of(chunk_of(lamp)), 0u);
    expect_same_as_meshed_directly("air again");
}

TEST(FeedBudget, SmallAndAShareOfSlowFrames) {
    EXPECT_DOUBLE_EQ(client::feed_budget_ms(0), 3);
    EXPECT_DOUBLE_EQ(client::feed_budget_ms(1.0 / 60), 3);
    EXPECT_DOUBLE_EQ(client::feed_budget_ms(0.1), 8);
    EXPECT_DOUBLE_EQ(client::feed_budget_ms(5), 20);
}

} // namespace
