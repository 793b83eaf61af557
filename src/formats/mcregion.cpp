#include "formats/mcregion.h"

#include <fmt/format.h>

namespace vitrail {

static constexpr u32 kHeight = 128, kBlocks = 16 * 16 * kHeight;

bool is_mcregion_level(const nbt::Tag& level) {
    return level.has("Blocks") && !level.has("Sections");
}

void decode_mcregion_blocks(const nbt::Tag& level, DecodeContext& context, RawColumn& out) {
    const ByteView blocks = level["Blocks"].bytes(), data = level["Data"].bytes();
    if (blocks.size() != kBlocks) {
        out.problems.push_back(fmt::format("block array holds {} bytes instead of {}", blocks.size(), kBlocks));
        out.sections_skipped += kHeight / 16;
        return;
    }
    const bool has_data = data.size() == kBlocks / 2;
    if (!has_data)
        out.problems.push_back(fmt::format("block data array holds {} bytes instead of {}", data.size(), kBlocks / 2));
    LegacyCode codes[kChunkVolume];
    for (u32 sy = 0; sy < kHeight / 16; ++sy) {
        for (u32 x = 0; x < 16; ++x)
            for (u32 z = 0; z < 16; ++z) {
                const u32 from = (x * 16 + z) * kHeight + sy * 16;
                for (u32 y = 0; y < 16; ++y) {
                    const u32 i = from + y;
                    const u32 meta = has_data ? data[i >> 1] >> (i & 1) * 4 & 15u : 0;
                    codes[y << 8 | z << 4 | x] = LegacyCode(blocks[i] << 4 | meta);
                }
            }
        RawSection& section = out.add_section();
        section.y = i32(sy);
        set_legacy_blocks(codes, context, section);
    }
}

} // namespace vitrail
