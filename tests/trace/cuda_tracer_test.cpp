// The tracer on a CUDA device shows what the CPU's shows. Without a device it is skipped.
#include "content_fixture.h"
#include "scene/sky.h"
#include "trace/cuda/cuda_tracer.h"

#include <fmt/format.h>

namespace vitrail::trace {
namespace {

constexpr u32 kWidth = 48, kHeight = 32;

std::unique_ptr<Tracer> cuda_tracer(u32 devices, std::string& why) {
    auto tracer = Tracer::create({.device = Device::cuda, .devices_most = devices, .window_chunks = 8});
    if (!tracer) {
        EXPECT_EQ(tracer.error().code, ErrorCode::unsupported);
        why = tracer.error().message;
        return nullptr;
    }
    return std::move(*tracer);
}

// A room open to one side: lamps, glass, water, plants.
std::shared_ptr<Chunk> room(bool changed) {
    auto chunk = std::make_shared<Chunk>();
    const auto set = [&](i32 x, i32 y, i32 z, const char* state) {
        chunk->blocks.set(LocalPos(x, y, z), StateId(base_content().id(state)));
    };
    for (i32 i = 0; i < 256; ++i) {
        set(i % 16, 0, i / 16, "stone");
        if (i / 16 < 9) set(0, i / 16, i % 16, "oak_planks"), set(15, i / 16, i % 16, "sandstone");
        if (i / 16 < 9) set(i % 16, i / 16, 15, "stone"), set(i % 16, 9, 15 - i / 16, "oak_planks");
    }
    for (i32 i = 3; i < 7; ++i)
        set(i, 1, 9, "water"), set(i, 1, 10, "water");
    set(9, 1, 11, "glass"), set(9, 2, 11, "glass"), set(12, 1, 12, "glowstone"), set(11, 1, 9, "oak_leaves");
    if (changed) set(4, 3, 12, "glowstone"), set(12, 1, 12, "stone");
    return chunk;
}

scene::FrameView frame_of() {
    scene::FrameView frame;
    frame.width = kWidth, frame.height = kHeight;
    frame.sky = scene::sky_at(4000);
    scene::View view;
    view.eye.at = {kFixedOne * 33 / 4, kFixedOne * 17 / 4, kFixedOne * 2 / 5};
    view.rotation = view_rotation(0.1f, 0.15f);
    frame.views.push_back(view);
    return frame;
}

struct Look {
    std::vector<float> color, distance, samples;
    TracerStats stats;
};
Look look(Tracer& tracer, u32 frames, const TraceSettings& settings) {
    const scene::FrameView frame = frame_of();
    for (u32 i = 0; i < frames; ++i) {
        const auto done = tracer.render(frame, settings);
        EXPECT_TRUE(done) << done.error().message;
    }
    return {tracer.read(Layer::color), tracer.read(Layer::distance), tracer.read(Layer::samples), tracer.stats()};
}

void give_room(Tracer& tracer, bool changed) {
    tracer.set_chunk({0, 0, 0}, DimensionId{}, room(changed), nullptr);
}
void open_room(Tracer& tracer) {
    const BaseContent& c = base_content();
    ASSERT_TRUE(tracer.set_content(c.models, *c.states, &c.pictures));
    give_room(tracer, false);
}

// Mean, and root of the mean squared difference over it.
void expect_alike(const Look& a, const Look& b, double most) {
    ASSERT_EQ(a.color.size(), std::size_t(kWidth) * kHeight * 3);
    ASSERT_EQ(a.color.size(), b.color.size());
    double sum_a = 0, sum_b = 0, off = 0;
    for (std::size_t i = 0; i < a.color.size(); ++i) {
        ASSERT_TRUE(std::isfinite(a.color[i]) && std::isfinite(b.color[i]));
        sum_a += double(a.color[i]), sum_b += double(b.color[i]);
        off += std::fabs(double(a.color[i]) - double(b.color[i]));
    }
    EXPECT_GT(sum_a / double(a.color.size()), 0.01);
    EXPECT_NEAR(sum_a / sum_b, 1, 0.02);
    EXPECT_LT(off / sum_b, most);
    u32 far = 0;
    for (std::size_t i = 0; i < a.distance.size(); ++i)
        far += std::fabs(a.distance[i] - b.distance[i]) > 0.02f * (1 + b.distance[i]);
    EXPECT_LE(far, a.distance.size() / 50);
    EXPECT_EQ(a.samples, b.samples);
}

// The numbers of a path are the same on both, so single paths are, but where rounding turns one.
TEST(CudaTracer, ShowsWhatTheCpuShows) {
    std::string why;
    const auto tracer = cuda_tracer(1, why);
    if (!tracer) GTEST_SKIP() << why;
    const auto cpu = Tracer::create({.window_chunks = 8}).value();
    open_room(*tracer), open_room(*cpu);
    const TraceSettings plain{.samples = 4, .denoise = false};
    const Look a = look(*tracer, 2, plain), b = look(*cpu, 2, plain);
    expect_alike(a, b, 0.05);
    EXPECT_EQ(a.stats.paths, b.stats.paths);
    EXPECT_NEAR(double(a.stats.rays) / double(b.stats.rays), 1, 0.01);
    EXPECT_EQ(a.stats.emitters, b.stats.emitters);
    // An edit: another lamp, while one goes.
    give_room(*tracer, true), give_room(*cpu, true);
    expect_alike(look(*tracer, 2, plain), look(*cpu, 2, plain), 0.05);
    // Filtered, and with light for a quarter of the pixels.
    expect_alike(look(*tracer, 6, {}), look(*cpu, 6, {}), 0.05);
    tracer->forget_frames(), cpu->forget_frames();
    expect_alike(look(*tracer, 6, {.half = true}), look(*cpu, 6, {.half = true}), 0.05);
}

TEST(CudaTracer, SeveralDevicesMakeOnePicture) {
    std::string why;
    const auto many = cuda_tracer(2, why);
    if (!many) GTEST_SKIP() << why;
    if (many->stats().device.find('+') == std::string::npos) GTEST_SKIP() << "one device alone";
    const auto one = cuda_tracer(1, why);
    open_room(*many), open_room(*one);
    for (const TraceSettings& s :
         {TraceSettings{.samples = 2, .denoise = false}, TraceSettings{}, TraceSettings{.half = true}})
        expect_alike(look(*many, 3, s), look(*one, 3, s), 1e-4);
}

TEST(CudaTracer, TheBestDeviceIsOneThatWorks) {
    const auto best = Tracer::create({.device = Device::best, .window_chunks = 8});
    ASSERT_TRUE(best) << best.error().message;
    EXPECT_EQ((*best)->device(), Tracer::possible_on(Device::cuda) ? Device::cuda : Device::cpu);
    EXPECT_FALSE(Tracer::create({.device = Device::best, .window_chunks = 7})); // no device makes that right
    EXPECT_EQ((*Tracer::create({.device = Device::cpu, .window_chunks = 8}))->device(), Device::cpu);
}

// Whatever order warps come in.
TEST(CudaTracer, SameSeedSamePicture) {
    std::string why;
    const auto a = cuda_tracer(1, why), b = a ? cuda_tracer(1, why) : nullptr;
    if (!a || !b) GTEST_SKIP() << why;
    open_room(*a), open_room(*b);
    for (const TraceSettings& s : {TraceSettings{.samples = 3, .denoise = false}, TraceSettings{.half = true}}) {
        a->forget_frames(), b->forget_frames();
        EXPECT_EQ(look(*a, 3, s).color, look(*b, 3, s).color);
    }
}

// More events than the rounds that all paths go together: no scattering at all, and everything by glass and water.
TEST(CudaTracer, FewRounds) {
    std::string why;
    const auto tracer = cuda_tracer(1, why);
    if (!tracer) GTEST_SKIP() << why;
    const auto cpu = Tracer::create({.window_chunks = 8}).value();
    open_room(*tracer), open_room(*cpu);
    for (Tracer* t : {tracer.get(), cpu.get()}) {
        auto chunk = room(false);
        for (i32 i = 0; i < 8 * 6; ++i) // panes behind each other before the eye
            chunk->blocks.set(LocalPos(5 + i % 8, 2 + i / 8, 6), StateId(base_content().id("glass")));
        for (i32 i = 0; i < 8 * 6; ++i)
            chunk->blocks.set(LocalPos(5 + i % 8, 2 + i / 8, 3), StateId(base_content().id("ice")));
        t->set_chunk({0, 0, 0}, DimensionId{}, chunk, nullptr);
    }
    const TraceSettings plain{.samples = 4, .bounces = 1, .denoise = false};
    const Look a = look(*tracer, 2, plain), b = look(*cpu, 2, plain);
    expect_alike(a, b, 0.05);
    EXPECT_NEAR(double(a.stats.rays) / double(b.stats.rays), 1, 0.01);
}

// A picture that is cut into batches (64 samples of 256 x 160 pixels are more paths than go together) shows what fewer
// samples show.
TEST(CudaTracer, Batches) {
    std::string why;
    const auto tracer = cuda_tracer(1, why);
    if (!tracer) GTEST_SKIP() << why;
    open_room(*tracer);
    scene::FrameView frame = frame_of();
    frame.width = 256, frame.height = 160;
    const auto picture = [&](u32 samples, u32 frames) {
        tracer->forget_frames();
        u64 paths = 0;
        for (u32 i = 0; i < frames; ++i) {
            EXPECT_TRUE(tracer->render(frame, {.samples = samples, .denoise = false}));
            paths += tracer->stats().paths;
        }
        EXPECT_EQ(paths, u64(256) * 160 * samples * frames);
        return tracer->read(Layer::color);
    };
    const std::vector<float> once = picture(64, 1), often = picture(4, 16);
    double off = 0, sum = 0;
    for (std::size_t i = 0; i < once.size(); ++i)
        off += std::fabs(double(once[i]) - double(often[i])), sum += double(often[i]);
    EXPECT_LT(off / sum, 1e-4);
}

TEST(CudaTracer, TellsStages) {
    auto tracer = Tracer::create({.device = Device::cuda, .window_chunks = 8, .stages = true});
    if (!tracer) GTEST_SKIP() << tracer.error().message;
    open_room(**tracer);
    const Look a = look(**tracer, 1, {});
    double ms = 0;
    u64 rays = 0;
    for (const TraceStage& s : a.stats.stages) {
        ms += s.ms;
        if (s.name.starts_with("closest") || s.name.starts_with("light")) rays += s.items;
        if (s.name == "closest 0") EXPECT_EQ(s.items, kWidth * kHeight);
    }
    EXPECT_LE(rays, a.stats.rays);
    EXPECT_GT(double(rays), 0.5 * double(a.stats.rays));
    EXPECT_GT(ms, 0);

    // Told or not: then light's rays go beside others, and the picture is the same.
    std::string why;
    const auto untold = cuda_tracer(1, why);
    ASSERT_TRUE(untold) << why;
    open_room(*untold);
    EXPECT_EQ(look(*untold, 1, {}).color, a.color);
    for (const TraceSettings& s :
         {TraceSettings{.samples = 16, .bounces = 8, .denoise = false}, TraceSettings{.half = true}}) {
        (*tracer)->forget_frames(), untold->forget_frames();
        EXPECT_EQ(look(*untold, 3, s).color, look(**tracer, 3, s).color);
    }
    EXPECT_TRUE(untold->stats().stages.empty());
}

TEST(CudaTracer, SaysWhyNot) {
    EXPECT_FALSE(cuda_tracer_summary().empty());
    const auto tracer = Tracer::create({.device = Device::cuda});
    const auto possible = Tracer::possible_on(Device::cuda);
    EXPECT_EQ(bool(possible), bool(tracer));
    EXPECT_TRUE(Tracer::possible_on(Device::cpu) && Tracer::possible_on(Device::best));
    if (tracer) GTEST_SKIP() << "there is a device";
    EXPECT_EQ(possible.error().code, ErrorCode::unsupported);
    EXPECT_EQ(possible.error().message, tracer.error().message);
    EXPECT_EQ(tracer.error().code, ErrorCode::unsupported);
    EXPECT_FALSE(tracer.error().message.empty());
}

} // namespace
} // namespace vitrail::trace
