// For tests of shapes: a row with every name filled in, one placement built from it, and its voxels by the kernels that
// draw features. Blocks: kFirstPart + i stands for the row's part i.
#pragma once

#include "terrain/compile/names.h"
#include "terrain/compile/noise_tables.h"
#include "terrain/compile/shape_info.h"
#include "terrain/kernel/draw_kernel.h"
#include "terrain/kernel/shapes/builder.h"

#include <memory>
#include <vector>

namespace vitrail::shape_voxels {

inline constexpr Block kFirstPart = 10;

// A shape's row with its default numbers and the table's bounds.
inline FeatureRow row_of(Shape shape) {
    const ShapeInfo& info = shape_infos()[u32(shape)];
    FeatureRow row;
    row.shape = shape;
    row.bound_low = info.bound_low;
    row.bound_high = info.bound_high;
    row.reach = info.reach;
    row.key = {0x1234567u + u32(shape), 0x89abcdefu};
    for (u32 i = 0; i < kFeatureNumbers; ++i)
        row.numbers[i] = info.numbers[i].fallback;
    for (u32 i = 0; i < kFeatureBlocks; ++i)
        row.blocks[i] = Block(kFirstPart + i);
    return row;
}

struct Built {
    std::unique_ptr<TerrainTables> tables = std::make_unique<TerrainTables>();
    std::unique_ptr<FeatureTile> tile = std::make_unique<FeatureTile>();
    Placement placement;
    bool fits = false;

    Built() {
        tables->seed = 7;
        TableBuilder noises(*tables);
        tables->shape_noise[0] = noises.add_noise(NoiseKind::simplex3, 0.13, 3, purpose_of("shape fine")).value();
        tables->shape_noise[1] = noises.add_noise(NoiseKind::simplex3, 0.035, 3, purpose_of("shape coarse")).value();
    }
    // build: the shape's builder
    template <class Build>
    void make(const FeatureRow& row, u32 bits, const Build& build, i32 x = 0, i32 y = 0, i32 z = 0, i32 room = 40) {
        tables->feature[0] = row;
        *tile = FeatureTile{};
        placement = Placement{};
        placement.x = x;
        placement.y = i16(y);
        placement.z = z;
        placement.bits = bits;
        placement.room = i16(room);
        ShapeBuilder<ScalarLanes> b{*tables, tables->feature[0], placement, *tile};
        build(b);
        fits = b.fits;
    }
};

// Voxels in a box around the placement; 0 where there is none.
struct Voxels {
    i32 low[3] = {}, size[3] = {};
    std::vector<Block> block;
    Block& at(i32 x, i32 y, i32 z) {
        return block[(size_t(y - low[1]) * size_t(size[2]) + size_t(z - low[2])) * size_t(size[0]) +
                     size_t(x - low[0])];
    }
    bool has(i32 x, i32 y, i32 z) const {
        return x >= low[0] && y >= low[1] && z >= low[2] && x < low[0] + size[0] && y < low[1] + size[1] &&
               z < low[2] + size[2];
    }
    Block get(i32 x, i32 y, i32 z) const { return has(x, y, z) ? const_cast<Voxels*>(this)->at(x, y, z) : Block(kAir); }
};

// Everything drawn into open air; the first solid that takes a voxel keeps it.
inline Voxels draw(const Built& f) {
    const Placement& p = f.placement;
    Voxels v;
    for (int i = 0; i < 3; ++i) {
        v.low[i] = p.low[i];
        v.size[i] = p.high[i] - p.low[i] + 1;
    }
    v.block.assign(size_t(v.size[0]) * size_t(v.size[1]) * size_t(v.size[2]), kAir);
    for (u32 n = 0; n < f.tile->primitives; ++n) {
        const Primitive& s = f.tile->primitive[n];
        const SolidFrame frame = solid_frame(s);
        for (i32 z = s.low[2]; z <= s.high[2]; ++z)
            for (i32 x = s.low[0]; x <= s.high[0]; ++x) {
                const i32 ax = i32(u32(p.x) + u32(x)), az = i32(u32(p.z) + u32(z));
                const ColumnPos column{ax >> 4, az >> 4};
                const Row<ScalarLanes> row = thread_row(column, (ax & 15) | (az & 15) << 4);
                DrawSpan span = draw_span(p, s.low, s.high, column);
                span.y = p.y;
                for (i32 y = s.low[1]; y <= s.high[1]; ++y) {
                    if (v.at(x, y, z) != kAir) continue;
                    u32 block = 0;
                    if (draw_row<ScalarLanes>(*f.tables, s, frame, span, f.tables->feature[0].key, row, p.y + y,
                                              room_open | room_water, block))
                        v.at(x, y, z) = Block(block);
                }
            }
    }
    return v;
}

} // namespace vitrail::shape_voxels
