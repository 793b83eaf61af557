#include "pipeline/column_converter.h"

#include "base/assert.h"

#include <algorithm>
#include <fmt/format.h>

namespace vitrail {

namespace {

constexpr u32 kUnknown = ~0u;
constexpr i32 kVersion1_18 = 2825; // from here on a chunk lists all of its sections

// Letters that a state text cannot hold, replaced, so that a strange name is kept nearly as it was.
std::string mended(std::string_view text) {
    std::string out;
    for (const char c : text.substr(0, 256)) {
        const bool fine = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
                          c == '.' || c == '-' || c == '/' || c == ':';
        out += fine ? c : '_';
    }
    return out.find(':') == out.npos ? "legacy:" + out : out;
}

ColumnHeights heights_of(const std::vector<std::pair<i32, std::shared_ptr<Chunk>>>& chunks, const StateLight* lights,
                         i32 least_y) {
    ColumnHeights out;
    out.above.fill(least_y);
    std::array<bool, 256> found{};
    u32 open = 256;
    std::array<StateId, kChunkVolume> states;
    for (auto it = chunks.rbegin(); it != chunks.rend() && open > 0; ++it) {
        const auto& [y, chunk] = *it;
        const auto palette = chunk->blocks.palette();
        if (std::all_of(palette.begin(), palette.end(), [&](StateId id) { return lights[u32(id)].opacity == 0; }))
            continue;
        chunk->blocks.unpack(states);
        for (u32 c = 0; c < 256; ++c)
            for (i32 dy = 15; dy >= 0 && !found[c]; --dy) {
                if (lights[u32(states[c | u32(dy) << 8])].opacity == 0) continue;
                out.above[c] = y * 16 + dy + 1;
                found[c] = true;
                --open;
            }
    }
    return out;
}

} // namespace

bool ColumnConverter::has_terrain(std::string_view status) {
    return status != "empty" && status != "structure_starts" && status != "structure_references" && status != "biomes";
}

Result<StateId> ColumnConverter::state_of_name(u32 number, const NameTable& names) {
    if (number >= states_.size()) states_.resize(names.size(), kUnknown);
    if (states_[number] == kUnknown) {
        auto state = parse_block_state(names.text(number));
        if (!state) {
            problems.push_back(fmt::format("{}; kept under a changed name", state.error().message));
            state = parse_block_state(mended(names.text(number)));
            if (!state) state = BlockState{"vitrail:unknown", {}};
        }
        VX_TRY_ASSIGN(const StateId id, sink_.states().intern(*state));
        states_[number] = u32(id);
    }
    return StateId(states_[number]);
}

Result<StateId> ColumnConverter::state_of_key(LegacyKey key) {
    if (const auto it = legacy_.find(key); it != legacy_.end()) return it->second;
    VX_TRY_ASSIGN(const StateId id, sink_.states().intern_with_defaults(legacy_state_of(key)));
    legacy_.emplace(key, id);
    return id;
}

Result<BiomeId> ColumnConverter::biome_of(u32 number, const NameTable& names) {
    if (number >= biomes_.size()) biomes_.resize(names.size(), kUnknown);
    if (biomes_[number] == kUnknown) {
        VX_TRY_ASSIGN(const BiomeId id, sink_.biome(names.text(number).substr(0, 256)));
        biomes_[number] = u32(id);
    }
    return BiomeId(biomes_[number]);
}

Result<BlockStorage> ColumnConverter::blocks_of(const RawSection& section, const NameTable& names,
                                                const LegacyView* around) {
    palette_.clear();
    const std::vector<u16>* indices = &section.indices;
    if (section.legacy) {
        VX_ASSERT(around);
        connect_legacy(*around, section, keys_, indices_);
        indices = &indices_;
        for (const LegacyKey key : keys_) {
            VX_TRY_ASSIGN(const StateId id, state_of_key(key));
            palette_.push_back(id);
        }
    } else {
        for (const u32 number : section.palette) {
            VX_TRY_ASSIGN(const StateId id, state_of_name(number, names));
            palette_.push_back(id);
        }
    }
    for (const StateId id : palette_)
        if (u32(id) >= counts.size()) counts.resize(std::max<std::size_t>(u32(id) + 1, sink_.states().size()));
    if (indices->empty() || palette_.size() == 1) {
        counts[u32(palette_[0])] += kChunkVolume;
        return BlockStorage(palette_[0]);
    }
    std::array<u32, kChunkVolume> histogram;
    std::fill_n(histogram.begin(), palette_.size(), 0u);
    for (const u16 index : *indices)
        ++histogram[index];
    for (std::size_t i = 0; i < palette_.size(); ++i)
        counts[u32(palette_[i])] += histogram[i];
    return BlockStorage::from_indices(palette_, std::span<const u16, kChunkVolume>(indices->data(), kChunkVolume));
}

Result<BiomeGrid> ColumnConverter::biomes_of(const RawColumn& raw, i32 y, const NameTable& names) {
    BiomeGrid out;
    std::array<u32, 64> numbers;
    if (!raw.biomes_of(y, numbers)) return out;
    for (std::size_t i = 0; i < 64; ++i) {
        VX_TRY_ASSIGN(out.cells[i], biome_of(numbers[i], names));
    }
    return out;
}

void ColumnConverter::keep_entities(RawColumn& raw, std::vector<std::pair<i32, std::shared_ptr<Chunk>>>& chunks) {
    auto chunk_at = [&](i32 y) -> Chunk* {
        const i64 i = i64(y) - chunks.front().first;
        return i >= 0 && i < i64(chunks.size()) ? chunks[std::size_t(i)].second.get() : nullptr;
    };
    for (RawBlockEntity& e : raw.block_entities) {
        Chunk* chunk = chunk_at(e.at.y >> 4);
        if (!chunk || e.nbt.empty()) {
            ++skipped;
            continue;
        }
        chunk->block_entities.push_back({local_of(e.at), std::move(e.nbt)});
        ++block_entities;
    }
    for (RawEntity& e : raw.entities) {
        if (e.nbt.empty()) {
            ++skipped;
            continue;
        }
        // Above and below the built chunks the nearest one keeps it.
        const i32 y = std::clamp(e.y >> 4, chunks.front().first, chunks.back().first);
        chunk_at(y)->entities.push_back(std::move(e.nbt));
        ++entities;
    }
    for (const RawTick& t : raw.ticks) {
        Chunk* chunk = chunk_at(t.at.y >> 4);
        if (!chunk) continue;
        const StateId state = chunk->blocks.get(local_of(t.at));
        if (state == StateId::air) continue;
        chunk->ticks.push_back({local_of(t.at), u64(std::max(t.delay, 0)), t.priority, state});
        ++ticks;
    }
}

Result<ImportedColumn> ColumnConverter::convert(RawColumn& raw, const NameTable& names, const LegacyView* around,
                                                DimensionId dimension, i32 least_y) {
    ImportedColumn out;
    out.dimension = dimension;
    out.at = raw.at;
    if (raw.sections.empty() && !has_terrain(raw.status)) return out;
    // Before 1.18 a section of air was left out; columns then reach from 0 to 255.
    i32 low = 0, high = 15;
    const bool whole = raw.data_version >= kVersion1_18;
    if (whole && !raw.sections.empty()) low = high = raw.sections[0].y;
    for (const RawSection& s : raw.sections)
        low = std::min(low, s.y), high = std::max(high, s.y);
    if (high - low >= 512) return fail(ErrorCode::limit, "column is higher than 8192 blocks");

    std::vector<std::pair<i32, std::shared_ptr<Chunk>>> chunks;
    for (i32 y = low; y <= high; ++y) {
        auto chunk = std::make_shared<Chunk>();
        if (const RawSection* section = raw.section_at(y)) {
            VX_TRY_ASSIGN(chunk->blocks, blocks_of(*section, names, around));
        }
        VX_TRY_ASSIGN(chunk->biomes, biomes_of(raw, y, names));
        chunks.emplace_back(y, std::move(chunk));
    }
    keep_entities(raw, chunks);
    out.heights = heights_of(chunks, sink_.states().light_data(), least_y);
    for (auto& [y, chunk] : chunks)
        out.chunks.push_back({y, std::move(chunk)});
    return out;
}

} // namespace vitrail
