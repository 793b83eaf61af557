#include "formats/raw_column.h"

#include <algorithm>

namespace vitrail {

u32 NameTable::intern(std::string_view text) {
    if (auto it = index_.find(text); it != index_.end()) return it->second;
    texts_.emplace_back(text);
    const u32 number = u32(texts_.size() - 1);
    index_.emplace(texts_.back(), number);
    return number;
}

u32* NameTable::find_alias(std::string_view raw) {
    auto it = aliases_.find(raw);
    return it == aliases_.end() ? nullptr : &it->second;
}

void NameTable::add_alias(std::string_view raw, u32 number) {
    // A damaged world could invent spellings without end; they only cost time once the table is full.
    if (aliases_.size() >= 65536) return;
    alias_texts_.emplace_back(raw);
    aliases_.emplace(alias_texts_.back(), number);
}

void RawColumn::clear() {
    for (RawSection& s : sections)
        spare_.push_back(std::move(s));
    sections.clear();
    data_version = 0;
    position_disagrees = false;
    status.clear();
    level_biomes.clear();
    biome_min_y = 0;
    block_entities.clear();
    entities.clear();
    ticks.clear();
    problems.clear();
    sections_skipped = 0;
}

RawSection& RawColumn::add_section() {
    if (spare_.empty()) {
        sections.emplace_back();
    } else {
        sections.push_back(std::move(spare_.back()));
        spare_.pop_back();
    }
    RawSection& s = sections.back();
    s.legacy = s.has_biomes = false;
    s.palette.clear();
    s.indices.clear();
    return s;
}

const RawSection* RawColumn::section_at(i32 y) const {
    for (const RawSection& s : sections)
        if (s.y == y) return &s;
    return nullptr;
}

bool RawColumn::biomes_of(i32 section_y, std::array<u32, 64>& out) const {
    if (const RawSection* s = section_at(section_y); s && s->has_biomes) {
        out = s->biomes;
        return true;
    }
    const i32 levels = i32(level_biomes.size() / 16);
    if (levels == 0) return false;
    for (i32 y = 0; y < 4; ++y) {
        const i32 level = std::clamp(section_y * 4 + y - biome_min_y / 4, 0, levels - 1);
        std::copy_n(level_biomes.begin() + level * 16, 16, out.begin() + y * 16);
    }
    return true;
}

} // namespace vitrail
