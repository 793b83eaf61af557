#include "trace/grid/chunk_masks.h"

namespace vitrail::trace {

u8 state_class(const StateRecord& state, u32 water) {
    u8 c = 0;
    if (state.kind != CellKind::empty) c |= kStopsAir;
    if (state.kind == CellKind::cube) c |= kOpaque;
    if (water != 0 && state.medium == water && state.kind != CellKind::empty) {
        c |= kHoldsWater;
        if (state.kind == CellKind::liquid) c |= kWaterCell;
    }
    return c;
}

BrickMasks bricks_of(const CellMask& cells) {
    BrickMasks out{};
    for (u32 y = 0; y < 16; ++y)
        for (u32 bz = 0; bz < 4; ++bz) {
            const u64 rows = cells[y * 4 + bz]; // four rows of x
            if (rows == 0) continue;
            for (u32 bx = 0; bx < 4; ++bx) {
                // The rows' four-bit pieces, brought together.
                const u64 v = rows >> (4 * bx) & 0x000F000F000F000Full;
                const u64 layer = (v | v >> 12 | v >> 24 | v >> 36) & 0xFFFF;
                out[bx | bz << 2 | (y >> 2) << 4] |= layer << 16 * (y & 3);
            }
        }
    return out;
}

void make_chunk_masks(const BlockStorage& blocks, const u8* class_of, ChunkMasks& out) {
    CellMask cells[4];
    classify_cells(blocks, class_of, 4, cells);
    const CellMask &air = cells[0], &opaque = cells[1], &liquid = cells[2], &water = cells[3];
    out.stops[0] = bricks_of(air);
    out.opaque = bricks_of(opaque);
    CellMask through;
    for (u32 i = 0; i < 64; ++i)
        through[i] = ~(liquid[i] & (i < 60 ? water[i + 4] : 0));
    out.stops[1] = bricks_of(through);
    for (u32 z = 0; z < 16; ++z) {
        out.water_floor[z] = u16(water[z >> 2] >> 16 * (z & 3));
        out.water_ceiling[z] = u16(liquid[60 + (z >> 2)] >> 16 * (z & 3));
    }
}

void apply_water_above(BrickMasks& stops_water, const LayerMask& ceiling, const LayerMask& floor_above) {
    for (u32 bz = 0; bz < 4; ++bz)
        for (u32 bx = 0; bx < 4; ++bx) {
            u64 layer = 0;
            for (u32 z = 0; z < 4; ++z)
                layer |= u64((ceiling[bz * 4 + z] & floor_above[bz * 4 + z]) >> (4 * bx) & 15) << 4 * z;
            u64& word = stops_water[bx | bz << 2 | 3 << 4];
            word |= 0xFFFFull << 48;
            word &= ~(layer << 48);
        }
}

} // namespace vitrail::trace
