// The path tracer beside the raster renderer: fed with what the replica holds, drawn through the same frame, told of
// edits, and the same picture for the same seed.
#include "client/traced_view.h"

#include "base/clock.h"
#include "client/frame_builder.h"
#include "client/still.h"
#include "platform/headless.h"
#include "rules/pick.h"
#include "script/content_loader.h"

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <iterator>
#include <thread>
#include <unistd.h>

using namespace vitrail;
namespace fs = std::filesystem;

namespace {

constexpr u32 kWidth = 48, kHeight = 27;

Content base_content() {
    const std::vector<fs::path> roots{fs::path(VITRAIL_SOURCE_DIR) / "content/base"};
    auto loaded = load_content(roots);
    EXPECT_TRUE(loaded) << loaded.error().message;
    return loaded ? *loaded : Content{};
}

struct TracedViewTest : testing::Test {
    fs::path folder = fs::temp_directory_path() / ("vitrail_traced_" + std::to_string(getpid()));
    Content content;
    std::unique_ptr<platform::HeadlessContext> context;
    std::unique_ptr<render::Renderer> renderer;
    std::unique_ptr<ThreadPool> pool;
    std::unique_ptr<client::LocalGame> game;
    std::unique_ptr<client::SectionFeeder> feeder;
    std::unique_ptr<client::TracedView> view;
    client::CameraPose pose;

