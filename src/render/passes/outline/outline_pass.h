// Edges of the picked block's boxes.
#pragma once

#include "gfx/handles.h"
#include "math/vec.h"

#include <span>

namespace vitrail::render {

// boxes: camera-relative, blocks. Draws with blending and depth test into the bound framebuffer.
void draw_outline(const gfx::Program& program, u32 vertex_array, u32 view, std::span<const Box> boxes);

} // namespace vitrail::render
