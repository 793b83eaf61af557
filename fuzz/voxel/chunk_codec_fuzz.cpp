// decode_chunk on any bytes: never crashes, and what it takes encodes and decodes to itself.
#include "base/assert.h"
#include "voxel/chunk_codec.h"

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
    using namespace vitrail;
    const ByteView bytes(data, size);
    const DecodeLimits limits{.state_count = 1000, .biome_count = 100, .bytes_most = 1 << 20};
    (void)decode_chunk_revision(bytes);
    const auto chunk = decode_chunk(bytes, limits);
    if (!chunk) return 0;
    const Bytes again = encode_chunk(*chunk);
    const auto back = decode_chunk(again, {.state_count = 1000, .biome_count = 100});
    VX_ASSERT(back && back->blocks == chunk->blocks && back->revision == chunk->revision);
    VX_ASSERT(encode_chunk(*back) == again);
    return 0;
}
