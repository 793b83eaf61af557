// The features of the columns around, drawn into the blocks of one; included by stages_impl.h.
#pragma once

#include "terrain/kernel/draw_kernel.h"

namespace vitrail {

namespace draw_detail {

// What each voxel still offers (VoxelRoom), found out level by level as features reach it.
struct DrawRoom {
    u64 known[kTerrainHeight / 64] = {};
    alignas(64) u8 room[kTerrainHeight * kColumnCells];
};

template <class L>
u8* room_of_level(DrawRoom& room, const BlockTile& blocks, i32 y) {
    u8* level = room.room + y * kColumnCells;
    u64& word = room.known[y >> 6];
    const u64 bit = u64(1) << (y & 63);
    if ((word & bit) == 0) {
        word |= bit;
        const Block* from = blocks.block + y * kColumnCells;
        for (i32 i = 0; i < kColumnCells; i += L::kWidth)
            L::store_bytes(level + i, voxel_room<L>(L::load_bytes(from + i)));
    }
    return level;
}

template <class L>
void draw_primitive(const TerrainTables& t, ColumnPos at, const Primitive& s, const DrawSpan& span, RandomKey key,
                    DrawRoom& room, BlockTile& blocks) {
    using U = typename L::U;
    const SolidFrame frame = solid_frame(s);
    for (i32 y = span.first_y; y <= span.last_y; ++y) {
        u8* level = room_of_level<L>(room, blocks, y);
        Block* out = blocks.block + y * kColumnCells;
        bool drawn = false;
        for (i32 z = span.first_z; z <= span.last_z; ++z) {
            const Row<L> row = wide_row<L>(at, z);
            const U left = L::load_bytes(level + row.index);
            U block;
            const typename L::M in = draw_row<L>(t, s, frame, span, key, row, y, left, block);
            if (!L::any(in)) continue;
            L::store_bytes(level + row.index, select(in, L::u(room_none), left));
            L::store_bytes(out + row.index, select(in, block, L::load_bytes(out + row.index)));
            drawn = true;
        }
        if (drawn && y >= blocks.top) blocks.top = y + 1;
    }
}

} // namespace draw_detail

// features: of the 7 x 7 columns around, row by row (-z first, then -x).
template <class L>
void draw_stage(const TerrainTables& t, ColumnPos at, const FeatureTile* const features[49], BlockTile& blocks) {
    using namespace draw_detail;
    DrawRoom room;
    for (i32 i = 0; i < 49; ++i) {
        const FeatureTile& tile = *features[i];
        for (u32 p = 0; p < tile.placements; ++p) {
            const Placement& place = tile.placement[p];
            if (draw_span(place, place.low, place.high, at).empty()) continue;
            const RandomKey key = t.feature[place.feature].key;
            for (u32 k = place.first; k < u32(place.first) + place.count; ++k) {
                const Primitive& s = tile.primitive[k];
                const DrawSpan span = draw_span(place, s.low, s.high, at);
                if (!span.empty()) draw_primitive<L>(t, at, s, span, key, room, blocks);
            }
        }
    }
}

} // namespace vitrail
