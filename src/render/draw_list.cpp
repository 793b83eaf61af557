#include "render/draw_list.h"

#include <algorithm>

namespace vitrail::render {

void DrawList::clear() {
    records.clear();
    for (auto& list : commands)
        list.clear();
    quads = 0;
}

u32 facing_directions(IVec3 o) {
    // -x faces lie at x = o .. o + 15 and look at eyes below: some can where the eye's block (which reaches to 1)
    // starts below the last; +x faces lie at o + 1 .. o + 16.
    const i32 at[3] = {o.x, o.y, o.z};
    u32 mask = 1u << 6;
    for (u32 axis = 0; axis < 3; ++axis) {
        if (at[axis] + 15 > 0) mask |= 1u << (axis * 2);
        if (at[axis] + 1 < 1) mask |= 2u << (axis * 2);
    }
    return mask;
}

namespace {

void push(std::vector<DrawCommand>& out, u32 first_quad, u32 count, u32 record, u64& quads) {
    quads += count;
    while (count > 0) {
        const u32 part = std::min(count, DrawList::kQuadsADraw);
        out.push_back({part * 6, 1, 0, i32(first_quad * 4), record});
        first_quad += part;
        count -= part;
    }
}

} // namespace

void build_draw_list(const std::vector<VisibleSection>& visible, bool two_sided_cutout, DrawList& out, u32 facing_all) {
    out.clear();
    for (const VisibleSection& v : visible) {
        const Section& s = *v.section;
        const u32 record = u32(out.records.size());
        out.records.push_back({v.offset.x, v.offset.y, v.offset.z, s.light_slot | s.tint_slot << 16});
        const u32 facing = facing_all ? facing_all : facing_directions(v.offset);
        for (QuadPass pass : {QuadPass::opaque, QuadPass::cutout}) {
            const bool cutout = pass == QuadPass::cutout;
            auto& cubes = out.commands[u32(cutout ? DrawKind::cutout_cubes : DrawKind::opaque_cubes)];
            const u32 mask = cutout && two_sided_cutout ? 127 : facing;
            // Neighboring groups that are both drawn become one command.
            u32 start = 0, end = 0;
            for (u32 d = 0; d < 6; ++d) {
                const u32 g = SectionMesh::group(pass, d);
                const u32 a = s.first[g], b = s.first[g + 1];
                if (a == b || !(mask >> d & 1)) continue;
                if (end != a) {
                    if (end > start) push(cubes, s.first_quad + start, end - start, record, out.quads);
                    start = a;
                }
                end = b;
            }
            if (end > start) push(cubes, s.first_quad + start, end - start, record, out.quads);
            const u32 g = SectionMesh::group(pass, 6);
            if (s.first[g + 1] > s.first[g])
                push(out.commands[u32(cutout ? DrawKind::cutout_models : DrawKind::opaque_models)],
                     s.first_quad + s.first[g], s.first[g + 1] - s.first[g], record, out.quads);
        }
    }
    // Back to front, all directions in their sorted order: depth does not hide what translucent faces let through.
    auto& translucent = out.commands[u32(DrawKind::translucent)];
    for (u32 i = u32(visible.size()); i-- > 0;) {
        const Section& s = *visible[i].section;
        const u32 count = s.group_size(QuadPass::translucent);
        if (count)
            push(translucent, s.first_quad + s.first[SectionMesh::group(QuadPass::translucent, 0)], count, i,
                 out.quads);
    }
}

} // namespace vitrail::render
