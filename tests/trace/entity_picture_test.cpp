// An entity's box in a picture: it is seen, throws a shadow, and goes without a trace. On the CPU, and on a CUDA device
// where there is one.
#include "film_scene.h"
#include "floor_tracer.h"
#include "math/color.h"
#include "scene/sky.h"
#include "trace/frame_setup.h"

namespace vitrail::trace {
namespace {

constexpr u32 kWidth = 96, kHeight = 72;
constexpr TraceSettings kPlain{.samples = 24, .denoise = false};
const Vec3 kLeast{7.4f, 2.25f, 8.2f}, kSize{1.1f, 1.5f, 0.9f}; // hovers over the floor, which ends at y = 1

scene::FrameView frame_of() {
    scene::FrameView frame;
    frame.width = kWidth, frame.height = kHeight;
    frame.sky = scene::sky_at(4000);
    scene::View view;
    view.eye.at = world_pos_from_numbers(8.1, 6.3, 1.4);
    view.rotation = view_rotation(0.05f, 0.5f);
    frame.views.push_back(view);
    return frame;
}
scene::FrameView with_box(const char* state) {
    scene::FrameView frame = frame_of();
    frame.entities.push_back(
        {{DimensionId{}, world_pos_from_numbers(double(kLeast.x), double(kLeast.y), double(kLeast.z))},
         kSize,
         StateId(base_content().id(state))});
    return frame;
}

// The pixel that shows a place of the world.
u32 pixel_at(Vec3 place) {
    const Camera c = camera_of(frame_of(), 0);
    const Vec3 p = pixel_of(c, offset(c.eye, moved({}, place, 1)));
    EXPECT_TRUE(p.z > 0 && p.x > 2 && p.y > 2 && p.x < kWidth - 3 && p.y < kHeight - 3) << "in the picture";
    return u32(p.y) * kWidth + u32(p.x);
}
// Mean over 3 x 3 pixels.
float light_at(const Shot& shot, u32 pixel) {
    float sum = 0;
    for (u32 k = 0; k < 9; ++k)
        sum += luminance_of(shot.color[pixel + k % 3 - 1 + (k / 3) * kWidth - kWidth]);
    return sum / 9;
}
Vec3 shadow_place() {
    const Vec3 middle = kLeast + kSize * 0.5f, sun = frame_of().sky.sun_direction;
    EXPECT_GT(sun.y, 0.5f);
    return middle - sun * ((middle.y - 1) / sun.y);
}

TEST(EntityPicture, ABoxIsSeenAndThrowsAShadow) {
    Tracer* const tracer = on_a_floor(Device::cpu);
    const Shot bare = shoot(*tracer, frame_of(), kPlain);
    const Shot shot = shoot(*tracer, with_box("red_wool"), kPlain);
    EXPECT_EQ(tracer->stats().samples, kPlain.samples) << "another scene: the sums began anew";
    const u32 front = pixel_at(kLeast + Vec3{kSize.x / 2, kSize.y / 2, 0}),
              top = pixel_at(kLeast + Vec3{0.5f, kSize.y, 0.4f}), shade = pixel_at(shadow_place()),
              lit = pixel_at({4.5f, 1, 6.5f});
    film_scene::show("entity", shot.color, kWidth);
    // Its faces, where they are.
    EXPECT_LT(shot.normal[front].z, -0.9f);
    EXPECT_GT(shot.normal[top].y, 0.9f);
    const Vec3 eye{8.1f, 6.3f, 1.4f};
    EXPECT_NEAR(shot.distance[front], length(kLeast + Vec3{kSize.x / 2, kSize.y / 2, 0} - eye), 0.1f);
    EXPECT_GT(bare.distance[front], shot.distance[front] + 1);
    EXPECT_GT(shot.albedo[front].x, 3 * shot.albedo[front].y) << "red wool";
    EXPECT_NEAR(bare.albedo[front].x, bare.albedo[front].y, 0.1f * bare.albedo[front].x) << "stone";
    EXPECT_GT(light_at(shot, top), 1.5f * light_at(shot, front)) << "the sun is in the front's back";
    // Its shadow: the floor there is as far as it was, without the sun; elsewhere it is as it was.
    EXPECT_NEAR(shot.distance[shade], bare.distance[shade], 0.02f);
    EXPECT_LT(light_at(shot, shade), 0.5f * light_at(bare, shade));
    EXPECT_GT(light_at(shot, shade), 0.05f * light_at(bare, shade)) << "the sky lights it";
    EXPECT_NEAR(light_at(shot, lit) / light_at(bare, lit), 1, 0.05);
    // It goes, and nothing of it stays.
    tracer->forget_frames();
    const Shot first = shoot(*tracer, frame_of(), kPlain);
    for (std::size_t i = 0; i < bare.color.size(); ++i)
        ASSERT_TRUE(first.color[i] == bare.color[i]) << i;
}

TEST(EntityPicture, ABoxThatShinesLightsTheNight) {
    Tracer* const tracer = on_a_floor(Device::cpu);
    scene::FrameView dark = frame_of(), lamp = with_box("glowstone");
    dark.sky = lamp.sky = scene::sky_at(18000);
    const Shot without = shoot(*tracer, dark, kPlain), with = shoot(*tracer, lamp, kPlain);
    const u32 below = pixel_at({7.9f, 1, 7.4f});
    EXPECT_GT(light_at(with, below), 5 * light_at(without, below));
}

TEST(EntityPicture, IsTheSameOnADevice) {
    Tracer *const gpu = on_a_floor(Device::cuda), *const cpu = on_a_floor(Device::cpu);
    if (!gpu) GTEST_SKIP() << Tracer::possible_on(Device::cuda).error().message;
    scene::FrameView frame = with_box("red_wool");
    for (u32 step = 0; step < 3; ++step) {
        const Shot a = shoot(*gpu, frame, kPlain), b = shoot(*cpu, frame, kPlain);
        double off = 0, sum = 0;
        u32 far = 0;
        for (std::size_t i = 0; i < b.color.size(); ++i) {
            const Vec3 d = a.color[i] - b.color[i];
            off += double(std::fabs(luminance_of(d))), sum += double(luminance_of(b.color[i]));
            far += std::fabs(a.distance[i] - b.distance[i]) > 0.02f * (1 + b.distance[i]);
        }
        EXPECT_LT(off / sum, 0.03) << step;
        EXPECT_LT(far, b.color.size() / 50) << step;
        for (u32 i = 0; i < 8; ++i) // more of them, and others move
            frame.entities.push_back(frame.entities[0]), frame.entities.back().least.at.x += kFixedOne * i32(i) / 2;
        if (step == 1) frame.entities.clear();
    }
}

} // namespace
} // namespace vitrail::trace
