// The picture in an OpenGL texture is the one that the tracer tells.
#include "content_fixture.h"
#include "gfx/handles.h"
#include "platform/headless.h"
#include "scene/sky.h"
#include "trace/tracer.h"

#include <cstdlib>
#include <epoxy/gl.h>
#include <string_view>

namespace vitrail::trace {
namespace {

constexpr u32 kWidth = 40, kHeight = 24;

std::vector<float> read_texture(u32 texture) {
    std::vector<float> out(std::size_t(kWidth) * kHeight * 4);
    glGetTextureImage(texture, 0, GL_RGBA, GL_FLOAT, GLsizei(out.size() * sizeof(float)), out.data());
    return out;
}

class IntoTexture : public testing::TestWithParam<Device> {};

TEST_P(IntoTexture, IsWhatTheTracerTells) {
    setenv("VITRAIL_GL", "software", 0); // unless something else is asked for
    auto context = platform::HeadlessContext::create();
    if (!context) GTEST_SKIP() << context.error().message;
    auto made = Tracer::create({.device = GetParam(), .window_chunks = 8});
    if (!made) GTEST_SKIP() << made.error().message;
    Tracer& tracer = **made;
    const BaseContent& content = base_content();
    ASSERT_TRUE(tracer.set_content(content.models, *content.states, &content.pictures));
    auto chunk = std::make_shared<Chunk>();
    for (u32 i = 0; i < 256; ++i)
        chunk->blocks.set(LocalPos(i % 16, i / 40, i / 16), StateId(content.id("oak_planks")));
    tracer.set_chunk({0, 0, 0}, DimensionId{}, chunk, nullptr);

    scene::FrameView frame;
    frame.width = kWidth, frame.height = kHeight;
    frame.sky = scene::sky_at(4000);
    scene::View view;
    view.eye.at = {kFixedOne * 8, kFixedOne * 12, kFixedOne * -6};
    view.rotation = view_rotation(0.1f, 0.4f);
    frame.views.push_back(view);

    for (const u32 format : {GL_RGBA32F, GL_RGBA16F}) {
        const gfx::Texture texture = gfx::make_texture_2d(format, kWidth, kHeight);
        for (u32 n = 0; n < 2; ++n) { // the second time what stands is used again
            ASSERT_TRUE(tracer.render(frame, {}));
            const auto written = tracer.write_texture(texture.name());
            ASSERT_TRUE(written) << written.error().message;
            const std::vector<float> color = tracer.read(Layer::color), distance = tracer.read(Layer::distance),
                                     seen = read_texture(texture.name());
            double light = 0, far = 0;
            u32 far_off = 0;
            for (std::size_t i = 0; i < distance.size(); ++i) {
                const float close = format == GL_RGBA32F ? 1e-6f : 2e-3f;
                for (std::size_t c = 0; c < 3; ++c) {
                    ASSERT_NEAR(seen[i * 4 + c], color[i * 3 + c], close * (1 + color[i * 3 + c])) << i;
                    light += color[i * 3 + c];
                }
                far_off += std::fabs(seen[i * 4 + 3] - distance[i]) > 0.02f * (1 + distance[i]);
                far += distance[i];
            }
            EXPECT_GT(light, 0);
            EXPECT_GT(far, 0);
            EXPECT_LT(far_off, kWidth * kHeight / 10); // one sample's, and the mean of all: unlike at edges
        }
    }
    const auto* vendor = reinterpret_cast<const char*>(glGetString(GL_VENDOR));
    const bool own = GetParam() == Device::cuda && std::string_view(vendor).find("NVIDIA") != std::string_view::npos;
    EXPECT_EQ(tracer.stats().shown_directly, own);
}
INSTANTIATE_TEST_SUITE_P(Devices, IntoTexture, testing::Values(Device::cpu, Device::cuda));

} // namespace
} // namespace vitrail::trace
