#include "rules/collision.h"

#include <algorithm>

namespace vitrail {

namespace {

constexpr i64 kUnit = kFixedOne / kShapeUnit;

// Chunks of one query, looked up once each while cells run on.
class CellReader {
public:
    explicit CellReader(const Dimension& dimension)
        : dimension_(dimension) {}

    CellKind kind_of(BlockPos at) {
        if (!in_world(at)) return CellKind::unknown;
        if (at.y < dimension_.info().min_y || at.y >= dimension_.info().max_y) return CellKind::open;
        select(chunk_of(at));
        return kind_;
    }
    StateId state_at(BlockPos at) const { return chunk_->blocks.get(local_of(at)); } // after kind_of said loaded

private:
    void select(ChunkPos at) {
        if (known_ && at == at_) return;
        known_ = true;
        at_ = at;
        chunk_ = dimension_.find(at);
        if (chunk_) {
            kind_ = CellKind::loaded;
            return;
        }
        kind_ = CellKind::unknown;
        const ColumnHeights* heights = dimension_.heights(column_of(at));
        if (!heights) return;
        const i32 highest = *std::max_element(heights->above.begin(), heights->above.end());
        if (at.y * kChunkSize >= highest) kind_ = CellKind::open;
    }

    const Dimension& dimension_;
    bool known_ = false;
    ChunkPos at_;
    ChunkPtr chunk_;
    CellKind kind_ = CellKind::unknown;
};

i32 cell_below(i64 v) {
    return i32(v >> 32);
}

} // namespace

FixedBox body_box(WorldPos feet, i64 height) {
    return {{feet.x - kBodyHalfWidth, feet.y, feet.z - kBodyHalfWidth},
            {feet.x + kBodyHalfWidth, feet.y + height, feet.z + kBodyHalfWidth}};
}

FixedBox box_of(const ShapeBox& box, BlockPos block) {
    const WorldPos corner = corner_of(block);
    const i64 c[3] = {corner.x, corner.y, corner.z};
    FixedBox out;
    for (int a = 0; a < 3; ++a) {
        out.min[a] = c[a] + box.min[a] * kUnit;
        out.max[a] = c[a] + box.max[a] * kUnit;
    }
    return out;
}

CellKind cell_kind(const Dimension& dimension, BlockPos at) {
    return CellReader(dimension).kind_of(at);
}

void gather_boxes(const Dimension& dimension, const FixedBox& region, std::vector<FixedBox>& out) {
    CellReader reader(dimension);
    const StateTable& states = dimension.states();
    const auto touches = [&](const FixedBox& b) {
        for (int a = 0; a < 3; ++a)
            if (b.max[a] < region.min[a] || b.min[a] > region.max[a]) return false;
        return true;
    };
    // One cell more below: fences reach half a block into the next cell.
    for (i32 y = cell_below(region.min[1] - 1) - 1; y <= cell_below(region.max[1]); ++y)
        for (i32 z = cell_below(region.min[2] - 1); z <= cell_below(region.max[2]); ++z)
            for (i32 x = cell_below(region.min[0] - 1); x <= cell_below(region.max[0]); ++x) {
                const BlockPos at{x, y, z};
                const CellKind kind = reader.kind_of(at);
                if (kind == CellKind::open) continue;
                if (kind == CellKind::unknown) {
                    const FixedBox cube = box_of({}, at);
                    if (touches(cube)) out.push_back(cube);
                    continue;
                }
                const StateId id = reader.state_at(at);
                if (!(states.flags(id) & kSolid)) continue;
                for (const ShapeBox& box : states.info(id).shape.collision) {
                    const FixedBox b = box_of(box, at);
                    if (touches(b)) out.push_back(b);
                }
            }
}

i64 sweep(const FixedBox& body, int axis, i64 by, const std::vector<FixedBox>& boxes) {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    for (const FixedBox& b : boxes) {
        if (b.min[u] >= body.max[u] || b.max[u] <= body.min[u] || b.min[v] >= body.max[v] || b.max[v] <= body.min[v])
            continue;
        if (by > 0 && b.min[axis] >= body.max[axis]) by = std::min(by, b.min[axis] - body.max[axis]);
        if (by < 0 && b.max[axis] <= body.min[axis]) by = std::max(by, b.max[axis] - body.min[axis]);
    }
    return by;
}

bool any_overlap(const FixedBox& body, const std::vector<FixedBox>& boxes) {
    return std::any_of(boxes.begin(), boxes.end(), [&](const FixedBox& b) { return b.overlaps(body); });
}

bool body_fits(const Dimension& dimension, WorldPos feet, i64 height) {
    const FixedBox body = body_box(feet, height);
    std::vector<FixedBox> boxes;
    gather_boxes(dimension, body, boxes);
    return !any_overlap(body, boxes);
}

} // namespace vitrail
