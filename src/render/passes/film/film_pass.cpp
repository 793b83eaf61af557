#include "render/passes/film/film_pass.h"

#include "render/passes/screen_pass.h"

#include <epoxy/gl.h>

namespace vitrail::render {

Result<> FilmPass::build(const BuildContext& context) {
    VX_TRY_ASSIGN(program_, context.shaders.program("common/screen.vert.glsl", "film/film.frag.glsl"));
    return {};
}

void FilmPass::declare(DeclareContext& c) {
    c.graph.add_target({.name = "depth", .format = GL_DEPTH_COMPONENT32F});
    c.graph.add_target({.name = "color", .format = GL_RGBA16F, .linear = true});
    c.graph.add_pass({"film",
                      {},
                      {"color", "depth"},
                      [this](const gfx::PassContext&) {
                          glEnable(GL_DEPTH_TEST); // else depth is not written
                          glDepthFunc(GL_ALWAYS);
                          glDepthMask(GL_TRUE);
                          glDisable(GL_CULL_FACE);
                          glDisable(GL_BLEND);
                          glUseProgram(program_->name());
                          glBindTextureUnit(0, film_);
                          glBindVertexArray(frame_->plain_array);
                          glDrawArrays(GL_TRIANGLES, 0, 3);
                      },
                      ""});
}

} // namespace vitrail::render
