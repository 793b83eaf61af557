// Emitters for direct sampling: lists a chunk and a tree over all of them. Kernel-safe; built by trace/lights/.
#pragma once

#include "trace/kernel/ray.h"

namespace vitrail::trace {

// A cell that shines, with the directions in which it does.
struct Emitter {
    IVec3 cell;
    u32 state = 0;
    float power = 0; // luminance, all open faces
    u32 faces = 63;  // bit a Face: cube faces not covered by neighbors; 64: its quads
};

// Binary tree over emitters (Conty Estevez and Kulla, "Importance Sampling of Many Lights with Adaptive Tree
// Splitting", 2018, without splitting). Boxes in blocks relative to `from`. Bits of `trail` lead from the root to an
// emitter, lowest first.
struct LightNode {
    Vec3 least, most;
    float power = 0;
    u32 first = 0; // inner: left child, the right one follows; leaf: emitter
    u32 leaf = 0;
};

struct LightView {
    const Emitter* emitters = nullptr;
    const LightNode* nodes = nullptr; // root 0; none: count 0
    const u64* trails = nullptr;      // by emitter
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

} // namespace vitrail::trace
