// What blocks before 1.13 did not store because the game read it off their neighbors: arms of fences and panes, corners
// of stairs, other halves of doors and tall plants, snow on grass, wires, double chests; and what their block entities
// told.
#pragma once

#include "formats/legacy_ids.h"

#include <array>

namespace vitrail {

// A column and those around it; a column that is null is taken as air.
class LegacyView {
public:
    // columns[(dz + 1) * 3 + dx + 1]; the middle one is there.
    explicit LegacyView(const std::array<const RawColumn*, 9>& columns);
    // x, z from -16 to 31, relative to the middle column; 0 (air) where nothing is known.
    LegacyCode at(i32 x, i32 y, i32 z) const;
    const RawColumn& middle() const { return *middle_; }

private:
    static constexpr i32 kSections = 16; // numeric worlds are 256 high
    const RawColumn* middle_;
    std::array<std::array<const RawSection*, kSections>, 9> sections_{};
};

// A LegacyCode with its LegacyBits: code | bits << 16.
using LegacyKey = u32;
inline BlockState legacy_state_of(LegacyKey key) {
    return legacy_state(LegacyCode(key & 0xffff), LegacyBits(key >> 16));
}

// The palette of keys and the 4096 indices of a section of the middle column, which must be one with numeric ids.
void connect_legacy(const LegacyView& view, const RawSection& section, std::vector<LegacyKey>& palette,
                    std::vector<u16>& indices);

} // namespace vitrail
