#include "voxel/cell_mask.h"

#include "voxel/cell_mask_wide.h"

#include <algorithm>
#include <cstdlib>
#include <cstring>

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace vitrail {

namespace {

// Bit k of each of 4096 bytes, as a mask.
void gather_byte_classes(const u8* cells, u32 count, CellMask* out) {
    for (u32 k = 0; k < count; ++k) {
        for (u32 w = 0; w < 64; ++w) {
            u64 word = 0;
#if defined(__SSE2__)
            for (u32 q = 0; q < 4; ++q) {
                const __m128i v = _mm_loadu_si128(reinterpret_cast<const __m128i*>(cells + w * 64 + q * 16));
                word |= u64(u32(_mm_movemask_epi8(_mm_slli_epi16(v, int(7 - k))))) << (q * 16);
            }
#else
            for (u32 i = 0; i < 64; ++i)
                word |= u64(cells[w * 64 + i] >> k & 1) << i;
#endif
            out[k][w] = word;
        }
    }
}

// The even bits of x, packed low.
u64 even_bits(u64 x) {
    x &= 0x5555555555555555ull;
    x = (x | x >> 1) & 0x3333333333333333ull;
    x = (x | x >> 2) & 0x0f0f0f0f0f0f0f0full;
    x = (x | x >> 4) & 0x00ff00ff00ff00ffull;
    x = (x | x >> 8) & 0x0000ffff0000ffffull;
    return (x | x >> 16) & 0x00000000ffffffffull;
}

bool wide_cpu() {
    static const bool wide = wide::available() && !std::getenv("VITRAIL_PORTABLE"); // set by tests
    return wide;
}

} // namespace

void map_cells(const BlockStorage& blocks, const u8* values, u8* out) {
    const unsigned bits = blocks.bits();
    const std::size_t entries = blocks.palette().size();
    const u64* words = blocks.words().data();
    if (bits == 0) {
        std::memset(out, values[0], kChunkVolume);
        return;
    }
    if (bits <= 4) {
        u8 table[16] = {};
        std::memcpy(table, values, std::min<std::size_t>(entries, 16));
        if (bits == 4 && wide_cpu()) {
            wide::map_nibbles(words, table, out);
            return;
        }
        const u32 a_byte = 8 / bits, mask = (1u << bits) - 1;
        u64 cells[256]; // the cells of one byte of indices, at most 8
        for (u32 b = 0; b < 256; ++b) {
            u8 value[8] = {};
            for (u32 i = 0; i < a_byte; ++i)
                value[i] = table[b >> (i * bits) & mask];
            std::memcpy(&cells[b], value, 8);
        }
        for (u32 w = 0; w < bits * 64; ++w)
            for (u32 i = 0; i < 8; ++i, out += a_byte)
                std::memcpy(out, &cells[words[w] >> (i * 8) & 255], a_byte);
        return;
    }
    const u32 a_word = 64 / bits;
    const u64 mask = bits == 8 ? 255 : 65535;
    for (u32 w = 0; w < bits * 64; ++w)
        for (u32 i = 0; i < a_word; ++i)
            *out++ = values[words[w] >> (i * bits) & mask];
}

void classify_cells(const BlockStorage& blocks, const u8* classes, u32 count, CellMask* out) {
    const unsigned bits = blocks.bits();
    const u64* words = blocks.words().data();
    const std::size_t entries = blocks.palette().size();
    const auto all = [&](u32 entry, u32 k) { return entry < entries && (classes[entry] >> k & 1) ? ~u64(0) : 0; };
    if (bits == 0) {
        for (u32 k = 0; k < count; ++k)
            out[k].fill(all(0, k));
        return;
    }
    if (bits == 1) {
        for (u32 k = 0; k < count; ++k) {
            const u64 a = all(0, k), b = all(1, k);
            for (u32 w = 0; w < 64; ++w)
                out[k][w] = (words[w] & b) | (~words[w] & a);
        }
        return;
    }
    if (bits == 2) {
        CellMask low, high;
        for (u32 w = 0; w < 64; ++w) {
            low[w] = even_bits(words[2 * w]) | even_bits(words[2 * w + 1]) << 32;
            high[w] = even_bits(words[2 * w] >> 1) | even_bits(words[2 * w + 1] >> 1) << 32;
        }
        for (u32 k = 0; k < count; ++k) {
            const u64 a = all(0, k), b = all(1, k), c = all(2, k), d = all(3, k);
            for (u32 w = 0; w < 64; ++w)
                out[k][w] = (~high[w] & ((~low[w] & a) | (low[w] & b))) | (high[w] & ((~low[w] & c) | (low[w] & d)));
        }
        return;
    }
    if (bits == 4 && wide_cpu()) {
        u8 table[16] = {};
        std::memcpy(table, classes, std::min<std::size_t>(entries, 16));
        wide::classify_nibbles(words, table, count, out->data());
        return;
    }
    alignas(64) u8 cells[kChunkVolume];
    map_cells(blocks, classes, cells);
    if (wide_cpu())
        wide::classify_bytes(cells, count, out->data());
    else
        gather_byte_classes(cells, count, out);
}

CellMask cells_with_flag(const BlockStorage& blocks, const u8* flags, u8 bits) {
    const auto palette = blocks.palette();
    CellMask out;
    if (palette.size() <= 256) {
        u8 classes[256];
        for (std::size_t i = 0; i < palette.size(); ++i)
            classes[i] = (flags[u32(palette[i])] & bits) != 0;
        classify_cells(blocks, classes, 1, &out);
    } else {
        std::vector<u8> classes(palette.size());
        for (std::size_t i = 0; i < palette.size(); ++i)
            classes[i] = (flags[u32(palette[i])] & bits) != 0;
        classify_cells(blocks, classes.data(), 1, &out);
    }
    return out;
}

} // namespace vitrail
