// Drawing of sections by multi-draws, one a kind of quad; shared by the passes that draw terrain (G-buffer, shadows,
// water, occlusion).
#pragma once

#include "gfx/handles.h"
#include "render/draw_list.h"

namespace vitrail::render {

// What the draws of one view read; OpenGL names.
struct TerrainInputs {
    u32 vertex_array = 0;
    u32 quads = 0, tints = 0, fixed_tints = 0, models = 0; // storage buffers
    u32 records = 0;                                       // vertex buffer of SectionRecord
    u64 records_offset = 0;
    u32 commands = 0; // indirect buffer
    u32 shown = 0;    // vertex buffer of ShownSection (terrain_pass.h), beside the records; 0: none
    u64 shown_offset = 0;
    struct Range {
        u64 offset = 0;
        u32 count = 0;
    };
    Range ranges[u32(DrawKind::count)];
    u32 albedo = 0, material = 0, light = 0; // textures
    Vec4 light_atlas;                        // 1 / texels of each axis, bricks a row; all 0: the programs ask for none
    u32 view = 0;
    bool mirrored = false;
};

// Binds vertex array, storage buffers, indirect buffer, and the textures at units 0 to 2.
void bind_terrain(const TerrainInputs& in);
// The program's uniforms 0 (view) and 1 (light atlas, where there is one) are set; nothing is drawn where there is
// nothing of this kind. mode: GL_TRIANGLES (the default), or GL_PATCHES of six indices, a quad each.
void draw_kind(const gfx::Program& program, const TerrainInputs& in, DrawKind kind, bool cull, u32 mode = 4);

} // namespace vitrail::render
