// Terrain into the G-buffer, and translucent terrain over the lit picture: one multi-draw a kind of quad.
// Cracks at T-junctions: a cube quad grows outwards in its plane by kSeal (terrain.vert.glsl) of a pixel.
#pragma once

#include "base/result.h"
#include "gfx/handles.h"
#include "render/draw_list.h"

namespace vitrail::render {

struct TerrainPrograms {
    gfx::Program kinds[u32(DrawKind::count)];
};
// high: normal maps, swaying plants, filtered tints, water that sees its depth. Errors: invalid_argument.
Result<TerrainPrograms> make_terrain_programs(bool high);

// What the draws of one view read; OpenGL names.
struct TerrainInputs {
    u32 vertex_array = 0;
    u32 quads = 0, tints = 0, fixed_tints = 0, models = 0; // storage buffers
    u32 records = 0;                                       // vertex buffer of SectionRecord
    u64 records_offset = 0;
    u32 commands = 0; // indirect buffer
    struct Range {
        u64 offset = 0;
        u32 count = 0;
    };
    Range ranges[u32(DrawKind::count)];
    u32 albedo = 0, material = 0, light = 0, depth = 0; // textures
    Vec4 light_atlas;                                   // 1 / texels of each axis, bricks a row
    u32 view = 0;
    bool mirrored = false;
};

void draw_terrain_opaque(const TerrainPrograms& programs, const TerrainInputs& in); // opaque, then cutout
void draw_terrain_translucent(const TerrainPrograms& programs, const TerrainInputs& in);

} // namespace vitrail::render
