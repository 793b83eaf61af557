// Numbers for the quads that a frame may show, so that a pixel need hold no more of its quad than one word
// (shown.frag.glsl), and where surfaces.comp.glsl finds the section of each number.
#pragma once

#include "render/frame_context.h"

namespace vitrail::render {

// A section of a view, as surfaces.comp.glsl reads it; `base` is also a vertex attribute.
struct ShownSection {
    SectionRecord record;
    u32 base = 0; // number of a quad = its place in the quads' buffer + base, modulo 2^31
    u32 view = 0;
    u32 unused[2] = {};
};
static_assert(sizeof(ShownSection) == 32);

struct ShownSections {
    u32 buffer = 0;
    u64 offset = 0, bytes = 0;
    u32 shift = 0; // number of a quad >> shift: number of its section over all views
};

// Uploads them for all views and tells every view's inputs where theirs begin. A number has 31 bits: 65,000 sections in
// view at 32,000 quads in the largest of them, more than any view distance holds.
ShownSections number_shown(FrameContext& frame);

} // namespace vitrail::render
