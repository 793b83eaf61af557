#include "render/passes/outline/outline_pass.h"

#include <epoxy/gl.h>

namespace vitrail::render {

void draw_outline(const gfx::Program& program, u32 vertex_array, u32 view, std::span<const Box> boxes) {
    glUseProgram(program.name());
    glProgramUniform1ui(program.name(), 0, view);
    glBindVertexArray(vertex_array);
    glDisable(GL_CULL_FACE);
    for (const Box& box : boxes) {
        glVertexAttrib4f(0, box.min.x, box.min.y, box.min.z, 0);
        glVertexAttrib4f(1, box.max.x, box.max.y, box.max.z, 0);
        glDrawArrays(GL_TRIANGLES, 0, 72);
    }
}

} // namespace vitrail::render
