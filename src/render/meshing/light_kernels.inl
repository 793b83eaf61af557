// Included by mesh_kernels.inl: rows of light for light_brick.cpp. A cell is two bytes, `even` with sky and green,
// `odd` with red and blue, a nibble each; 255 in both marks a cell without light of its own.

// 32 cells; bit i of `closed` marks cell i.
void split_light_row(const u16* row, u32 closed, u16* even, u16* odd) {
#if defined(__AVX512BW__)
    const __m512i v512 = _mm512_loadu_si512(row), low = _mm512_set1_epi16(0x0f0f), all = _mm512_set1_epi8(-1);
    _mm512_storeu_si512(even, _mm512_mask_mov_epi16(_mm512_and_si512(v512, low), closed, all));
    _mm512_storeu_si512(odd, _mm512_mask_mov_epi16(_mm512_and_si512(_mm512_srli_epi16(v512, 4), low), closed, all));
#else
    alignas(64) u16 v[32];
    std::memcpy(v, row, sizeof v);
    for (u32 i = 0; i < 32; ++i) {
        const u16 mark = closed >> i & 1 ? 0xffff : 0;
        even[i] = u16((v[i] & 0x0f0f) | mark);
        odd[i] = u16((v[i] >> 4 & 0x0f0f) | mark);
    }
#endif
}

// Light for the cells of a row marked in `wanted` from their six neighbors (see build_light_brick); others are copied.
// Steps are in bytes; two bytes before and behind the row are read.
void fill_light_row(const u8* row, u32 step_z, u32 step_y, u32 wanted, u8* out) {
#if defined(__AVX512VBMI__) && defined(__BMI2__)
    const auto load = [](const u8* p) { return _mm512_loadu_si512(p); };
    const __m512i none = _mm512_set1_epi8(-1);
    const __m512i x = _mm512_min_epu8(load(row - 2), load(row + 2));
    const __m512i z = _mm512_min_epu8(load(row - step_z), load(row + step_z));
    const __m512i y = _mm512_min_epu8(load(row - step_y), load(row + step_y));
    const __mmask64 cx = _mm512_cmpeq_epi8_mask(x, none), cy = _mm512_cmpeq_epi8_mask(y, none);
    const __mmask64 cz = _mm512_cmpeq_epi8_mask(z, none);
    const __m512i sum = _mm512_add_epi8(_mm512_add_epi8(_mm512_maskz_mov_epi8(~cx, x), _mm512_maskz_mov_epi8(~cy, y)),
                                        _mm512_maskz_mov_epi8(~cz, z));
    alignas(64) static constexpr std::array<u8, 64> kThird = [] {
        std::array<u8, 64> t{};
        for (u32 i = 0; i < 64; ++i)
            t[i] = u8((i + 1) / 3);
        return t;
    }();
    __m512i mean = _mm512_permutexvar_epi8(sum, _mm512_load_si512(kThird.data()));
    mean = _mm512_mask_mov_epi8(mean, cx | cy | cz, _mm512_avg_epu8(sum, _mm512_setzero_si512()));
    mean = _mm512_mask_mov_epi8(mean, (cx & cy) | (cx & cz) | (cy & cz), sum);
    _mm512_storeu_si512(out, _mm512_mask_mov_epi8(load(row), _pdep_u64(wanted, 0x5555555555555555ull) * 3, mean));
#else
    alignas(64) u8 here[64], west[64], east[64], north[64], south[64], down[64], up[64], result[64];
    std::memcpy(here, row, 64);
    std::memcpy(west, row - 2, 64);
    std::memcpy(east, row + 2, 64);
    std::memcpy(north, row - step_z, 64);
    std::memcpy(south, row + step_z, 64);
    std::memcpy(down, row - step_y, 64);
    std::memcpy(up, row + step_y, 64);
    alignas(64) u16 mask[32];
    for (u32 i = 0; i < 32; ++i)
        mask[i] = wanted >> i & 1 ? 0xffff : 0;
    alignas(64) u8 select[64];
    std::memcpy(select, mask, 64);
    for (u32 i = 0; i < 64; ++i) {
        // The darker of two open sides; a closed one is 255 and so never chosen over an open one.
        const u8 x = west[i] < east[i] ? west[i] : east[i], z = north[i] < south[i] ? north[i] : south[i];
        const u8 y = down[i] < up[i] ? down[i] : up[i];
        const u8 sum = u8((x == 255 ? 0 : x) + (y == 255 ? 0 : y) + (z == 255 ? 0 : z));
        const u8 closed = u8(u8(x == 255) + u8(y == 255) + u8(z == 255));
        const u8 third = u8(u16((sum + 1) * 171) >> 9), half = u8((sum + 1) >> 1);
        const u8 mean = closed == 0 ? third : closed == 1 ? half : sum;
        result[i] = u8((mean & select[i]) | (here[i] & ~select[i]));
    }
    std::memcpy(out, result, 64);
#endif
}

// 18 cells; those without light become 0.
void join_light_row(const u16* even, const u16* odd, u16* out) {
#if defined(__AVX512BW__)
    constexpr __mmask32 k18 = (1u << 18) - 1;
    const __m512i e = _mm512_maskz_loadu_epi16(k18, even), o = _mm512_maskz_loadu_epi16(k18, odd);
    const __mmask32 has = _mm512_cmpneq_epi16_mask(e, _mm512_set1_epi16(-1));
    _mm512_mask_storeu_epi16(out, k18,
                             _mm512_maskz_or_epi32(0xffff, _mm512_maskz_mov_epi16(has, e),
                                                   _mm512_maskz_mov_epi16(has, _mm512_slli_epi16(o, 4))));
#else
    alignas(64) u16 joined[18];
    for (u32 i = 0; i < 18; ++i)
        joined[i] = even[i] == 0xffff ? u16(0) : u16(even[i] | odd[i] << 4);
    std::memcpy(out, joined, sizeof joined);
#endif
}
