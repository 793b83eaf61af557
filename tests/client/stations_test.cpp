// Every station of the demo world, with and without its effect, against golden pictures (tests/golden.h).
#include "client/still.h"
#include "demo_world.h"
#include "golden.h"

#include <algorithm>
#include <cstdlib>

namespace vitrail::client {
namespace {

// AddressSanitizer draws several times slower: there each group shows its first station alone.
#if defined(__SANITIZE_ADDRESS__)
constexpr bool kSlow = true;
#elif defined(__has_feature)
constexpr bool kSlow = __has_feature(address_sanitizer);
#else
constexpr bool kSlow = false;
#endif

constexpr u32 kGroups = 7; // tests, so that several processes share the work
constexpr u32 kWidth = 427, kHeight = 240, kViewDistance = 12;
constexpr u32 kFrames = 8; // half of what a still takes to settle: enough to see what antialiasing does

CameraPose pose_of(const Station& station) {
    CameraPose pose;
    pose.eye.at = world_pos_from_numbers(station.at[0], station.at[1], station.at[2]);
    pose.yaw_deg = station.yaw, pose.pitch_deg = station.pitch, pose.fov_deg = station.fov;
    return pose;
}

// A world of its own for each station: the server sends what can be seen from where one joins, and from above the park
// that is not all of a cave.
Result<std::unique_ptr<Still>> open_at(const Station& station) {
    DemoWorld& demo = demo_world();
    StillOptions options;
    options.world = demo.folder.string();
    options.view_distance = kViewDistance;
    options.pose = pose_of(station);
    return Still::open(options, demo.content);
}

void expect_looks(const Station& station) {
    auto opened = open_at(station);
    ASSERT_TRUE(opened) << opened.error().message;
    Still& still = **opened;
    if (const std::string why = golden::cannot_compare(); !why.empty()) GTEST_SKIP() << why;
    EXPECT_EQ(still.renderer().missing_textures(), 0u);
    const auto shoot = [&](const render::Effects& effects) -> render::Image {
        const auto set = still.renderer().set_effects(effects);
        EXPECT_TRUE(set) << station.name;
        auto image = still.draw_settled(pose_of(station), kWidth, kHeight, station.time, kFrames);
        EXPECT_TRUE(image) << station.name;
        return image ? std::move(*image) : render::Image{};
    };
    const render::Image with = shoot(render::preset_effects(render::Preset::high));
    golden::compare("client", station.name, with);
    if (station.without.empty()) return;
    const render::Image bare = shoot(effects_without(station));
    golden::compare("client", station.name + "_without", bare);
    EXPECT_GT(golden::difference(with, bare, 6).far, .02) << station.name << " shows nothing of " << station.effect;
}

class Stations : public testing::TestWithParam<u32> {};

TEST_P(Stations, LookAsTheyShould) {
    setenv("VITRAIL_GL", "software", 0);
    DemoWorld& demo = demo_world();
    demo.keep();
    ASSERT_EQ(demo.trouble, "");
    for (u32 i = GetParam(); i < demo.world->stations.size(); i += kGroups) {
        expect_looks(demo.world->stations[i]);
        if (kSlow || IsSkipped() || HasFatalFailure()) break;
    }
}

INSTANTIATE_TEST_SUITE_P(Group, Stations, testing::Range(0u, kGroups));

} // namespace
} // namespace vitrail::client
