#include "render/passes/terrain/shown.h"

#include <algorithm>
#include <bit>

namespace vitrail::render {

ShownSections number_shown(FrameContext& frame) {
    u32 sections = 0, largest = 1; // quads that are no translucent ones, which come last in a section
    for (const ViewDraws& view : frame.views) {
        sections += u32(view.list.records.size());
        for (const VisibleSection& v : view.visible)
            largest = std::max(largest, v.section->first[SectionMesh::group(QuadPass::translucent, 0)]);
    }
    ShownSections made;
    for (ViewDraws& view : frame.views)
        view.inputs.shown = 0;
    if (sections == 0) return made;
    made.shift = u32(std::bit_width(largest - 1));
    const auto slice = frame.ring->allocate(u64(sections) * sizeof(ShownSection), 256);
    made.buffer = slice.buffer, made.offset = slice.offset, made.bytes = slice.bytes;
    auto* out = reinterpret_cast<ShownSection*>(slice.data);
    u32 number = 0;
    for (u32 i = 0; i < frame.views.size(); ++i) {
        ViewDraws& view = frame.views[i];
        view.inputs.shown = slice.buffer;
        view.inputs.shown_offset = slice.offset + u64(number) * sizeof(ShownSection);
        for (std::size_t k = 0; k < view.list.records.size(); ++k, ++number)
            out[number] = {view.list.records[k], (number << made.shift) - view.visible[k].section->first_quad, i, {}};
    }
    return made;
}

} // namespace vitrail::render
