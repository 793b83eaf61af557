#include "render/passes/scene_copy/scene_copy_pass.h"

#include <algorithm>
#include <epoxy/gl.h>

namespace vitrail::render {

Result<> SceneCopyPass::build(const BuildContext& context) {
    if (!wanted(context.effects)) return {};
    VX_TRY_ASSIGN(program_, ScreenProgram::build(
                                context, {.path = "scene_copy/scene_copy.screen.glsl", .formats = {GL_RGBA16F}}));
    mips_.reset();
    if (context.compute && context.effects.reflections.on) {
        VX_TRY_ASSIGN(mips_, context.shaders.compute_program("scene_copy/mips.comp.glsl"));
    }
    return {};
}

void SceneCopyPass::make_levels(const gfx::Texture& picture) const {
    if (!mips_) {
        glGenerateTextureMipmap(picture.name());
        return;
    }
    constexpr u32 kAtOnce = 5;
    glUseProgram(mips_->name());
    glBindTextureUnit(0, picture.name());
    for (u32 from = 0; from + 1 < picture.levels; from += kAtOnce) {
        const u32 count = std::min(kAtOnce, picture.levels - 1 - from);
        for (u32 k = 0; k < count; ++k)
            glBindImageTexture(k, picture.name(), GLint(from + 1 + k), GL_FALSE, 0, GL_WRITE_ONLY, picture.format);
        glProgramUniform2i(mips_->name(), 0, GLint(from), GLint(count));
        const u32 width = std::max(picture.width >> (from + 1), 1u),
                  height = std::max(picture.height >> (from + 1), 1u);
        glDispatchCompute((width + 15) / 16, (height + 15) / 16, 1);
        glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_TEXTURE_UPDATE_BARRIER_BIT);
    }
}

void SceneCopyPass::declare(DeclareContext& c) {
    if (!wanted(c.effects)) return;
    const bool mips = c.effects.reflections.on;
    c.graph.add_target({.name = "scene", .format = GL_RGBA16F, .linear = true, .mips = mips});
    c.graph.add_pass({"scene copy",
                      {c.color, "surface", "depth"},
                      {"scene"},
                      [this, color = c.color, mips](const gfx::PassContext& p) {
                          program_.run(p, frame_->plain_array, {"scene"}, {color, "", "surface", "depth"});
                          if (mips) make_levels(p.graph.target("scene"));
                      },
                      ""});
}

} // namespace vitrail::render
