// Where rays inside water have nothing to look at: cells full of water, and cells with a flat surface, which lies in
// one known plane. Kept up to date where water comes and goes, at borders of chunks too.
//
// A cell is full where there is water above it. It is level where it is a liquid with air or land above whose surface
// is flat and at the height of a source: so it is where no cell of the nine around it that holds water is full or of
// another height (scene/liquid_surface.h). Both are calm.
#pragma once

#include "jobs/thread_pool.h"
#include "trace/grid/chunk_masks.h"
#include "voxel/coords.h"

#include <memory>
#include <unordered_map>
#include <vector>

namespace vitrail::trace {

struct CalmMasks {
    BrickMasks stops; // cells that are not calm
    u32 layers = 0;   // GridChunk::layers
};

// What a chunk's neighbors have to know of it: cells at its sides, a layer each, that bend surfaces beside them.
struct WaterSides {
    LayerMask west{}, east{};   // bit z
    LayerMask north{}, south{}; // bit x
    friend bool operator==(const WaterSides&, const WaterSides&) = default;
};

WaterSides water_sides(const WaterCells& cells, const WaterCells& above);
// around: sides of the chunks around it, x then z; the middle one, its own, is not looked at.
CalmMasks calm_masks(const WaterCells& cells, const WaterCells& above, const WaterSides* const (&around)[9]);

class CalmWater {
public:
    void clear();
    // What a chunk holds now; without any water it is as if it were not there.
    void put(ChunkPos at, const WaterCells& cells);
    void remove(ChunkPos at);

    struct Made {
        ChunkPos at;
        CalmMasks masks;
    };
    // Chunks with water whose masks may have changed since the last call; what is put without water has none.
    std::vector<Made> refresh(ThreadPool* pool);

    bool pending() const { return !changed_.empty() || !beside_.empty(); } // refresh has something to do

    u64 bytes() const;

private:
    struct Water {
        std::unique_ptr<WaterCells> cells; // null: full of sources
        WaterSides sides;
    };
    const WaterCells& cells_at(ChunkPos at) const;
    static const WaterCells& cells_of(const Water& water);

    std::unordered_map<ChunkPos, Water> water_;
    std::vector<ChunkPos> changed_; // what they hold, or what is above them
    std::vector<ChunkPos> beside_;  // what is at their sides
};

} // namespace vitrail::trace
