// The largest empty cubes of bricks, for each brick and each octant of directions (trace/kernel/grid_view.h, skips):
// with them a ray through air crosses open land in a few steps. Kept up to date where bricks fill or become empty.
//
// A cube's side follows from its neighbors ahead: 1 + the least of the seven. So a change reaches back kSkipMost - 1
// bricks at most, and only values there are computed anew.
#pragma once

#include "jobs/thread_pool.h"
#include "trace/grid/pool.h"
#include "trace/kernel/grid_view.h"
#include "voxel/coords.h"

namespace vitrail::trace {

// In bricks of the world: least <= b < most.
struct BrickBox {
    IVec3 least, most;
};

class BrickSkips {
public:
    void reset(u32 bits_x, u32 bits_y, u32 bits_z); // log2 of the window in chunks; everything is to be computed
    // Bricks in this box may have filled or become empty, or their slots mean other chunks now.
    void change(const BrickBox& box);
    // A chunk's masks may lie elsewhere.
    void touch(ChunkPos chunk);
    // g: the grid as it is now.
    void refresh(const GridView& g, ThreadPool* pool);

    const u32* data() const { return words_.data(); }
    u64 size() const { return words_.size(); }
    u64 bytes() const { return words_.capacity() * sizeof(u32); }
    DirtyRanges dirty;

private:
    void point_to_masks(const GridView& g, IVec3 chunk);
    void solve(const GridView& g, u32 octant, const BrickBox& box, const BrickBox& write, bool ahead_known);

    void solve_in_layers(const GridView& g, const BrickBox& changed, ThreadPool* pool);

    std::vector<u32> words_;
    std::vector<BrickBox> changed_;
    std::vector<ChunkPos> touched_;
    bool all_ = true;
};

} // namespace vitrail::trace
