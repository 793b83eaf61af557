#include "render/passes/screen_pass.h"

#include "base/assert.h"
#include "render/passes/pass.h"

#include <array>
#include <epoxy/gl.h>
#include <fmt/format.h>

namespace vitrail::render {

void draw_screen(const gfx::Program& program, u32 vertex_array, ScreenArea area, std::initializer_list<u32> textures,
                 ScreenBlend blend, float share) {
    if (blend == ScreenBlend::none)
        glDisable(GL_BLEND);
    else
        glEnable(GL_BLEND);
    if (blend == ScreenBlend::add) glBlendFunc(GL_ONE, GL_ONE);
    if (blend == ScreenBlend::by_share) {
        glBlendFunc(GL_CONSTANT_ALPHA, GL_ONE_MINUS_CONSTANT_ALPHA);
        glBlendColor(0, 0, 0, share);
    }
    glDisable(GL_CULL_FACE);
    glDepthMask(GL_FALSE);
    // The triangle lies infinitely far (depth 0): nearer surfaces are "greater", empty pixels equal.
    if (area == ScreenArea::all)
        glDisable(GL_DEPTH_TEST);
    else
        glEnable(GL_DEPTH_TEST);
    glDepthFunc(area == ScreenArea::surfaces ? GL_LESS : GL_EQUAL);
    glUseProgram(program.name());
    glBindVertexArray(vertex_array);
    if (textures.size() > 0) glBindTextures(0, GLsizei(textures.size()), textures.begin());
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glDisable(GL_BLEND);
}

// As image units name it in shaders.
static std::string_view format_name(u32 format) {
    switch (format) {
    case GL_RGBA16F:
        return "rgba16f";
    case GL_RG16F:
        return "rg16f";
    case GL_R11F_G11F_B10F:
        return "r11f_g11f_b10f";
    case GL_RGBA8:
        return "rgba8";
    case GL_R8:
        return "r8";
    default:
        VX_ASSERT(false);
        return "";
    }
}

Result<ScreenProgram> ScreenProgram::build(const BuildContext& context, ScreenShader shader) {
    VX_ASSERT(shader.formats.size() == 1 || shader.formats.size() == 2);
    ScreenProgram made;
    made.compute_ = context.compute && !shader.derivatives, made.area_ = shader.area, made.blend_ = shader.blend;
    for (std::size_t i = 0; i < shader.formats.size(); ++i)
        shader.defines.push_back(fmt::format("OUT{} {}", i, format_name(shader.formats[i])));
    if (!made.compute_) {
        VX_TRY_ASSIGN(made.program_,
                      context.shaders.program("common/screen.vert.glsl", shader.path, std::move(shader.defines)));
        return made;
    }
    shader.defines.push_back("COMPUTE");
    if (shader.area != ScreenArea::all)
        shader.defines.push_back(fmt::format("AREA {}", shader.area == ScreenArea::surfaces ? 1 : 2));
    if (shader.blend != ScreenBlend::none) shader.defines.push_back("BLEND");
    VX_TRY_ASSIGN(made.program_, context.shaders.compute_program(shader.path, std::move(shader.defines)));
    return made;
}

void ScreenProgram::bind(const gfx::PassContext& pass, std::initializer_list<std::string> reads) const {
    std::array<u32, 8> textures{};
    VX_ASSERT(reads.size() <= textures.size());
    u32 count = 0;
    for (const std::string& name : reads)
        textures[count++] = name.empty() ? 0 : pass.graph.target(name).name();
    glBindTextures(0, GLsizei(count), textures.data());
}

void ScreenProgram::dispatch(const gfx::PassContext& pass, float share) const {
    if (area_ != ScreenArea::all) glBindTextureUnit(u32(Unit::depth), pass.graph.target("depth").name());
    if (blend_ == ScreenBlend::add) glProgramUniform2f(name(), 31, 1, 1);
    if (blend_ == ScreenBlend::by_share) glProgramUniform2f(name(), 31, 1 - share, share);
    glUseProgram(name());
    glDispatchCompute((pass.width + 7) / 8, (pass.height + 7) / 8, 1);
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT | GL_FRAMEBUFFER_BARRIER_BIT |
                    GL_TEXTURE_UPDATE_BARRIER_BIT);
}

void ScreenProgram::run(const gfx::PassContext& pass, u32 vertex_array, std::initializer_list<std::string> writes,
                        std::initializer_list<std::string> reads, float share) const {
    VX_ASSERT(writes.size() <= 2);
    bind(pass, reads);
    if (!compute_) {
        draw_screen(*program_, vertex_array, area_, {}, blend_, share);
        return;
    }
    u32 unit = 0;
    for (const std::string& target : writes) {
        const gfx::Texture& texture = pass.graph.target(target);
        glBindImageTexture(unit++, texture.name(), 0, GL_FALSE, 0,
                           blend_ == ScreenBlend::none ? GL_WRITE_ONLY : GL_READ_WRITE, texture.format);
    }
    dispatch(pass, share);
}

void ScreenProgram::run_into(const gfx::PassContext& pass, const gfx::Texture& texture,
                             std::initializer_list<std::string> reads) const {
    VX_ASSERT(compute_ && blend_ == ScreenBlend::none && texture.width == pass.width && texture.height == pass.height);
    bind(pass, reads);
    glBindImageTexture(0, texture.name(), 0, GL_FALSE, 0, GL_WRITE_ONLY, texture.format);
    dispatch(pass, 1);
}

} // namespace vitrail::render
