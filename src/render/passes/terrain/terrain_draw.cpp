#include "render/passes/terrain/terrain_draw.h"

#include "render/passes/terrain/shown.h"

#include <epoxy/gl.h>

namespace vitrail::render {

void bind_terrain(const TerrainInputs& in) {
    glBindVertexArray(in.vertex_array);
    glVertexArrayVertexBuffer(in.vertex_array, 0, in.records, GLintptr(in.records_offset), sizeof(SectionRecord));
    if (in.shown) {
        glEnableVertexArrayAttrib(in.vertex_array, 1);
        glVertexArrayVertexBuffer(in.vertex_array, 1, in.shown, GLintptr(in.shown_offset), sizeof(ShownSection));
    } else {
        glDisableVertexArrayAttrib(in.vertex_array, 1);
    }
    glBindBuffer(GL_DRAW_INDIRECT_BUFFER, in.commands);
    const u32 storage[4] = {in.quads, in.tints, in.fixed_tints, in.models};
    for (u32 i = 0; i < 4; ++i)
        glBindBufferBase(GL_SHADER_STORAGE_BUFFER, i, storage[i]);
    const u32 textures[3] = {in.albedo, in.light, in.material};
    glBindTextures(0, 3, textures);
    glFrontFace(in.mirrored ? GL_CW : GL_CCW);
}

void draw_kind(const gfx::Program& program, const TerrainInputs& in, DrawKind kind, bool cull, u32 mode) {
    static_assert(GL_TRIANGLES == 4);
    const TerrainInputs::Range range = in.ranges[u32(kind)];
    if (range.count == 0) return;
    glUseProgram(program.name());
    glProgramUniform1ui(program.name(), 0, in.view);
    if (in.light_atlas.w > 0)
        glProgramUniform4f(program.name(), 1, in.light_atlas.x, in.light_atlas.y, in.light_atlas.z, in.light_atlas.w);
    if (cull)
        glEnable(GL_CULL_FACE);
    else
        glDisable(GL_CULL_FACE);
    glMultiDrawElementsIndirect(mode, GL_UNSIGNED_SHORT, reinterpret_cast<const void*>(range.offset),
                                GLsizei(range.count), 0);
}

} // namespace vitrail::render
