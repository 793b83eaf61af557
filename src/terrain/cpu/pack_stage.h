// One section of 16^3 blocks as a palette and packed indices. Vectors of bytes; L only keeps builds for different vector sets
// apart.
#pragma once

#include "terrain/tiles.h"

namespace vitrail {

// Indices take 0 (one block alone), 1, 2, 4 or 8 bits, several to a word, the first in the lowest bits.
struct PackedSection {
    u32 count = 0, bits = 0;
    Block palette[kBlocksMost]; // in order of first appearance
    u64 words[kChunkVolume / 8];
};

namespace pack_detail {

using Bytes = u8 __attribute__((vector_size(64)));
using Pairs = u16 __attribute__((vector_size(64)));
using HalfBytes = u8 __attribute__((vector_size(32)));

VX_HD u64 any_bits(Bytes v) {
    u64 w[8];
    __builtin_memcpy(w, &v, sizeof w);
    return (w[0] | w[1]) | (w[2] | w[3]) | (w[4] | w[5]) | (w[6] | w[7]);
}

// Two neighboring cells of `Bits` bits become one of twice as many; half as many bytes come out.
template <int Bits>
VX_HD HalfBytes joined(Bytes v) {
    const Pairs p = (Pairs)v;
    return __builtin_convertvector((p | p >> (8 - Bits)) & u16((1u << (2 * Bits)) - 1), HalfBytes);
}

// Bytes that hold one cell each below 2^Bits, to 8 / Bits cells a byte.
template <int Bits>
VX_HD void squeeze(u8* cells) {
    for (i32 i = 0; i < kChunkVolume; i += 64) {
        Bytes v;
        __builtin_memcpy(&v, cells + i, sizeof v);
        const HalfBytes h = joined<Bits>(v);
        __builtin_memcpy(cells + i / 2, &h, sizeof h);
    }
    if constexpr (Bits < 4)
        for (i32 i = 0; i < kChunkVolume / 2; i += 64) {
            Bytes v;
            __builtin_memcpy(&v, cells + i, sizeof v);
            const HalfBytes h = joined<2 * Bits>(v);
            __builtin_memcpy(cells + i / 2, &h, sizeof h);
        }
    if constexpr (Bits < 2)
        for (i32 i = 0; i < kChunkVolume / 4; i += 64) {
            Bytes v;
            __builtin_memcpy(&v, cells + i, sizeof v);
            const HalfBytes h = joined<4>(v);
            __builtin_memcpy(cells + i / 2, &h, sizeof h);
        }
}

} // namespace pack_detail

template <class L>
void pack_stage(const Block* blocks, PackedSection& out) {
    using namespace pack_detail;
    u8* cells = reinterpret_cast<u8*>(out.words);
    out.count = 0;
    for (i32 i = 0; i < kChunkVolume; i += 64) {
        Bytes v, index{}, open = Bytes{} - 1; // open: lanes whose block has no slot yet
        __builtin_memcpy(&v, blocks + i, sizeof v);
        for (u32 k = 0;; ++k) {
            if (k == out.count) {
                if (any_bits(open) == 0) break;
                u8 lanes[64];
                __builtin_memcpy(lanes, &open, sizeof lanes);
                i32 first = 0;
                while (lanes[first] == 0) ++first;
                out.palette[out.count++] = blocks[i + first];
            }
            const Bytes here = (Bytes)(v == out.palette[k]);
            index = index | (here & u8(k));
            open = open & ~here;
        }
        __builtin_memcpy(cells + i, &index, sizeof index);
    }
    out.bits = out.count == 1 ? 0 : out.count <= 2 ? 1 : out.count <= 4 ? 2 : out.count <= 16 ? 4 : 8;
    if (out.bits == 1) squeeze<1>(cells);
    if (out.bits == 2) squeeze<2>(cells);
    if (out.bits == 4) squeeze<4>(cells);
}

} // namespace vitrail
