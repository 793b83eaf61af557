#include "render/passes/terrain/terrain_pass.h"

#include "render/shader_library.h"

#include <epoxy/gl.h>

namespace vitrail::render {

Result<TerrainPrograms> make_terrain_programs(bool high) {
    TerrainPrograms programs;
    struct Kind {
        DrawKind kind;
        const char* name;
        const char* fragment;
        std::vector<std::string> defines;
    };
    const Kind kinds[] = {
        {DrawKind::opaque_cubes, "terrain cubes", "terrain/terrain.frag.glsl", {"MODEL 0"}},
        {DrawKind::opaque_models, "terrain models", "terrain/terrain.frag.glsl", {"MODEL 1"}},
        {DrawKind::cutout_cubes, "cutout cubes", "terrain/terrain.frag.glsl", {"MODEL 0", "CUTOUT"}},
        {DrawKind::cutout_models, "cutout models", "terrain/terrain.frag.glsl", {"MODEL 1", "CUTOUT"}},
        {DrawKind::translucent, "translucent terrain", "water/water.frag.glsl", {"MODEL 2", "LIQUID"}},
    };
    for (const Kind& kind : kinds) {
        std::vector<std::string> defines = kind.defines;
        if (high) defines.push_back("HIGH");
        VX_TRY_ASSIGN(programs.kinds[u32(kind.kind)],
                      load_program(kind.name, "terrain/terrain.vert.glsl", kind.fragment, std::move(defines)));
    }
    return programs;
}

static void bind(const TerrainInputs& in) {
    glBindVertexArray(in.vertex_array);
    glVertexArrayVertexBuffer(in.vertex_array, 0, in.records, GLintptr(in.records_offset), sizeof(SectionRecord));
    glBindBuffer(GL_DRAW_INDIRECT_BUFFER, in.commands);
    const u32 storage[4] = {in.quads, in.tints, in.fixed_tints, in.models};
    for (u32 i = 0; i < 4; ++i)
        glBindBufferBase(GL_SHADER_STORAGE_BUFFER, i, storage[i]);
    const u32 textures[4] = {in.albedo, in.light, in.material, in.depth};
    glBindTextures(0, 4, textures);
    glFrontFace(in.mirrored ? GL_CW : GL_CCW);
}

static void draw(const TerrainPrograms& programs, const TerrainInputs& in, DrawKind kind, bool cull) {
    const TerrainInputs::Range range = in.ranges[u32(kind)];
    if (range.count == 0) return;
    const u32 program = programs.kinds[u32(kind)].name();
    glUseProgram(program);
    glProgramUniform1ui(program, 0, in.view);
    glProgramUniform4f(program, 1, in.light_atlas.x, in.light_atlas.y, in.light_atlas.z, in.light_atlas.w);
    if (cull)
        glEnable(GL_CULL_FACE);
    else
        glDisable(GL_CULL_FACE);
    glMultiDrawElementsIndirect(GL_TRIANGLES, GL_UNSIGNED_SHORT, reinterpret_cast<const void*>(range.offset),
                                GLsizei(range.count), 0);
}

void draw_terrain_opaque(const TerrainPrograms& programs, const TerrainInputs& in) {
    bind(in);
    draw(programs, in, DrawKind::opaque_cubes, true);
    // Models decide by quad which look away (kTwoSided); cutout cubes show their far side through their holes.
    draw(programs, in, DrawKind::opaque_models, false);
    draw(programs, in, DrawKind::cutout_cubes, false);
    draw(programs, in, DrawKind::cutout_models, false);
}

void draw_terrain_translucent(const TerrainPrograms& programs, const TerrainInputs& in) {
    bind(in);
    draw(programs, in, DrawKind::translucent, false);
}

} // namespace vitrail::render
