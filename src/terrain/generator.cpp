#include "terrain/generator.h"

#include "terrain/stage_cache.h"

#include <cstring>
#include <new>

namespace vitrail {

namespace {

ColumnPos moved(ColumnPos at, i32 dx, i32 dz) {
    return {i32(u32(at.x) + u32(dx)), i32(u32(at.z) + u32(dz))};
}

// The least column of the zone that holds a column.
ColumnPos zone_of(ColumnPos at) {
    const auto down = [](i32 v) {
        const i32 r = v % kZoneColumns;
        return v - (r < 0 ? r + kZoneColumns : r);
    };
    return {down(at.x), down(at.z)};
}

struct GroundZone {
    GroundTile tile[kZoneColumns * kZoneColumns];
};

// Tiles are made in place of a thread's own, then copied: only what is used of a feature tile is kept.
std::shared_ptr<const FeatureTile> shrunk(const FeatureTile& tile, u64& bytes) {
    bytes = offsetof(FeatureTile, primitive) + tile.primitives * sizeof(Primitive);
    void* memory = ::operator new(bytes, std::align_val_t(alignof(FeatureTile)));
    std::memcpy(memory, &tile, bytes);
    return {static_cast<const FeatureTile*>(memory), [](const FeatureTile* p) {
                ::operator delete(const_cast<FeatureTile*>(p), std::align_val_t(alignof(FeatureTile)));
            }};
}

} // namespace

struct TerrainGenerator::State {
    CompiledTerrain compiled;
    const TerrainStages* stages = nullptr;
    StageCache cache;

    explicit State(u64 bytes)
        : cache(bytes) {}
    const TerrainTables& tables() const { return *compiled.tables; }

