// Included by mesh_kernels.inl: rows of light for light_brick.cpp. A cell is two bytes, `even` with sky and green,
// `odd` with red and blue, a nibble each; 255 in both marks a cell without light of its own.

// 32 cells; bit i of `closed` marks cell i.
void split_light_row(const u16* row, u32 closed, u16* even, u16* odd) {
    alignas(64) u16 v[32];
    std::memcpy(v, row, sizeof v);
    for (u32 i = 0; i < 32; ++i) {
        const u16 mark = closed >> i & 1 ? 0xffff : 0;
        even[i] = u16((v[i] & 0x0f0f) | mark);
        odd[i] = u16((v[i] >> 4 & 0x0f0f) | mark);
    }
}

// Light for the cells of a row marked in `wanted` from their six neighbors (see build_light_brick); others are copied.
// Steps are in bytes; two bytes before and behind the row are read.
void fill_light_row(const u8* row, u32 step_z, u32 step_y, u32 wanted, u8* out) {
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
}

// 18 cells; those without light become 0.
void join_light_row(const u16* even, const u16* odd, u16* out) {
    alignas(64) u16 joined[18];
    for (u32 i = 0; i < 18; ++i)
        joined[i] = even[i] == 0xffff ? u16(0) : u16(even[i] | odd[i] << 4);
    std::memcpy(out, joined, sizeof joined);
}
