// A region file in memory: head, chunk heads, every compression, the chunks within.
#include "formats/chunk_walk.h"

using namespace vitrail;

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
    // Real heads are 8 KiB of mostly nothing: the input gives four slots and what follows the head.
    Bytes bytes(8192);
    for (std::size_t i = 0; i < 16 && i < size; ++i)
        bytes[i] = data[i];
    if (size > 16) bytes.insert(bytes.end(), data + 16, data + size);
    const auto region = RegionFile::from_bytes(std::move(bytes));
    if (!region) return 0;
    ChunkReader reader;
    DecodeContext context;
    RawColumn column;
    ReadReport report;
    for (u32 slot = 0; slot < 4; ++slot)
        (void)read_chunk(*region, slot, reader, context, column, report);
    return 0;
}
