#include "pipeline/built_world.h"

#include <algorithm>
#include <fmt/format.h>
#include <map>
#include <unordered_map>

namespace vitrail {

namespace {

constexpr std::size_t kColumnsABatch = 128;

// Numbers of the built world to those of the records, each when first met.
class Renumbering {
public:
    Renumbering(const StateTable& from, const BiomeTable& from_biomes, WorldRecords& to)
        : from_(from)
        , from_biomes_(from_biomes)
        , to_(to) {}

    Result<ChunkPtr> chunk(const Chunk& built) {
        auto out = std::make_shared<Chunk>(built);
        out->light = nullptr;
        std::vector<StateId> palette;
        for (const StateId id : built.blocks.palette()) {
            VX_TRY_ASSIGN(const StateId renamed, state(id));
            palette.push_back(renamed);
        }
        out->blocks =
            BlockStorage::from_packed(std::move(palette), {built.blocks.words().begin(), built.blocks.words().end()});
        for (BiomeId& cell : out->biomes.cells) {
            VX_TRY_ASSIGN(cell, biome(cell));
        }
        return out;
    }

private:
    Result<StateId> state(StateId id) {
        if (const auto known = states_.find(id); known != states_.end()) return known->second;
        VX_TRY_ASSIGN(const StateId renamed, to_.states().intern(from_.info(id).state));
        return states_[id] = renamed;
    }
    Result<BiomeId> biome(BiomeId id) {
        if (const auto known = biomes_.find(id); known != biomes_.end()) return known->second;
        VX_TRY_ASSIGN(const BiomeId renamed, to_.biomes().intern(from_biomes_.name(id)));
        return biomes_[id] = renamed;
    }

    const StateTable& from_;
    const BiomeTable& from_biomes_;
    WorldRecords& to_;
    std::unordered_map<StateId, StateId> states_;
    std::unordered_map<BiomeId, BiomeId> biomes_;
};

bool is_air(const Chunk& chunk) {
    return chunk.blocks.uniform() && chunk.blocks.palette()[0] == StateId::air;
}

} // namespace

Result<BuiltWorldFigures> keep_built_world(const std::string& folder, const Dimension& dimension,
                                           const BiomeTable& biomes, const LevelRecord& wanted) {
    VX_TRY_ASSIGN(const auto records, WorldRecords::open(folder, dimension.states().registry_ptr(), {.create = true}));
    VX_TRY_ASSIGN(const auto before, records->load_level());
    if (before) return fail(ErrorCode::denied, fmt::format("{} holds a world already: it is left as it is", folder));
    LevelRecord level = wanted;
    level.generator = "", level.generator_version = 0;
    level.unfinished = true;
    SaveBatch first;
    first.level = level;
    first.dimensions.push_back(dimension.info());
    VX_TRY(records->save(first));

    // In order of position, so that the same world makes the same store.
    std::map<std::pair<i32, i32>, std::vector<i32>> columns; // x, z: heights of chunks
    for (const auto& [at, chunk] : dimension.chunks())
        columns[{at.x, at.z}].push_back(at.y);
    BuiltWorldFigures figures;
    Renumbering renumbering(dimension.states(), biomes, *records);
    SaveBatch batch;
    for (auto& [at, heights] : columns) {
        std::sort(heights.begin(), heights.end());
        for (const i32 y : heights) {
            const ChunkPos p{at.first, y, at.second};
            const ChunkPtr built = dimension.find(p);
            if (is_air(*built)) continue;
            VX_TRY_ASSIGN(ChunkPtr chunk, renumbering.chunk(*built));
            batch.chunks.push_back({dimension.info().id, p, std::move(chunk)});
            ++figures.chunks;
        }
        const ColumnPos column{at.first, at.second};
        batch.columns.push_back(
            {dimension.info().id, column, {.heights = compute_heights(dimension, column), .generated = true}});
        ++figures.columns;
        if (batch.columns.size() < kColumnsABatch) continue;
        VX_TRY(records->save(std::exchange(batch, {})));
    }
    level.unfinished = false;
    batch.level = level;
    VX_TRY(records->save(batch));
    return figures;
}

} // namespace vitrail