    template <class T>
    std::shared_ptr<const T> tile(TerrainStage stage, ColumnPos at, auto make) {
        return std::static_pointer_cast<const T>(cache.get({u32(stage), at}, [&]() -> StageCache::Made {
            auto out = std::make_shared<T>();
            make(*out);
            return {out, sizeof(T)};
        }));
    }
    std::shared_ptr<const LandTile> land(ColumnPos at) {
        return tile<LandTile>(TerrainStage::land, at, [&](LandTile& out) { stages->land(tables(), at, out); });
    }
    std::shared_ptr<const GroundZone> zone(ColumnPos first) {
        return tile<GroundZone>(TerrainStage::ground, first, [&](GroundZone& out) {
            constexpr i32 span = kZoneColumns + 2 * kGroundReach;
            std::vector<std::shared_ptr<const LandTile>> held;
            const LandTile* lands[span * span];
            for (i32 z = 0; z < span; ++z)
                for (i32 x = 0; x < span; ++x) {
                    held.push_back(land(moved(first, x - kGroundReach, z - kGroundReach)));
                    lands[z * span + x] = held.back().get();
                }
            stages->ground(tables(), first, kZoneColumns, kZoneColumns, lands, out.tile);
        });
    }
    std::shared_ptr<const GroundTile> ground(ColumnPos at) {
        const ColumnPos first = zone_of(at);
        auto zone_tiles = zone(first);
        const GroundTile* own = &zone_tiles->tile[(at.z - first.z) * kZoneColumns + (at.x - first.x)];
        return {std::move(zone_tiles), own};
    }
    std::shared_ptr<const LatticeTile> lattice(ColumnPos at) {
        return tile<LatticeTile>(TerrainStage::lattice, at,
                                 [&](LatticeTile& out) { stages->lattice(tables(), at, out); });
    }
    std::shared_ptr<const CaveTile> caves(ColumnPos at) {
        return tile<CaveTile>(TerrainStage::caves, at, [&](CaveTile& out) {
            const auto own = ground(at);
            const std::shared_ptr<const LatticeTile> held[4] = {lattice(at), lattice(moved(at, 1, 0)),
                                                                lattice(moved(at, 0, 1)), lattice(moved(at, 1, 1))};
            const LatticeTile* lattices[4] = {held[0].get(), held[1].get(), held[2].get(), held[3].get()};
            stages->caves(tables(), at, *own, lattices, out);
        });
    }
    std::shared_ptr<const FeatureTile> features(ColumnPos at) {
        return std::static_pointer_cast<const FeatureTile>(
            cache.get({u32(TerrainStage::features), at}, [&]() -> StageCache::Made {
                const auto own = ground(at);
                const auto open = caves(at);
                static thread_local std::unique_ptr<FeatureTile> scratch = std::make_unique<FeatureTile>();
                stages->features(tables(), at, *own, *open, *scratch);
                StageCache::Made made;
                made.value = shrunk(*scratch, made.bytes);
                return made;
            }));
    }
    void fill(ColumnPos at, const GroundTile& own, const CaveTile& open, BlockTile& out) {
        std::shared_ptr<const FeatureTile> held[49];
        const FeatureTile* around[49];
        for (i32 i = 0; i < 49; ++i) {
            held[i] = features(moved(at, i % 7 - kFeatureReach, i / 7 - kFeatureReach));
            around[i] = held[i].get();
        }
        stages->fill(tables(), at, own, open, out);
        stages->draw(tables(), at, around, out);
        stages->decorate(tables(), at, own, open, out);
    }
};

TerrainGenerator::TerrainGenerator(std::unique_ptr<State> state)
    : state_(std::move(state)) {}
TerrainGenerator::~TerrainGenerator() = default;

Result<std::shared_ptr<TerrainGenerator>> TerrainGenerator::create(const TerrainDescription& description, u64 seed,
                                                                   TerrainGeneratorOptions options) {
    auto state = std::make_unique<State>(options.cache_bytes_most);
    VX_TRY_ASSIGN(state->compiled, compile_terrain(description, seed));
    state->stages = &terrain_stages(options.isa);
    return std::shared_ptr<TerrainGenerator>(new TerrainGenerator(std::move(state)));
}

GeneratedColumn TerrainGenerator::generate(ColumnPos at, const TerrainPalette& palette) const {
    static thread_local std::unique_ptr<BlockTile> scratch = std::make_unique<BlockTile>();
    const auto own = state_->ground(at);
    const auto open = state_->caves(at);
    state_->fill(at, *own, *open, *scratch);
    BiomeTile biomes;
    state_->stages->biomes(state_->tables(), *own, *open, biomes);
    return pack_column(*scratch, biomes, palette);
}

std::unique_ptr<BlockTile> TerrainGenerator::blocks(ColumnPos at) const {
    auto out = std::make_unique<BlockTile>();
    state_->fill(at, *state_->ground(at), *state_->caves(at), *out);
    return out;
}

std::shared_ptr<const LandTile> TerrainGenerator::land(ColumnPos at) const {
    return state_->land(at);
}
std::shared_ptr<const GroundTile> TerrainGenerator::ground(ColumnPos at) const {
    return state_->ground(at);
}
std::shared_ptr<const CaveTile> TerrainGenerator::caves(ColumnPos at) const {
    return state_->caves(at);
}
std::shared_ptr<const FeatureTile> TerrainGenerator::features(ColumnPos at) const {
    return state_->features(at);
}

void TerrainGenerator::missing(ColumnPos at, std::vector<TerrainTask>& out) const {
    const auto has = [&](TerrainStage stage, ColumnPos p) { return state_->cache.has({u32(stage), p}); };
    const auto need = [&](TerrainStage stage, ColumnPos p) {
        if (has(stage, p)) return;
        const TerrainTask task{stage, p};
        for (const TerrainTask& t : out) // short lists but for land, which is asked for once a zone
            if (t == task) return;
        out.push_back(task);
    };
    const auto need_zone = [&](ColumnPos first) {
        if (has(TerrainStage::ground, first)) return;
        for (const TerrainTask& t : out)
            if (t == TerrainTask{TerrainStage::ground, first}) return;
        constexpr i32 reach = kGroundReach, end = kZoneColumns + kGroundReach;
        for (i32 z = -reach; z < end; ++z)
            for (i32 x = -reach; x < end; ++x)
                if (const ColumnPos p = moved(first, x, z); !has(TerrainStage::land, p))
                    out.push_back({TerrainStage::land, p}); // zones share some; a second run finds it made
        out.push_back({TerrainStage::ground, first});
    };
    const std::size_t start = out.size();
    for (i32 i = 0; i < 49; ++i) {
        const ColumnPos p = moved(at, i % 7 - kFeatureReach, i / 7 - kFeatureReach);
        if (has(TerrainStage::features, p)) continue;
        need_zone(zone_of(p));
        if (!has(TerrainStage::caves, p)) {
            for (i32 k = 0; k < 4; ++k)
                need(TerrainStage::lattice, moved(p, k & 1, k >> 1));
            out.push_back({TerrainStage::caves, p});
        }
        out.push_back({TerrainStage::features, p});
    }
    // The column itself reads its ground and caves, which may have been dropped though its features are kept.
    if (out.size() == start) {
        need_zone(zone_of(at));
        if (!has(TerrainStage::caves, at)) {
            for (i32 k = 0; k < 4; ++k)
                need(TerrainStage::lattice, moved(at, k & 1, k >> 1));
            out.push_back({TerrainStage::caves, at});
        }
    }
}

void TerrainGenerator::run(TerrainTask task) const {
    switch (task.stage) {
    case TerrainStage::land:
        state_->land(task.at);
        break;
    case TerrainStage::ground:
        state_->zone(task.at);
        break;
    case TerrainStage::lattice:
        state_->lattice(task.at);
        break;
    case TerrainStage::caves:
        state_->caves(task.at);
        break;
    case TerrainStage::features:
        state_->features(task.at);
        break;
    case TerrainStage::blocks:
    case TerrainStage::count:
        break;
    }
}

const TerrainTables& TerrainGenerator::tables() const {
    return state_->tables();
}
const std::vector<std::string>& TerrainGenerator::block_names() const {
    return state_->compiled.block_names;
}
const std::vector<std::string>& TerrainGenerator::biome_names() const {
    return state_->compiled.biome_names;
}
u64 TerrainGenerator::seed() const {
    return state_->tables().seed;
}
TerrainCacheStats TerrainGenerator::cache_stats() const {
    const StageCache::Stats s = state_->cache.stats();
    return {s.bytes, s.hits, s.misses, s.dropped};
}
void TerrainGenerator::clear_caches() const {
    state_->cache.clear();
}

} // namespace vitrail
