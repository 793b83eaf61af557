// Chunk NBT of every version, up to the states that old numbers become among neighbors.
#include "formats/anvil.h"
#include "formats/legacy_connect.h"

#include <cstdlib>

using namespace vitrail;

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
    nbt::Document doc;
    doc.parse({data, size});
    DecodeContext context;
    RawColumn column;
    if (!decode_chunk(doc.root(), {0, 0}, context, column)) return 0;
    decode_entities(doc.root(), column);
    const LegacyView view({&column, nullptr, &column, nullptr, &column, &column, nullptr, nullptr, &column});
    for (const RawSection& section : column.sections) {
        if (section.palette.empty()) std::abort();
        for (const u16 index : section.indices)
            if (index >= section.palette.size()) std::abort();
        std::array<u32, 64> biomes;
        (void)column.biomes_of(section.y, biomes);
        if (!section.legacy) {
            for (const u32 name : section.palette)
                (void)parse_block_state(context.names.text(name));
            continue;
        }
        std::vector<LegacyKey> palette;
        std::vector<u16> indices;
        connect_legacy(view, section, palette, indices);
        for (const u16 index : indices)
            if (index >= palette.size()) std::abort();
        for (const LegacyKey key : palette)
            (void)legacy_state_of(key);
    }
    return 0;
}