    void SetUp() override {
        setenv("VITRAIL_GL", "software", 0);
        fs::remove_all(folder);
        auto made = platform::HeadlessContext::create();
        if (!made) GTEST_SKIP() << made.error().message;
        context = std::move(*made);
        content = base_content();
        auto drawn_by = render::Renderer::create({.effects = render::preset_effects(render::Preset::low)});
        ASSERT_TRUE(drawn_by) << drawn_by.error().message;
        renderer = std::move(*drawn_by);
        client::LocalGameOptions options;
        options.server.folder = folder.string();
        options.server.seed = 7;
        options.replica.view_distance = 2;
        auto opened = client::LocalGame::open(options, content);
        ASSERT_TRUE(opened) << opened.error().message;
        game = std::move(*opened);
        ASSERT_TRUE(game->wait_joined(60));
        pool = std::make_unique<ThreadPool>(1);
        feeder = std::make_unique<client::SectionFeeder>(*renderer, *pool);
        auto traced =
            client::TracedView::open({trace::Device::cpu, 1, *pool, *feeder, game->replica(), content.registry, nullptr});
        ASSERT_TRUE(traced) << traced.error().message;
        view = std::move(*traced);
        feeder->set_meshing(false);
        // Down at the ground beside the feet.
        pose.eye = {replica().body().feet.dimension, eye_of(replica().body())};
        pose.pitch_deg = 35;
        ASSERT_NO_FATAL_FAILURE(settle());
    }
    void TearDown() override {
        view.reset();
        feeder.reset();
        pool.reset();
        game.reset();
        renderer.reset();
        fs::remove_all(folder);
    }
    replica::Replica& replica() { return game->replica(); }
    void settle() {
        const u64 begin = now_ns();
        for (;;) {
            const bool idle = game->server().stats().idle;
            ASSERT_TRUE(replica().poll()) << replica().lost_reason();
            feeder->update(replica(), block_of(pose.eye.at), 3);
            ASSERT_TRUE(view->feed(block_of(pose.eye.at), 3));
            if (idle && view->ready() && view->waiting() == 0) return;
            ASSERT_LT(seconds_since(begin), 60.0);
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
    }
    scene::FrameView frame() { return client::build_frame(pose, replica().dimension(), kWidth, kHeight, 6000, 2, 0); }
    render::Image draw(float last_ms = 0) {
        client::TraceOptions options;
        options.hold = 1; // a second is enough for any machine
        scene::FrameView f = frame();
        const auto drawn = view->draw(f, options, renderer->effects(), last_ms, *renderer);
        EXPECT_TRUE(drawn) << drawn.error().message;
        EXPECT_EQ(f.resolution, view->share());
        renderer->forget_frames();
        const auto shown = renderer->render(f);
        EXPECT_TRUE(shown) << shown.error().message;
        auto image = renderer->read_pixels();
        EXPECT_TRUE(image);
        return image ? *image : render::Image{};
    }
};

double mean_of(const render::Image& image) {
    double sum = 0;
    for (u8 v : image.pixels)
        sum += v;
    return sum / double(std::max<std::size_t>(image.pixels.size(), 1));
}
double difference(const render::Image& a, const render::Image& b) {
    if (a.pixels.size() != b.pixels.size()) return 255;
    double sum = 0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i)
        sum += std::abs(int(a.pixels[i]) - int(b.pixels[i]));
    return sum / double(std::max<std::size_t>(a.pixels.size(), 1));
}

TEST_F(TracedViewTest, ShowsTheWorldAndHearsOfEdits) {
    (void)draw(); // small
    const render::Image ground = draw();
    EXPECT_EQ(ground.width, kWidth);
    EXPECT_GT(mean_of(ground), 10) << "light at noon";
    EXPECT_GT(view->stats().rays, view->stats().paths);
    EXPECT_EQ(view->stats().paths, u64(kWidth) * kHeight);
    EXPECT_EQ(view->stats().emitters, 0u);

    // A lamp where the eye looks: seen, and known as a lamp.
    const auto forward = look_direction(0, pose.pitch_deg * 3.14159265f / 180);
    const auto hit = pick_block(replica().dimension(), pose.eye.at, forward, 6);
    ASSERT_TRUE(hit);
    const auto placed = replica().place_block(hit->block, hit->face, hit->point, "minecraft:glowstone");
    ASSERT_TRUE(placed) << placed.error().message;
    ASSERT_NO_FATAL_FAILURE(settle());
    const render::Image lamp = draw();
    EXPECT_GT(view->stats().emitters, 0u);
    EXPECT_GT(difference(ground, lamp), 3);
    EXPECT_EQ(renderer->stats().draws, 0u) << "no sections are drawn";

    // Looks that are read again, as after a change of packs: the same world.
    feeder->set_packs(nullptr);
    view->set_packs(nullptr);
    ASSERT_NO_FATAL_FAILURE(settle());
    (void)draw();
    EXPECT_GT(view->stats().emitters, 0u);
    EXPECT_LT(difference(lamp, draw()), difference(ground, lamp));

    // Back: nothing of the film is left, sections are meshed now.
    view->hide(*renderer);
    feeder->set_meshing(true);
    const u64 begin = now_ns();
    while (!feeder->settled()) {
        feeder->update(replica(), block_of(pose.eye.at), 100);
        ASSERT_LT(seconds_since(begin), 60.0);
    }
    renderer->forget_frames();
    ASSERT_TRUE(renderer->render(frame()));
    EXPECT_GT(renderer->stats().draws, 0u);
}

TEST_F(TracedViewTest, TracesSmallerWhereFramesTakeTooLong) {
    (void)draw();
    EXPECT_NEAR(view->share(), 1.0f / 3, 1e-6f) << "the first picture tells what a pixel takes";
    (void)draw();
    EXPECT_EQ(view->share(), 1);
    float least = 1;
    for (int i = 0; i < 40; ++i) {
        pose.yaw_deg = float(i * 20); // in motion
        (void)draw(5000);
        least = std::min(least, view->share());
    }
    EXPECT_NEAR(least, 1.0f / 3, 0.01f);
    EXPECT_LT(view->stats().paths, u64(kWidth) * kHeight);
}

// A view that rests keeps its size and grows better, whatever frames took; motion ends that at once.
TEST_F(TracedViewTest, GathersSamplesAtRest) {
    u32 before = 0;
    float share = 0;
    for (int i = 0; i < 30; ++i) {
        (void)draw(i < 14 ? 0.0f : 5000.0f);
        if (i >= 14) {
            EXPECT_EQ(view->share(), share) << i;
            EXPECT_GT(view->stats().samples, before) << i;
        }
        before = view->stats().samples, share = view->share();
    }
    EXPECT_EQ(share, 1);
    pose.yaw_deg += 5;
    (void)draw();
    EXPECT_LT(view->stats().samples, before);
}

TEST(Traced, SameSeedSamePicture) {
    setenv("VITRAIL_GL", "software", 0);
    const Content content = base_content();
    client::StillOptions options;
    options.seed = 7;
    options.view_distance = 2;
    options.trace = trace::Device::cpu;
    options.effects = render::preset_effects(render::Preset::low);
    options.pose.eye.at = world_pos_from_numbers(434.5, 150, 440.5);
    options.pose.pitch_deg = 40;
    auto still = client::Still::open(options, content);
    if (!still && still.error().code == ErrorCode::unsupported) GTEST_SKIP() << still.error().message;
    ASSERT_TRUE(still) << still.error().message;
    const auto shoot = [&](u32 seed, bool denoise) {
        trace::TraceSettings settings;
        settings.seed = seed, settings.denoise = denoise;
        (*still)->tracer().forget_frames();
        for (int i = 0; i < 3; ++i)
            EXPECT_TRUE((*still)->trace(options.pose, 32, 18, 6000, settings));
        return (*still)->tracer().read(trace::Layer::color);
    };
    const std::vector<float> first = shoot(5, false);
    ASSERT_EQ(first.size(), 32u * 18 * 3);
    EXPECT_EQ(first, shoot(5, false));
    EXPECT_NE(first, shoot(6, false));
    EXPECT_EQ(shoot(5, true), shoot(5, true));
    for (float v : first)
        EXPECT_TRUE(std::isfinite(v) && v >= 0);
    EXPECT_EQ((*still)->tracer().read(trace::Layer::distance).size(), 32u * 18);

    // Far away there is other land, and it is there before the picture is taken.
    client::CameraPose away = options.pose;
    away.eye.at = world_pos_from_numbers(2000.5, 120, 300.5);
    ASSERT_TRUE((*still)->go_to(away));
    EXPECT_TRUE((*still)->replica().has_section(chunk_of(block_of(away.eye.at))));
    EXPECT_FALSE((*still)->replica().has_section(chunk_of(block_of(options.pose.eye.at))));
}

TEST(TraceOptions, AreTakenShownAndHeldInRange) {
    client::TraceOptions options;
    ASSERT_TRUE(client::set_trace_option(options, "bounces", "2"));
    ASSERT_TRUE(client::set_trace_option(options, "scale", "0.5"));
    ASSERT_TRUE(client::set_trace_option(options, "denoise", "off"));
    EXPECT_EQ(options.bounces, 2);
    EXPECT_EQ(options.scale, 0.5f);
    EXPECT_FALSE(options.denoise);
    for (const client::TraceOption& option : client::trace_option_list()) {
        client::TraceOptions back;
        ASSERT_TRUE(client::set_trace_option(back, option.key, option_text(option, options)))
            << option.key;
        EXPECT_EQ(option_text(option, back), option_text(option, options));
    }
    const client::TraceOptions before = options;
    for (const auto& [key, value] : {std::pair{"bounces", "17"},
                                     {"bounces", "1.5"},
                                     {"bounces", ""},
                                     {"scale", "0"},
                                     {"scale", "nan"},
                                     {"denoise", "perhaps"},
                                     {"magic", "1"}})
        EXPECT_FALSE(client::set_trace_option(options, key, value)) << key << value;
    EXPECT_EQ(options, before);
    options.scale = NAN, options.bounces = 9999, options.samples = -4;
    options = client::sane(options);
    EXPECT_EQ(options.scale, 1);
    EXPECT_EQ(options.bounces, 16);
    EXPECT_EQ(options.samples, 1);
    EXPECT_EQ(client::frame_rate_of({}, trace::Device::cpu), 10);
    EXPECT_EQ(client::frame_rate_of({}, trace::Device::cuda), 30);
}

TEST(TraceOptions, StandInTheDocuments) {
    std::ifstream file(std::string(VITRAIL_SOURCE_DIR) + "/docs/tracing.md");
    const std::string page{std::istreambuf_iterator<char>(file), {}};
    EXPECT_NE(page.find(client::trace_options_table()), std::string::npos)
        << "docs/tracing.md wants the table of `vitrail effects`";
}

} // namespace
