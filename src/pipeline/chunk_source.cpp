#include "pipeline/chunk_source.h"

#include "base/log.h"
#include "pipeline/new_world.h"

#include <algorithm>
#include <fmt/format.h>

namespace vitrail {

namespace {

// As compute_heights, for a column that no dimension holds yet: a state takes sky light where its opacity is above 0.
ColumnHeights heights_of(const std::vector<WorldRecords::ColumnChunk>& chunks, const DimensionInfo& info,
                         const StateLight* lights) {
    ColumnHeights heights;
    heights.above.fill(info.min_y);
    std::array<bool, 256> found{};
    u32 open = 256;
    std::array<StateId, kChunkVolume> states;
    for (auto it = chunks.rbegin(); it != chunks.rend() && open > 0; ++it) {
        const BlockStorage& blocks = it->chunk->blocks;
        bool any = false;
        for (StateId id : blocks.palette())
            any |= lights[u32(id)].opacity > 0;
        if (!any) continue;
        blocks.unpack(states);
        for (i32 y = 15; y >= 0 && open > 0; --y)
            for (u32 i = 0; i < 256; ++i) {
                if (found[i] || lights[u32(states[u32(y) << 8 | i])].opacity == 0) continue;
                found[i] = true;
                heights.above[i] = it->at.y * 16 + y + 1;
                --open;
            }
    }
    return heights;
}

} // namespace

ChunkSource::ChunkSource(WorldRecords& records, SaveQueue& saves, ChunkSourceOptions options)
    : records_(records)
    , saves_(saves)
    , options_(std::move(options)) {}

Result<std::unique_ptr<ChunkSource>> ChunkSource::create(WorldRecords& records, SaveQueue& saves,
                                                         ChunkSourceOptions options) {
    auto source = std::unique_ptr<ChunkSource>(new ChunkSource(records, saves, std::move(options)));
    if (!source->options_.generator) return source;
    VX_TRY_ASSIGN(source->palette_,
                  make_terrain_palette(records.states(), records.biomes(), *source->options_.generator));
    return source;
}

const TerrainGenerator* ChunkSource::generator_of(const DimensionInfo& dimension) const {
    return dimension.id == options_.generated_dimension ? options_.generator.get() : nullptr;
}

Result<ColumnData> ChunkSource::load(const DimensionInfo& dimension, ColumnPos at) const {
    VX_TRY_ASSIGN(StoredColumn stored, read(dimension, at));
    return finish(dimension, at, std::move(stored));
}

Result<StoredColumn> ChunkSource::read(const DimensionInfo& dimension, ColumnPos at) const {
    StoredColumn stored;
    VX_TRY_ASSIGN(const auto record, saves_.load_column(dimension.id, at));
    VX_TRY_ASSIGN(stored.chunks, saves_.load_column_chunks(dimension.id, at));
    std::erase_if(stored.chunks, [&](const auto& c) {
        return !c.chunk || c.at.y * 16 < dimension.min_y || c.at.y * 16 >= dimension.max_y;
    });
    stored.recorded = record && record->generated;
    stored.whole = stored.recorded || !generator_of(dimension);
    return stored;
}

GeneratedColumn ChunkSource::generate(ColumnPos at) const {
    if (options_.device && !device_failed_) {
        auto column = options_.device->take(at, palette_);
        if (column) return std::move(*column);
        // The CPU makes the same blocks: nobody need notice but by the time it takes.
        if (!device_failed_.exchange(true))
            log_error(fmt::format("land is made on the CPU from now on: {}", column.error().message));
    }
    return options_.generator->generate(at, palette_);
}

ColumnData ChunkSource::finish(const DimensionInfo& dimension, ColumnPos at, StoredColumn stored) const {
    // Where nothing was ever made and nothing will be, there is open air: an imported world ends in a cliff that can be
    // seen, and built out from; the store learns of such a column only when somebody does.
    ColumnData data{.at = at, .chunks = {}, .heights = {}, .made = true};
    if (!stored.whole) {
        GeneratedColumn column = generate(at);
        for (std::size_t i = 0; i < column.chunks.size(); ++i) {
            const ChunkPos p{at.x, kTerrainMinY / kChunkSize + i32(i), at.z};
            if (p.y * 16 < dimension.min_y || p.y * 16 >= dimension.max_y) continue;
            data.chunks.push_back({p, std::make_shared<const Chunk>(std::move(column.chunks[i]))});
        }
        // A world of another height than the generator's sees other heights.
        const bool same = dimension.min_y <= kTerrainMinY && dimension.max_y >= kTerrainMaxY;
        if (stored.chunks.empty() && same) {
            data.heights.above = column.heights;
            if (dimension.min_y < kTerrainMinY)
                for (i32& above : data.heights.above)
                    if (above == kTerrainMinY) above = dimension.min_y;
            return data;
        }
        // Saved chunks win; a column is only ever saved whole, so this mends one whose record was lost.
        for (auto& s : stored.chunks) {
            auto found =
                std::find_if(data.chunks.begin(), data.chunks.end(), [&](const auto& c) { return c.at == s.at; });
            if (found != data.chunks.end())
                found->chunk = std::move(s.chunk);
            else
                data.chunks.push_back(std::move(s));
        }
    } else {
        data.stored = stored.recorded || !stored.chunks.empty();
        data.chunks = std::move(stored.chunks);
    }
    std::sort(data.chunks.begin(), data.chunks.end(), [](const auto& a, const auto& b) { return a.at.y < b.at.y; });
    // Light is a function of what lies around and is found anew when the column comes in, so it is never out of date.
    for (auto& c : data.chunks) {
        if (!c.chunk->light) continue;
        auto copy = std::make_shared<Chunk>(*c.chunk);
        copy->light = nullptr;
        c.chunk = std::move(copy);
    }
    data.heights = heights_of(data.chunks, dimension, records_.states().light_data());
    return data;
}

} // namespace vitrail
