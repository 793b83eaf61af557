// The benchmarks' land (bench/sample_land.h) as chunks to mesh.
#pragma once

#include "bench/sample_land.h"
#include "meshing/mesh_world.h"

#include <memory>
#include <vector>

namespace vitrail::bench {

// Sizes in chunks; solid from y = 0 up.
class SampleTerrain {
public:
    static constexpr i32 kX = SampleLand::kX, kY = SampleLand::kY, kZ = SampleLand::kZ;

    SampleTerrain()
        : chunks_(std::size_t(kX * kY * kZ)) {
        const StateId states[SampleLand::kinds] = {StateId::air,
                                                   world("stone"),
                                                   world("dirt"),
                                                   world("grass_block"),
                                                   world("sand"),
                                                   world("coal_ore"),
                                                   world("oak_log[axis=y]"),
                                                   world("oak_leaves[distance=1]")};
        const SampleLand land;
        std::vector<StateId> cells(kChunkVolume);
        for (std::size_t c = 0; c < chunks_.size(); ++c) {
            for (std::size_t i = 0; i < cells.size(); ++i) {
                cells[i] = states[land.chunk(c)[i]];
                solid_ += cells[i] != StateId::air;
            }
            chunks_[c] = std::make_unique<Chunk>();
            chunks_[c]->blocks = BlockStorage::from_states(std::span<const StateId, kChunkVolume>(cells));
        }
    }

    // Chunks with all 27 neighbors' places; null outside.
    render::MeshInput input(i32 x, i32 y, i32 z) const {
        render::MeshInput in;
        for (i32 dy = -1; dy <= 1; ++dy)
            for (i32 dz = -1; dz <= 1; ++dz)
                for (i32 dx = -1; dx <= 1; ++dx) {
                    const i32 cx = x + dx, cy = y + dy, cz = z + dz;
                    const bool inside = cx >= 0 && cx < kX && cy >= 0 && cy < kY && cz >= 0 && cz < kZ;
                    in.chunks[render::MeshInput::index(dx, dy, dz)] =
                        inside ? chunks_[chunk_index(cx, cy, cz)].get() : nullptr;
                }
        in.models = &world.models;
        return in;
    }
    std::size_t size() const { return chunks_.size(); }
    double solid_share() const { return double(solid_) / (double(size()) * kChunkVolume); }

    test::MeshWorld world;

private:
    static std::size_t chunk_index(i32 x, i32 y, i32 z) { return SampleLand::chunk_index(x, y, z); }

    std::vector<std::unique_ptr<Chunk>> chunks_;
    std::size_t solid_ = 0;
};

} // namespace vitrail::bench
