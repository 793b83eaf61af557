#include "trace/grid/chunk_masks.h"

namespace vitrail::trace {

u8 state_class(const StateRecord& state, u32 water, u32 top) {
    u8 c = 0;
    if (state.kind != CellKind::empty) c |= kStopsAir;
    if (state.kind == CellKind::cube) c |= kOpaque;
    if (water != 0 && state.medium == water && state.kind != CellKind::empty) {
        c |= kHoldsWater;
        if (((u32(state.liquid_height) + 1 + 2) & ~3u) != top) c |= kOddWater;
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
    u32 any = 0;
    for (std::size_t i = 0; i < blocks.palette().size(); ++i)
        any |= class_of[i];
    CellMask cells[kStateClasses]{};
    classify_cells(blocks, class_of, any & kHoldsWater ? kStateClasses : 2, cells);
    out.stops = bricks_of(cells[0]);
    out.opaque = bricks_of(cells[1]);
    out.water = {cells[2], cells[3], cells[4]};
}

} // namespace vitrail::trace
