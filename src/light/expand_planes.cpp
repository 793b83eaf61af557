#include "light/expand_planes.h"

#include "light/expand_planes_wide.h"

#include <cstdlib>
#include <cstring>

namespace vitrail {

void expand_planes(const std::array<CellMask, 16>& slices, u32 lit_channels, LightVolume::Cells& out) {
    static_assert(sizeof(Light) == 2);
    static const bool wide = wide::can_expand_planes() && !std::getenv("VITRAIL_PORTABLE"); // set by tests
    if (wide) {
        wide::expand_planes(slices[0].data(), lit_channels, out.data());
        return;
    }
    for (u32 w = 0; w < 64; ++w) {
        u16 cells[64] = {};
        for (u32 bit = 0; bit < 16; ++bit) {
            if (!(lit_channels >> (bit >> 2) & 1)) continue;
            const u64 word = slices[bit][w];
            if (word == 0) continue;
            for (u32 i = 0; i < 64; ++i)
                cells[i] = u16(cells[i] | (word >> i & 1) << bit);
        }
        for (u32 i = 0; i < 64; ++i)
            out[w * 64 + i] = Light(cells[i]);
    }
}

} // namespace vitrail
