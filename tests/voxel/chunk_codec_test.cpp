#include "voxel/chunk_codec.h"

#include "base/rng.h"

#include <algorithm>
#include <gtest/gtest.h>

namespace vitrail {

static bool same(const Chunk& a, const Chunk& b) {
    const bool light = (!a.light && !b.light) || (a.light && b.light && *a.light == *b.light);
    return light && a.blocks == b.blocks && a.biomes == b.biomes && a.block_entities == b.block_entities &&
           a.ticks == b.ticks && a.entities == b.entities && a.revision == b.revision;
}

// Palettes of every width, lights of every width, lists that are empty or not.
static Chunk random_chunk(Rng& rng) {
    Chunk chunk;
    static constexpr u32 kinds[] = {1, 2, 3, 4, 5, 16, 17, 200, 256, 257, 4000};
    const u32 states = kinds[rng.below(11)], lights = kinds[rng.below(11)], runs = 1 + rng.below(60);
    std::array<StateId, kChunkVolume> cells;
    u32 state = rng.below(states);
    for (auto& c : cells) {
        if (rng.below(runs) == 0) state = rng.below(states);
        c = StateId(state * 3);
    }
    chunk.blocks = BlockStorage::from_states(cells);
    for (u32 i = rng.below(20); i > 0; --i)
        chunk.blocks.set(LocalPos(rng.below(4096)), StateId(rng.below(12000)));
    if (rng.below(4)) {
        auto light = std::make_shared<LightVolume>(Light(u16(rng.next())));
        for (u32 i = 0; lights > 1 && i < 4096; ++i)
            if (rng.below(runs) == 0) light->set(LocalPos(i), Light(u16(mix64(rng.below(lights)))));
        chunk.light = light;
    }
    if (rng.below(2))
        for (auto& b : chunk.biomes.cells)
            b = BiomeId(u16(rng.below(3)));
    if (rng.below(2)) chunk.biomes.cells.fill(BiomeId(u16(rng.below(65536))));
    for (u32 i = rng.below(4); i > 0; --i)
        chunk.block_entities.push_back({LocalPos(rng.below(4096)), Bytes(rng.below(300), u8(rng.next()))});
    for (u32 i = rng.below(4); i > 0; --i)
        chunk.ticks.push_back({LocalPos(rng.below(4096)), rng.next(), i32(u32(rng.next())), StateId(rng.below(9))});
    for (u32 i = rng.below(4); i > 0; --i)
        chunk.entities.push_back(Bytes(rng.below(300), u8(rng.next())));
    chunk.revision = rng.next() >> rng.below(64);
    return chunk;
}

TEST(ChunkCodec, EveryChunkComesBackAsItWas) {
    Rng rng(1);
    for (int i = 0; i < 600; ++i) {
        const Chunk chunk = random_chunk(rng);
        const Bytes bytes = encode_chunk(chunk);
        const auto back = decode_chunk(bytes);
        ASSERT_TRUE(back) << i << " " << back.error().message;
        ASSERT_TRUE(same(chunk, *back)) << i;
        EXPECT_EQ(encode_chunk(*back), bytes) << "the record of a chunk does not depend on its history";
        EXPECT_EQ(*decode_chunk_revision(bytes), chunk.revision);
    }
}

TEST(ChunkCodec, RecordDoesNotDependOnThePalette) {
    Chunk a, b;
    a.blocks.set(LocalPos(5), StateId(7));
    b.blocks.set(LocalPos(9), StateId(8));
    b.blocks.set(LocalPos(5), StateId(7));
    b.blocks.set(LocalPos(9), StateId(0));
    EXPECT_EQ(encode_chunk(a), encode_chunk(b));
}

TEST(ChunkCodec, UniformChunkIsAFewBytes) {
    Chunk air;
    air.light = std::make_shared<LightVolume>(Light(15, 0, 0, 0));
    EXPECT_LE(encode_chunk(air).size(), 9u);
}

TEST(ChunkCodec, PartsLeftOutAreDefaults) {
    Rng rng(4);
    Chunk chunk = random_chunk(rng);
    chunk.light = std::make_shared<LightVolume>(Light(1, 2, 3, 4));
    const auto back = decode_chunk(encode_chunk(chunk, kChunkLight | kChunkRevision));
    ASSERT_TRUE(back);
    EXPECT_TRUE(*back->light == *chunk.light);
    EXPECT_EQ(back->revision, chunk.revision);
    EXPECT_TRUE(back->blocks == BlockStorage());
    EXPECT_TRUE(back->entities.empty());
}

TEST(ChunkCodec, AppendsToWhatIsThere) {
    Chunk chunk;
    Bytes out{9, 9};
    encode_chunk(chunk, kChunkAll, out);
    EXPECT_TRUE(decode_chunk(ByteView(out).subspan(2)));
}

TEST(ChunkCodec, UnknownSectionsAreSkipped) {
    Chunk chunk;
    chunk.revision = 77;
    Bytes bytes = encode_chunk(chunk);
    const u8 unknown[] = {100, 3, 1, 2, 3};
    bytes.insert(bytes.begin() + 1, std::begin(unknown), std::end(unknown));
    const auto back = decode_chunk(bytes);
    ASSERT_TRUE(back);
    EXPECT_EQ(back->revision, 77u);
    EXPECT_EQ(*decode_chunk_revision(bytes), 77u);
}

TEST(ChunkCodec, LimitsHold) {
    Chunk chunk;
    chunk.blocks.set(LocalPos(0), StateId(50));
    chunk.biomes.cells[0] = BiomeId(4);
    const Bytes bytes = encode_chunk(chunk);
    EXPECT_TRUE(decode_chunk(bytes, {.state_count = 51, .biome_count = 5}));
    EXPECT_EQ(decode_chunk(bytes, {.state_count = 50}).error().code, ErrorCode::damaged);
    EXPECT_EQ(decode_chunk(bytes, {.biome_count = 4}).error().code, ErrorCode::damaged);
    EXPECT_EQ(decode_chunk(bytes, {.bytes_most = 100}).error().code, ErrorCode::limit);
}

TEST(ChunkCodec, OtherFormatsAndPackingsAreUnsupported) {
    EXPECT_EQ(decode_chunk(Bytes{2}).error().code, ErrorCode::unsupported);
    EXPECT_EQ(decode_chunk(Bytes{0xf1, 1}).error().code, ErrorCode::unsupported);
    EXPECT_EQ(decode_chunk(Bytes{}).error().code, ErrorCode::damaged);
}

TEST(ChunkCodec, SizeIsRefusedBeforeItIsAllocated) {
    ByteWriter bomb;
    bomb.put_u8(0x11);
    bomb.put_varint(u64(1) << 60);
    EXPECT_EQ(decode_chunk(bomb.bytes()).error().code, ErrorCode::limit);
}

TEST(ChunkCodec, BadSectionsAreDamage) {
    auto record = [](std::initializer_list<u8> body) {
        Bytes out(1 + body.size(), 1);
        std::copy(body.begin(), body.end(), out.begin() + 1); // insert() makes g++ 12 see a bound passed that is not
        return out;
    };
    Bytes two_of_three = record({1, 0x80 | 4, 8, 3, 0, 1, 2}); // palette of three, 1024 bytes of indices
    two_of_three.resize(two_of_three.size() + 1024, 0);
    EXPECT_TRUE(decode_chunk(two_of_three));
    two_of_three.back() = 0xc0; // index 3
    EXPECT_EQ(decode_chunk(two_of_three).error().code, ErrorCode::damaged);
    const Bytes bad[] = {
        record({1, 1, 0}),                          // an empty palette
        record({1, 3, 2, 0, 1}),                    // two states, no indices
        record({1, 2, 1, 0, 0}),                    // a byte too many, read as the next section
        record({1, 3, 1, 0, 0}),                    // a byte too many in the section
        record({1, 200, 1}),                        // a length beyond the end
        record({2, 4, 1, 0xff, 0xff, 7}),           // light above 16 bits
        record({2, 3, 3, 0, 0}),                    // light without indices
        record({3, 3, 2, 0, 16}),                   // biomes of two layers
        record({3, 3, 1, 0, 17}),                   // a run over the end
        record({3, 3, 1, 0, 15}),                   // a run that ends early
        record({4, 4, 1, 0xff, 0x7f, 0}),           // a block entity outside the chunk
        record({4, 5, 0xff, 0xff, 0xff, 0xff, 15}), // four thousand million block entities
        record({5, 3, 1, 0, 0}),                    // half a tick
        record({6, 2, 1, 9}),                       // an entity beyond the end
        record({7, 1, 0x80}),                       // half a number
    };
    for (const Bytes& b : bad) {
        const auto back = decode_chunk(b);
        ASSERT_FALSE(back) << int(b[1]) << " " << int(b[2]) << " " << int(b[3]);
        EXPECT_EQ(back.error().code, ErrorCode::damaged);
    }
}

TEST(ChunkCodec, SpoiledRecordsNeverCrash) {
    Rng rng(11);
    for (int i = 0; i < 3000; ++i) {
        Bytes bytes = encode_chunk(random_chunk(rng));
        for (u32 k = 1 + rng.below(4); k > 0; --k)
            bytes[rng.below(u32(bytes.size()))] = u8(rng.next());
        if (rng.below(4) == 0) bytes.resize(rng.below(u32(bytes.size())));
        const auto back = decode_chunk(bytes);
        EXPECT_TRUE(!back || decode_chunk(encode_chunk(*back)));
        (void)decode_chunk_revision(bytes);
    }
}

} // namespace vitrail
