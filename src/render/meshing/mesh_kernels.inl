// Included by mesh_kernels_portable.cpp, _avx2.cpp and _avx512.cpp: the same code under different compiler flags. Loops
// over 16 lanes of one row are left to the compiler to vectorize; gathering bits has its own lines for each width.
#include "render/meshing/mesh_kernels.h"

#include <bit>
#include <cstring>
#if defined(__x86_64__)
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized" // false alarms inside g++ 12's own intrinsics
#endif
#include <immintrin.h>
#endif

namespace vitrail::render {

namespace {

void expand(const u64* words, u32 bits, u8* __restrict cells) {
    const u8* bytes = reinterpret_cast<const u8*>(words); // little-endian, as every machine we build for
    switch (bits) {
    case 1:
        for (u32 i = 0; i < 512; ++i)
            for (u32 k = 0; k < 8; ++k)
                cells[i * 8 + k] = bytes[i] >> k & 1;
        break;
    case 2:
        for (u32 i = 0; i < 1024; ++i)
            for (u32 k = 0; k < 4; ++k)
                cells[i * 4 + k] = bytes[i] >> (2 * k) & 3;
        break;
    case 4:
        for (u32 i = 0; i < 2048; ++i) {
            cells[i * 2] = bytes[i] & 15;
            cells[i * 2 + 1] = bytes[i] >> 4;
        }
        break;
    default:
        std::memcpy(cells, bytes, 4096);
    }
}

// Bit i of the answer: p[i] has its highest bit set; 64 bytes.
inline u64 high_bits(const u8* p) {
#if defined(__AVX512BW__)
    return _mm512_movepi8_mask(_mm512_loadu_si512(p));
#elif defined(__AVX2__)
    const u32 lo = u32(_mm256_movemask_epi8(_mm256_loadu_si256(reinterpret_cast<const __m256i*>(p))));
    const u32 hi = u32(_mm256_movemask_epi8(_mm256_loadu_si256(reinterpret_cast<const __m256i*>(p + 32))));
    return lo | u64(hi) << 32;
#elif defined(__SSE2__)
    u64 out = 0;
    for (u32 i = 0; i < 4; ++i)
        out |= u64(u32(_mm_movemask_epi8(_mm_loadu_si128(reinterpret_cast<const __m128i*>(p + i * 16))))) << (i * 16);
    return out;
#else
    u64 out = 0;
    for (u32 i = 0; i < 64; ++i)
        out |= u64(p[i] >> 7) << i;
    return out;
#endif
}

// Bit i: a[i] == b[i]; 64 bytes.
inline u64 equal_bytes(const u8* a, const u8* b) {
#if defined(__AVX512BW__)
    return _mm512_cmpeq_epi8_mask(_mm512_loadu_si512(a), _mm512_loadu_si512(b));
#else
    alignas(64) u8 equal[64];
    for (u32 i = 0; i < 64; ++i)
        equal[i] = a[i] == b[i] ? 0xff : 0;
    return high_bits(equal);
#endif
}

#if defined(__AVX512VBMI__)
// A table of 256 bytes in registers.
struct ByteTable {
    __m512i part[4];
    explicit ByteTable(const u8* t) {
        for (u32 i = 0; i < 4; ++i)
            part[i] = _mm512_loadu_si512(t + i * 64);
    }
    __m512i operator()(__m512i index) const {
        const __m512i low = _mm512_permutex2var_epi8(part[0], index, part[1]);
        const __m512i high = _mm512_permutex2var_epi8(part[2], index, part[3]);
        return _mm512_mask_blend_epi8(_mm512_movepi8_mask(index), low, high);
    }
};
#endif

void translate(const u8* __restrict in, u32 palette_size, const u8* __restrict table, u8* __restrict out) {
#if defined(__AVX512BW__)
    if (palette_size <= 16) {
        const __m512i t = _mm512_broadcast_i32x4(_mm_loadu_si128(reinterpret_cast<const __m128i*>(table)));
        for (u32 i = 0; i < 4096; i += 64)
            _mm512_storeu_si512(out + i, _mm512_shuffle_epi8(t, _mm512_loadu_si512(in + i)));
        return;
    }
#if defined(__AVX512VBMI__)
    const ByteTable lookup(table);
    for (u32 i = 0; i < 4096; i += 64)
        _mm512_storeu_si512(out + i, lookup(_mm512_loadu_si512(in + i)));
    return;
#endif
#elif defined(__AVX2__)
    if (palette_size <= 16) {
        const __m256i t = _mm256_broadcastsi128_si256(_mm_loadu_si128(reinterpret_cast<const __m128i*>(table)));
        for (u32 i = 0; i < 4096; i += 32)
            _mm256_storeu_si256(reinterpret_cast<__m256i*>(out + i),
                                _mm256_shuffle_epi8(t, _mm256_loadu_si256(reinterpret_cast<const __m256i*>(in + i))));
        return;
    }
#endif
    (void)palette_size;
    for (u32 i = 0; i < 4096; ++i)
        out[i] = table[in[i]];
}

void classify(const u8* cells, u32 palette_size, const u8* classes, u8 bit, RowMask& out) {
    u64 words[64];
#if defined(__AVX512BW__)
    if (palette_size <= 16) {
        const __m512i t = _mm512_broadcast_i32x4(_mm_loadu_si128(reinterpret_cast<const __m128i*>(classes)));
        const __m512i wanted = _mm512_set1_epi8(char(bit));
        for (u32 i = 0; i < 64; ++i)
            words[i] = _mm512_test_epi8_mask(_mm512_shuffle_epi8(t, _mm512_loadu_si512(cells + i * 64)), wanted);
        std::memcpy(out.data(), words, sizeof words);
        return;
    }
#endif
    alignas(64) u8 table[256] = {};
    for (u32 i = 0; i < palette_size; ++i)
        table[i] = classes[i] & bit ? 0xff : 0;
    alignas(64) u8 marks[4096];
    translate(cells, palette_size, table, marks);
    for (u32 i = 0; i < 64; ++i)
        words[i] = high_bits(marks + i * 64);
    std::memcpy(out.data(), words, sizeof words);
}

// Class bits 0 and 1 of one row of 16 cells.
inline void classify_row(const u64* words, u32 bits, u32 row, const u8* table, u16& first, u16& second) {
    const u8* bytes = reinterpret_cast<const u8*>(words) + row * bits * 2;
#if defined(__SSSE3__)
    if (bits == 4) {
        const __m128i v = _mm_loadl_epi64(reinterpret_cast<const __m128i*>(bytes)), low = _mm_set1_epi8(15);
        const __m128i index = _mm_unpacklo_epi8(_mm_and_si128(v, low), _mm_and_si128(_mm_srli_epi16(v, 4), low));
        const __m128i c = _mm_shuffle_epi8(_mm_loadu_si128(reinterpret_cast<const __m128i*>(table)), index);
        first = u16(_mm_movemask_epi8(_mm_slli_epi16(c, 7)));
        second = u16(_mm_movemask_epi8(_mm_slli_epi16(c, 6)));
        return;
    }
#endif
    u32 a = 0, b = 0;
    const u32 mask = (1u << bits) - 1;
    if (bits == 1) {
        u16 v;
        std::memcpy(&v, bytes, sizeof v);
        const u32 set = v, clear = ~set;
        first = u16((set & (0u - (table[1] & 1u))) | (clear & (0u - (table[0] & 1u))));
        second = u16((set & (0u - (table[1] >> 1 & 1u))) | (clear & (0u - (table[0] >> 1 & 1u))));
        return;
    }
#if defined(__BMI2__)
    if (bits == 2) {
        u32 v;
        std::memcpy(&v, bytes, sizeof v);
        const u32 low = _pext_u32(v, 0x55555555u), high = _pext_u32(v, 0xaaaaaaaau);
        const u32 cells[4] = {~low & ~high, low & ~high, ~low & high, low & high};
        for (u32 p = 0; p < 4; ++p) {
            a |= cells[p] & (0u - (table[p] & 1u));
            b |= cells[p] & (0u - (table[p] >> 1 & 1u));
        }
        first = u16(a);
        second = u16(b);
        return;
    }
#endif
    for (u32 x = 0; x < 16; ++x) {
        const u32 at = x * bits;
        const u32 c = table[u32(bytes[at >> 3]) >> (at & 7) & mask];
        a |= (c & 1) << x;
        b |= (c >> 1 & 1) << x;
    }
    first = u16(a);
    second = u16(b);
}

void classify_rows(const u64* words, u32 bits, const u8* table, u32 first_row, u32 row_step, u32 count, u16* first,
                   u16* second) {
#if defined(__AVX512VBMI__)
    if (bits == 8) {
        const ByteTable lookup(table);
        const u8* bytes = reinterpret_cast<const u8*>(words);
        for (u32 i = 0; i < count; ++i) {
            const void* row = bytes + (first_row + i * row_step) * 16;
            const __m128i c = _mm512_castsi512_si128(
                lookup(_mm512_castsi128_si512(_mm_loadu_si128(static_cast<const __m128i*>(row)))));
            first[i] = u16(_mm_movemask_epi8(_mm_slli_epi16(c, 7)));
            second[i] = u16(_mm_movemask_epi8(_mm_slli_epi16(c, 6)));
        }
        return;
    }
#endif
    for (u32 i = 0; i < count; ++i)
        classify_row(words, bits, first_row + i * row_step, table, first[i], second[i]);
}

void classify_column(const u64* words, u32 bits, const u8* table, u32 x, u32* __restrict first,
                     u32* __restrict second) {
    u32 packed = 0; // bit p: class bit 0 of entry p; bit 16 + p: class bit 1
    if (bits <= 4)
        for (u32 p = 0; p < 1u << bits; ++p)
            packed |= u32(table[p] & 1) << p | u32(table[p] >> 1 & 1) << (16 + p);
    const auto put = [&](auto element, u32 mask) {
        using Element = decltype(element);
        const auto* rows = reinterpret_cast<const u8*>(words);
        const u32 shift = x * bits;
        for (u32 k = 0; k < 256; ++k) {
            Element e;
            std::memcpy(&e, rows + k * sizeof(Element), sizeof(Element));
            const u32 v = packed >> (u32(e >> shift) & mask);
            first[k] = v & 1;
            second[k] = v >> 16 & 1;
        }
    };
    if (bits == 4) return put(u64{}, 15);
    if (bits == 2) return put(u32{}, 3);
    if (bits == 1) return put(u16{}, 1);
    const u8* bytes = reinterpret_cast<const u8*>(words);
    for (u32 k = 0; k < 256; ++k) {
        const u32 c = table[bytes[k * 16 + x]];
        first[k] = c & 1;
        second[k] = c >> 1 & 1;
    }
}

void equal_next(const u8* cells, u32 axis, RowMask& out) {
    u64 words[64]; // four rows each
    const u32 step = axis == 0 ? 1 : axis == 1 ? 256 : 16;
    const u32 count = axis == 1 ? 60 : 63; // the last may not read beyond the cells
    for (u32 i = 0; i < count; ++i)
        words[i] = equal_bytes(cells + i * 64, cells + i * 64 + step);
    alignas(64) u8 tail[128] = {};
    if (axis != 1) {
        std::memcpy(tail, cells + 63 * 64, 64);
        words[63] = equal_bytes(tail, tail + step);
    } else
        for (u32 i = 60; i < 64; ++i)
            words[i] = 0;
    if (axis == 2)
        for (u32 i = 3; i < 64; i += 4)
            words[i] &= 0x0000ffffffffffffull; // z = 15 has no next
    if (axis == 0)
        for (u64& w : words)
            w &= 0x7fff7fff7fff7fffull;
    std::memcpy(out.data(), words, sizeof words);
}

void equal_next_wide(const u16* cells, u32 axis, RowMask& out) {
    const u32 step = axis == 0 ? 1 : axis == 1 ? 256 : 16;
    for (u32 row = 0; row < 256; ++row) {
        const bool last = axis == 1 ? row >= 240 : axis == 2 && (row & 15) == 15;
        u32 bits = 0;
        if (!last)
            for (u32 x = 0; x < (axis == 0 ? 15u : 16u); ++x)
                bits |= u32(cells[row * 16 + x] == cells[row * 16 + x + step]) << x;
        out[row] = u16(bits);
    }
}

// Bit k of row j becomes bit j of row k, for 16 rows of 16 bits.
inline void transpose_16(const u16* in, u16* out) {
#if defined(__AVX512BW__) && defined(__AVX512VL__)
    const __m256i rows = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(in));
    for (u32 k = 0; k < 16; ++k)
        out[k] = u16(_mm256_test_epi16_mask(rows, _mm256_set1_epi16(short(1u << k))));
#elif defined(__SSE2__)
    const __m128i a = _mm_loadu_si128(reinterpret_cast<const __m128i*>(in));
    const __m128i b = _mm_loadu_si128(reinterpret_cast<const __m128i*>(in + 8));
    const __m128i low = _mm_set1_epi16(0xff);
    __m128i lo = _mm_packus_epi16(_mm_and_si128(a, low), _mm_and_si128(b, low));
    __m128i hi = _mm_packus_epi16(_mm_srli_epi16(a, 8), _mm_srli_epi16(b, 8));
    for (u32 k = 8; k-- > 0;) {
        out[k] = u16(_mm_movemask_epi8(lo));
        out[k + 8] = u16(_mm_movemask_epi8(hi));
        lo = _mm_add_epi8(lo, lo);
        hi = _mm_add_epi8(hi, hi);
    }
#else
    for (u32 k = 0; k < 16; ++k) {
        u32 bits = 0;
        for (u32 j = 0; j < 16; ++j)
            bits |= u32(in[j] >> k & 1) << j;
        out[k] = u16(bits);
    }
#endif
}

void transpose_rows(const RowMask& in, RowMask& out) {
    for (u32 y = 0; y < 16; ++y)
        transpose_16(in.data() + y * 16, out.data() + y * 16);
}

void transpose(const PaddedMask& in, PaddedMask& out) {
    for (u32 y = 0; y < 18; ++y) {
        const u32* r = in.rows[y];
        u32* o = out.rows[y];
        alignas(64) u16 core[16], turned[16];
        u32 any = 0, all = ~0u;
        for (u32 i = 0; i < 18; ++i)
            any |= r[i], all &= r[i];
        if (any == 0 || (all & 0x3ffff) == 0x3ffff) { // whole slices of air or rock are common
            for (u32 i = 0; i < 18; ++i)
                o[i] = any ? 0x3ffff : 0;
            continue;
        }
        for (u32 z = 0; z < 16; ++z)
            core[z] = u16(r[z + 1] >> 1);
        transpose_16(core, turned);
        const u32 first = r[0] >> 1, last = r[17] >> 1;
        for (u32 x = 0; x < 16; ++x)
            o[x + 1] = u32(turned[x]) << 1 | (first >> x & 1) | (last >> x & 1) << 17;
        u32 west = 0, east = 0;
        for (u32 z = 0; z < 18; ++z) {
            west |= (r[z] & 1) << z;
            east |= (r[z] >> 17 & 1) << z;
        }
        o[0] = west;
        o[17] = east;
    }
}

u32 exposed(const PaddedMask& cells, const PaddedMask& blockers) {
    u32 w = 0, e = 0, d = 0, u = 0, n = 0, s = 0;
    for (u32 y = 1; y < 17; ++y)
        for (u32 z = 1; z < 17; ++z) {
            const u32 c = cells.rows[y][z] & 0x1fffe, b = blockers.rows[y][z];
            w |= c & ~(b << 1);
            e |= c & ~(b >> 1);
            d |= c & ~blockers.rows[y - 1][z];
            u |= c & ~blockers.rows[y + 1][z];
            n |= c & ~blockers.rows[y][z - 1];
            s |= c & ~blockers.rows[y][z + 1];
        }
    return u32(w != 0) | u32(e != 0) << 1 | u32(d != 0) << 2 | u32(u != 0) << 3 | u32(n != 0) << 4 | u32(s != 0) << 5;
}

// One bit plane of the occlusion count (0..3) of a corner: sides a and b, corner c.
struct Count {
    u32 one, two;
};
inline Count count_of(u32 a, u32 b, u32 c) {
    const u32 both = a & b, either = a ^ b;
    return {both | (either ^ c), both | (either & c)};
}

struct FaceRows {
    alignas(64) u32 faces[256 + 16]; // cells that draw a face
    alignas(64) u32 along_u[256];    // may join the next along u
    alignas(64) u32 along_v[256];    // may join the next along v
};

// by_y: the face's normal runs along y and v along the second index; else the normal runs along the second index, v
// along y.
template <bool by_y, bool occlusion>
inline void find_faces(const DirectionJob& job, FaceRows& out) {
    const i32 step = job.face & 1 ? 1 : -1;
    alignas(64) u32 level_v[256 + 16]; // faces whose occlusion does not change along v
    // Rows are copied to arrays of this function first: the compiler then knows that nothing overlaps.
    using Row = u32[16];
    const auto copy = [](Row& to, const u32* from) { std::memcpy(to, from, sizeof(Row)); };
    for (u32 i = 0; i < 16; ++i) {
        alignas(64) Row c, b, equal, faces, along, level;
        copy(c, &job.cells->rows[i + 1][1]);
        copy(b, by_y ? &job.blockers->rows[i32(i) + 1 + step][1] : &job.blockers->rows[i + 1][1 + step]);
        if (job.equal_u) {
            u16 bits[16];
            std::memcpy(bits, job.equal_u->data() + i * 16, sizeof bits);
            for (u32 j = 0; j < 16; ++j)
                equal[j] = bits[j];
        } else
            std::memset(equal, 0xff, sizeof equal);
        if constexpr (occlusion) {
            alignas(64) Row lo, mid, hi;
            const i32 front = i32(i) + 1 + step;
            copy(lo, by_y ? &job.occluders->rows[front][0] : &job.occluders->rows[i][1 + step]);
            copy(mid, by_y ? &job.occluders->rows[front][1] : &job.occluders->rows[i + 1][1 + step]);
            copy(hi, by_y ? &job.occluders->rows[front][2] : &job.occluders->rows[i + 2][1 + step]);
            for (u32 j = 0; j < 16; ++j) {
                const u32 f = (c[j] & ~b[j]) >> 1 & 0xffff;
                const Count k00 = count_of(mid[j], lo[j] >> 1, lo[j]);
                const Count k10 = count_of(mid[j] >> 2, lo[j] >> 1, lo[j] >> 2);
                const Count k01 = count_of(mid[j], hi[j] >> 1, hi[j]);
                const Count k11 = count_of(mid[j] >> 2, hi[j] >> 1, hi[j] >> 2);
                const u32 bent_u =
                    (k00.one ^ k10.one) | (k00.two ^ k10.two) | (k01.one ^ k11.one) | (k01.two ^ k11.two);
                const u32 bent_v =
                    (k00.one ^ k01.one) | (k00.two ^ k01.two) | (k10.one ^ k11.one) | (k10.two ^ k11.two);
                // Two faces beside each other count the same cells at the corners they share, and so equal levels
                // within each make them equal - but not behind leaves, which occlude and yet hide no face: those stay
                // single.
                const u32 free = f & ~(mid[j] >> 1);
                const u32 level_u = free & ~bent_u;
                faces[j] = f;
                along[j] = level_u & level_u >> 1 & equal[j];
                level[j] = free & ~bent_v;
            }
        } else {
            for (u32 j = 0; j < 16; ++j) {
                const u32 f = (c[j] & ~b[j]) >> 1 & 0xffff;
                faces[j] = f;
                along[j] = f & f >> 1 & equal[j];
                level[j] = f;
            }
        }
        std::memcpy(out.faces + i * 16, faces, sizeof faces);
        std::memcpy(out.along_u + i * 16, along, sizeof along);
        std::memcpy(level_v + i * 16, level, sizeof level);
    }
    std::memset(level_v + 256, 0, 64);
    constexpr u32 stride = by_y ? 1 : 16;
    if (job.equal_v) {
        alignas(64) RowMask equal = *job.equal_v;
        for (u32 k = 0; k < 256; ++k)
            out.along_v[k] = level_v[k] & level_v[k + stride] & equal[k];
    } else {
        for (u32 k = 0; k < 256; ++k)
            out.along_v[k] = level_v[k] & level_v[k + stride];
        for (u32 k = 0; by_y && k < 256; k += 16)
            out.along_v[k + 15] = 0;
    }
}

template <bool by_y, bool turned, bool occlusion, class Cell>
u64* emit_faces(const DirectionJob& job, FaceRows& rows, const Cell* cells, u64* out) {
    constexpr u32 stride = by_y ? 1 : 16;
    const u32 step = job.face & 1 ? 1 : u32(-1);
    const u64* looks = job.looks;
    const auto row = [&](u32 k) {
        u32 f = rows.faces[k];
        const u32 joins = rows.along_u[k];
        const u32 y = k >> 4, j = k & 15;
        const u32* mid = nullptr;
        const u32* lo = nullptr;
        const u32* hi = nullptr;
        if constexpr (occlusion) {
            if constexpr (by_y) {
                mid = &job.occluders->rows[y + 1 + step][j + 1];
                lo = mid - 1, hi = mid + 1;
            } else {
                mid = &job.occluders->rows[y + 1][j + 1 + step];
                lo = mid - 18, hi = mid + 18;
            }
        }
        while (f) {
            const u32 b = u32(std::countr_zero(f));
            const u32 w = u32(std::countr_zero(~((joins & f >> 1) >> b))); // w - 1
            const u32 mask = ((2u << w) - 1) << b;
            f &= ~mask;
            u32 h = 0; // h - 1
            for (u32 at = k; (rows.along_v[at] & mask) == mask; ++h) {
                at += stride;
                rows.faces[at] &= ~mask;
            }
            const u32 cell = turned ? j | b << 4 | y << 8 : k << 4 | b;
            const u64 look = cells ? looks[cells[cell]] : looks[0];
            u64 ao = 0xff;
            if constexpr (occlusion) ao = kOcclusionTable[(*lo >> b & 7) | (*mid >> b & 7) << 3 | (*hi >> b & 7) << 6];
            const u64 position = turned ? u64(j | y << 4 | b << 8) : u64(b | y << 4 | j << 8);
            *out++ = look | position | u64(w) << 12 | u64(h) << 16 | ao << 24;
        }
    };
#if defined(__AVX512F__)
    for (u32 base = 0; base < 256; base += 16) {
        u32 some = _mm512_test_epi32_mask(_mm512_load_si512(rows.faces + base), _mm512_load_si512(rows.faces + base));
        for (; some; some &= some - 1)
            row(base + u32(std::countr_zero(some)));
    }
#else
    for (u32 k = 0; k < 256; ++k)
        if (rows.faces[k]) row(k);
#endif
    return out;
}

template <bool by_y, bool turned, bool occlusion>
u64* mesh_one(const DirectionJob& job, u64* out) {
    FaceRows rows;
    find_faces<by_y, occlusion>(job, rows);
    if (job.wide) return emit_faces<by_y, turned, occlusion, u16>(job, rows, job.wide, out);
    return emit_faces<by_y, turned, occlusion, u8>(job, rows, job.narrow, out);
}

u64* mesh_direction(const DirectionJob& job, u64* out) {
    const bool by_y = job.face >> 1 == 1, turned = job.face < 2;
    if (job.occluders) {
        if (by_y) return mesh_one<true, false, true>(job, out);
        return turned ? mesh_one<false, true, true>(job, out) : mesh_one<false, false, true>(job, out);
    }
    if (by_y) return mesh_one<true, false, false>(job, out);
    return turned ? mesh_one<false, true, false>(job, out) : mesh_one<false, false, false>(job, out);
}

#include "render/meshing/light_kernels.inl"

} // namespace

#define VX_MESH_TABLE(NAME)                                                                                            \
    {                                                                                                                  \
        NAME, expand, classify, classify_rows, classify_column, equal_next, equal_next_wide, translate, transpose,     \
            transpose_rows, exposed, mesh_direction, split_light_row, fill_light_row, join_light_row                   \
    }

} // namespace vitrail::render
