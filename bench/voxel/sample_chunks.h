// Chunks like those of real worlds, made from a seed without any generator: hills, layers, caves, ores, water, trees,
// sky light and lamps, all with their light. For benchmarks and tests of codec and store.
#pragma once

#include "voxel/chunk.h"
#include "voxel/coords.h"

#include <vector>

namespace vitrail::bench {

struct SampleChunk {
    ChunkPos at;
    ChunkPtr chunk;
};

// `columns` x `columns` chunk columns of 16 chunks, y from 0 to 255, about 35 percent solid. State ids are below
// kSampleStates, in no special order, as a world's table gives them; biomes below kSampleBiomes.
std::vector<SampleChunk> make_sample_chunks(i32 columns = 8, u64 seed = 1);

inline constexpr u32 kSampleStates = 900;
inline constexpr u32 kSampleBiomes = 12;

} // namespace vitrail::bench
