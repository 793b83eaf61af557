// Indirect draw commands of the visible sections, one list a pass.
#pragma once

#include "render/culling.h"

#include <array>
#include <vector>

namespace vitrail::render {

// As OpenGL reads it from the indirect buffer.
struct DrawCommand {
    u32 count = 0, instances = 1, first_index = 0;
    i32 base_vertex = 0;
    u32 base_instance = 0; // the section's record
};

// The instance attribute of a section's draws.
struct SectionRecord {
    i32 x = 0, y = 0, z = 0; // blocks from the eye's block
    u32 slots = 0;           // light slot | tint slot << 16
};

enum class DrawKind : u8 { opaque_cubes, opaque_models, cutout_cubes, cutout_models, translucent, count };

struct DrawList {
    static constexpr u32 kQuadsADraw = 16384; // what 16-bit indices reach
    std::vector<SectionRecord> records;
    std::array<std::vector<DrawCommand>, u32(DrawKind::count)> commands;
    u64 quads = 0;
    void clear();
};

// Bit f is set where faces of direction f of a section at this offset can look at the eye (in its block at 0, 0, 0).
u32 facing_directions(IVec3 offset);

// visible: nearest first. two_sided_cutout: keep cutout cubes that look away. facing: bit f is set where cube faces of
// direction f are drawn; 0: those that can look at the eye.
void build_draw_list(const std::vector<VisibleSection>& visible, bool two_sided_cutout, DrawList& out, u32 facing = 0);

} // namespace vitrail::render
