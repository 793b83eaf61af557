// Emitters for direct sampling: cells that shine, and a tree over all of them. Kernel-safe; built by trace/lights/.
#pragma once

#include "trace/kernel/ray.h"

namespace vitrail::trace {

// A cell that shines, with the directions in which it does.
struct Emitter {
    static constexpr u32 kQuads = 64;
    IVec3 cell;
    u32 state = 0;
    float power = 0; // luminance of the texels x area, all that is open
    u32 faces = 0;   // bit a Face: cube faces that shine and are not covered by neighbors; kQuads: its quads
    u32 node = 0;    // its leaf
};

// Binary tree over emitters (Conty Estevez and Kulla, "Importance Sampling of Many Lights with Adaptive Tree
// Splitting", 2018, without splitting). Boxes in blocks relative to `LightView::from`. Instead of a cone of normals a
// node keeps the share of its power that goes along each axis: most faces here stand square to one. Children know their
// parent, so that the chance of an emitter is found from its leaf upwards, and a subtree stays as it is when the tree
// above it is made anew.
struct LightNode {
    Vec3 least, most;
    float power = 0;
    u32 first = 0;                     // inner: left child, the right one follows; leaf: emitter
    u32 parent = 0;                    // the root's: itself
    u8 shares[6] = {0, 0, 0, 0, 0, 0}; // by Face, 255: all; rounded up, so that 0 means none
    u8 leaf = 0;
    u8 pad = 0;
};
static_assert(sizeof(LightNode) == 44);

struct LightView {
    const Emitter* emitters = nullptr;
    const LightNode* nodes = nullptr; // root 0; none: count 0
    // Finds the emitter of a cell: open addressing, capacity 2^bits, entries emitter + 1, 0 free; hash:
    // light_cell_hash.
    const u32* table = nullptr;
    u32 table_bits = 0;
    u32 count = 0;
    IVec3 from;
};

VX_HD u32 light_cell_hash(IVec3 c, u32 bits) {
    u32 h = u32(c.x) * 0x9E3779B1u ^ u32(c.y) * 0x85EBCA77u ^ u32(c.z) * 0xC2B2AE3Du;
    h ^= h >> 15;
    h *= 0x2C1B3C6Du;
    return h >> (32 - bits);
}

inline constexpr u32 kNoEmitter = 0xFFFFFFFFu;

VX_HD u32 find_emitter(const LightView& l, IVec3 cell) {
    if (l.count == 0) return kNoEmitter;
    const u32 mask = (1u << l.table_bits) - 1;
    for (u32 i = light_cell_hash(cell, l.table_bits);; i = (i + 1) & mask) {
        const u32 entry = l.table[i];
        if (entry == 0) return kNoEmitter;
        if (l.emitters[entry - 1].cell == cell) return entry - 1;
    }
}

} // namespace vitrail::trace
