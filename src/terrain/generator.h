// TerrainGenerator: blocks of the endless world, a pure function of (description, seed, column): the same whatever the
// order of columns, the number of threads, the compiler, the vector width or the device. How to use it:
//
//     VX_TRY_ASSIGN(auto generator, TerrainGenerator::create(description, seed));
//     TerrainPalette palette = ...;   // pipeline/new_world.h: ids for generator->block_names(), biome_names()
//     GeneratedColumn column = generator->generate({x, z}, palette);   // any thread
//
// Stages and their reach stand in terrain/tiles.h. Results of stages are kept for the columns around, up to a bound of
// bytes; who schedules work himself asks `missing` what a column still needs and runs that first, each part on any
// thread.
#pragma once

#include "base/result.h"
#include "terrain/compile/compile.h"
#include "terrain/cpu/stages.h"
#include "voxel/chunk.h"

#include <array>
#include <memory>
#include <vector>

namespace vitrail {

// Ids of the generator's blocks and biomes in a world, in the order of its names.
struct TerrainPalette {
    std::vector<StateId> blocks;
    std::vector<BiomeId> biomes;
    std::vector<u8> takes_light; // 1: opacity above 0, for GeneratedColumn::heights
};

struct GeneratedColumn {
    std::vector<Chunk> chunks; // kTerrainSections of them, lowest first; all-air ones too, unlit
    // As ColumnHeights (world/dimension.h): index x | z << 4, the y above the highest block that takes sky light.
    std::array<i32, 256> heights{};
};

enum class TerrainStage : u8 { land, ground, lattice, caves, features, blocks, count };
inline constexpr const char* kTerrainStageNames[] = {"land", "ground", "lattice", "caves", "features", "blocks"};
// One part of the work. ground: `at` is the least column of a zone of kZoneColumns^2.
struct TerrainTask {
    TerrainStage stage{};
    ColumnPos at;
    friend constexpr bool operator==(const TerrainTask&, const TerrainTask&) = default;
};

struct TerrainGeneratorOptions {
    Isa isa = best_isa();
    u64 cache_bytes_most = 96u << 20; // of stage results, the least recently used go
};

struct TerrainCacheStats {
    u64 bytes = 0, hits = 0, misses = 0, dropped = 0;
};

class TerrainGenerator {
public:
    // Errors: those of compile_terrain.
    static Result<std::shared_ptr<TerrainGenerator>> create(const TerrainDescription& description, u64 seed,
                                                            TerrainGeneratorOptions options = {});
    ~TerrainGenerator();

    // All stages, those that are missing in this thread.
    GeneratedColumn generate(ColumnPos at, const TerrainPalette& palette) const;
    // The raw blocks before palettes (tests, maps, statistics); index x | z << 4 | y << 8.
    std::unique_ptr<BlockTile> blocks(ColumnPos at) const;
    // The surface without trees and caves, from stage results that are kept: cheap beside `generate`.
    std::shared_ptr<const LandTile> land(ColumnPos at) const;
    std::shared_ptr<const GroundTile> ground(ColumnPos at) const;
    std::shared_ptr<const CaveTile> caves(ColumnPos at) const;
    std::shared_ptr<const FeatureTile> features(ColumnPos at) const;

    // What must run before `generate(at)` finds all other stages' results, in an order that works; empty when it does.
    // Only parts whose own needs are met or stand earlier in the list.
    void missing(ColumnPos at, std::vector<TerrainTask>& out) const;
    // Runs one part and keeps its result; another thread that wants the same part waits for it. Its needs that are
    // missing run too. Not for TerrainStage::blocks.
    void run(TerrainTask task) const;

    const TerrainTables& tables() const;
    const std::vector<std::string>& block_names() const;
    const std::vector<std::string>& biome_names() const; // surface biomes, then cave biomes
    u64 seed() const;
    TerrainCacheStats cache_stats() const;
    void clear_caches() const;

private:
    struct State;
    explicit TerrainGenerator(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

// Chunks and heights of a tile: the last step of the CPU and the CUDA backend alike.
GeneratedColumn pack_column(const BlockTile& tile, const BiomeTile& biomes, const TerrainPalette& palette);

// A pretty, dry, open place near the origin: where the feet stand.
BlockPos spawn_point(const TerrainGenerator& generator);

// Hash of all block states and biomes: equal columns have equal hashes.
u64 column_hash(const GeneratedColumn& column);

} // namespace vitrail
