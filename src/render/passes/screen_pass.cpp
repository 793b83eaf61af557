#include "render/passes/screen_pass.h"

#include <epoxy/gl.h>

namespace vitrail::render {

void draw_screen(const gfx::Program& program, u32 vertex_array, ScreenArea area, std::initializer_list<u32> textures,
                 ScreenBlend blend, float share) {
    if (blend == ScreenBlend::none)
        glDisable(GL_BLEND);
    else
        glEnable(GL_BLEND);
    if (blend == ScreenBlend::over) glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
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
    glBindTextures(0, GLsizei(textures.size()), textures.begin());
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glDisable(GL_BLEND);
}

} // namespace vitrail::render
