// Streams of paths come to what single paths come to, bit for bit.
#include "trace/cpu/path_stream.h"
#include "trace/scenes.h"

#include <cstring>
#include <gtest/gtest.h>

namespace vitrail::test {
namespace {

using namespace trace;

bool same(const PixelSample& a, const PixelSample& b) {
    const auto equal = [](Vec3 u, Vec3 v) { return std::memcmp(&u, &v, sizeof u) == 0; };
    return equal(a.base, b.base) && equal(a.light, b.light) && equal(a.air, b.air) && equal(a.albedo, b.albedo) &&
           equal(a.normal, b.normal) && std::memcmp(&a.distance, &b.distance, sizeof a.distance) == 0 &&
           std::memcmp(&a.roughness, &b.roughness, sizeof a.roughness) == 0 && a.surface == b.surface;
}

std::vector<PathStart> all_starts(const Camera& camera, u32 samples) {
    std::vector<PathStart> starts;
    for (u32 y = 0; y < camera.height; ++y)
        for (u32 x = 0; x < camera.width; ++x)
            for (u32 s = 0; s < samples; ++s)
                starts.push_back({x, y, s});
    return starts;
}

void compare(const TestScene& s, const std::vector<PathStart>& starts, PathRoom& room) {
    std::vector<PixelSample> sums(starts.size());
    for (StreamCode code : {StreamCode::scalar, StreamCode::avx512, StreamCode::best}) {
        if (!stream_code_available(code)) continue;
        const u64 rays = trace_paths(s.view, s.sky, s.camera, s.settings, starts, sums, room, code);
        u64 want_rays = 0;
        for (std::size_t i = 0; i < starts.size(); ++i) {
            u32 traced = 0;
            const PixelSample want = s.sample(starts[i].x, starts[i].y, starts[i].sample, traced);
            want_rays += traced;
            ASSERT_TRUE(same(sums[i], want))
                << int(code) << " at " << starts[i].x << ' ' << starts[i].y << ' ' << starts[i].sample << ": "
                << radiance_of(sums[i]).y << " for " << radiance_of(want).y;
        }
        EXPECT_EQ(rays, want_rays);
    }
}

class PathStreams : public testing::TestWithParam<SceneName> {};

TEST_P(PathStreams, EqualSinglePaths) {
    auto s = make_scene(GetParam());
    s->set_size(32, 18);
    PathRoom room;
    compare(*s, all_starts(s->camera, 3), room);
    s->settings.bounces = 0, s->settings.first_sample = 7; // guides alone, and room that was used before
    compare(*s, all_starts(s->camera, 1), room);
}
INSTANTIATE_TEST_SUITE_P(Six, PathStreams, testing::ValuesIn(kSceneNames),
                         [](const auto& i) { return std::string(name_of(i.param)); });

TEST(PathStream, SeesEntityBoxes) {
    auto s = make_scene(SceneName::lamp_room);
    s->set_size(24, 16);
    PathRoom room;
    const std::vector<PathStart> starts = all_starts(s->camera, 1);
    std::vector<PixelSample> without(starts.size()), with(starts.size());
    trace_paths(s->view, s->sky, s->camera, s->settings, starts, without, room);
    // Half a block before the eye, over all that it sees.
    const Place eye = s->camera.eye;
    const Vec3 ahead = normalized(s->camera.forward);
    EntityBox box{moved(eye, ahead * 1.0f + Vec3{-0.4f, -0.4f, -0.4f}, 1), {0.8f, 0.8f, 0.8f}, TestScene::wood};
    const BoxNode root{offset(eye, box.least), offset(eye, box.least) + box.size, 0, 1};
    s->view.boxes = &box, s->view.box_nodes = &root, s->view.box_count = 1, s->view.boxes_from = eye;
    compare(*s, starts, room);
    trace_paths(s->view, s->sky, s->camera, s->settings, starts, with, room);
    u32 nearer = 0;
    for (std::size_t i = 0; i < starts.size(); ++i)
        nearer += with[i].distance < without[i].distance && with[i].distance < 1.5f;
    EXPECT_GT(nearer, 40u);
}

TEST(PathStream, FewPathsAndNone) {
    auto s = make_scene(SceneName::open_noon);
    s->set_size(64, 64);
    PathRoom room;
    for (u32 count : {0u, 1u, 17u, 2000u}) {
        std::vector<PathStart> starts = all_starts(s->camera, 1);
        starts.resize(count);
        compare(*s, starts, room);
    }
    s->settings.events_most = 0;
    compare(*s, all_starts(s->camera, 1), room);
}

} // namespace
} // namespace vitrail::test
