// What is no light is left out of pictures, and told; whole scenes have none of it.
#include "floor_tracer.h"
#include "scene/sky.h"

#include <cmath>
#include <limits>

namespace vitrail::trace {
namespace {

// Half floor, half sky.
scene::FrameView frame_at(float time) {
    scene::FrameView frame;
    frame.width = 48, frame.height = 32;
    frame.sky = scene::sky_at(time);
    scene::View view;
    view.eye.at = world_pos_from_numbers(8.1, 3.3, 1.4);
    view.rotation = view_rotation(0.05f, 0.1f);
    frame.views.push_back(view);
    return frame;
}

TEST(Faults, AreLeftOutAndTold) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    for (const Device device : {Device::cpu, Device::cuda}) {
        Tracer* const tracer = on_a_floor(device);
        if (!tracer) continue;
        for (const bool denoise : {false, true}) {
            tracer->forget_frames();
            const TraceSettings settings{.samples = 4, .bounces = 2, .denoise = denoise};
            const scene::FrameView good = frame_at(6000);
            const Shot right = shoot(*tracer, good, settings);
            EXPECT_EQ(tracer->stats().dropped, 0u);
            scene::FrameView bad = good; // a part of the sky is no number: all paths that come to it are lost
            for (u32 i = 0; i < 6; ++i)
                bad.sky.dome.texels[scene::SkyTable::kWidth * 20 + 4 + i] = {nan, 1, 1};
            tracer->forget_frames();
            const Shot shot = shoot(*tracer, bad, settings);
            const u64 paths = tracer->stats().paths, dropped = tracer->stats().dropped;
            EXPECT_GT(dropped, 0u);
            EXPECT_LT(dropped, paths / 4);
            double sum = 0, expected = 0, samples = 0;
            for (std::size_t i = 0; i < shot.color.size(); ++i) {
                ASSERT_TRUE(std::isfinite(shot.color[i].x + shot.color[i].y + shot.color[i].z)) << i;
                samples += double(shot.samples[i]);
                if (shot.distance[i] == 0) continue;
                sum += double(shot.color[i].y), expected += double(right.color[i].y);
            }
            if (!denoise) EXPECT_EQ(u64(samples), paths - dropped);
            // The floor loses a small part of the sky, and no pixel of it goes dark.
            EXPECT_NEAR(sum / expected, 1, 0.03) << denoise;
        }
    }
}

TEST(Faults, ThereAreNone) {
    Tracer* const tracer = on_a_floor(Device::cpu);
    const BaseContent& c = base_content();
    // Of every kind of block one, side by side, at hours when lights are high, low and gone.
    auto all = std::make_shared<Chunk>();
    for (i32 i = 0; i < 256; ++i)
        all->blocks.set(LocalPos(i % 16, 0, i / 16), StateId(c.id("stone")));
    const char* some[] = {"glass", "red_stained_glass", "water", "ice",        "glowstone",  "torch",
                          "lava",  "oak_leaves",        "poppy", "iron_block", "glass_pane", "oak_stairs"};
    i32 n = 0;
    for (const char* state : some)
        for (i32 k = 0; k < 4; ++k, ++n)
            all->blocks.set(LocalPos(2 + n * 5 % 12, 1 + k % 2, 4 + n / 4), StateId(c.id(state)));
    tracer->set_chunk({0, 0, 0}, DimensionId{}, all, nullptr);
    u64 paths = 0;
    for (float time : {0.0f, 6000.0f, 11990.0f, 12600.0f, 18000.0f}) {
        shoot(*tracer, frame_at(time), {.samples = 4, .denoise = false});
        EXPECT_EQ(tracer->stats().dropped, 0u) << time;
        paths += tracer->stats().paths;
    }
    EXPECT_EQ(paths, 5u * 4 * 48 * 32);
}

} // namespace
} // namespace vitrail::trace
