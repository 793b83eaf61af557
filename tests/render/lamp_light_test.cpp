// What levels of lamps mean stands twice in the sources, as a shader and for the tracer: both say the same.
#include "scene/lamp_light.h"

#include "gfx/handles.h"
#include "gfx/program.h"
#include "render/shader_library.h"
#include "render_fixture.h"

#include <epoxy/gl.h>

namespace vitrail::render {

using LampLightTest = RenderTest;

TEST_F(LampLightTest, ShadersKnowTheSameLevels) {
    ShaderLibrary shaders;
    const auto lamps = shaders.text("lighting/lamp_light.glsl");
    ASSERT_TRUE(lamps) << lamps.error().message;
    gfx::ProgramSource source;
    source.name = "lamp light test";
    source.compute = *lamps + R"(
layout(local_size_x = 64) in;
layout(std430, binding = 5) buffer Answers { vec4 answers[]; };
void main() {
    uint i = gl_GlobalInvocationID.x;
    answers[i] = vec4(lamp_light(vec3(i & 15u, i >> 4 & 15u, i >> 8) * (1.0 / 15.0)), 0.0);
}
)";
    const auto program = gfx::build_program(source);
    ASSERT_TRUE(program) << program.error().message;
    constexpr u32 kLevels = 16 * 16 * 16;
    const auto out = gfx::make_buffer(kLevels * 16, GL_DYNAMIC_STORAGE_BIT, nullptr);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 5, out.name());
    glUseProgram(program->name());
    glDispatchCompute(kLevels / 64, 1, 1);
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    std::vector<float> answers(kLevels * 4);
    glGetNamedBufferSubData(out.name(), 0, GLsizeiptr(answers.size() * 4), answers.data());
    for (u32 i = 0; i < kLevels; ++i) {
        const Vec3 want =
            scene::lamp_light(Vec3{float(i & 15), float(i >> 4 & 15), float(i >> 8)} * (1 / scene::kLevelMost));
        EXPECT_NEAR(answers[i * 4], want.x, 1e-5f) << i;
        EXPECT_NEAR(answers[i * 4 + 1], want.y, 1e-5f) << i;
        EXPECT_NEAR(answers[i * 4 + 2], want.z, 1e-5f) << i;
    }
}

} // namespace vitrail::render
