#include "voxel/chunk_codec.h"

#include "base/assert.h"

#include <algorithm>
#include <array>
#include <memory>
#include <zstd.h>

namespace vitrail {

namespace {

constexpr u8 kFormat = 1;
// Low four bits of the first byte: format; high four: how the rest is packed.
enum Packing : u8 { kPlain = 0, kZstd = 1 };
enum SectionNumber : u32 { kBlocks = 1, kLight, kBiomes, kBlockEntities, kTicks, kEntities, kRevision };

struct Contexts {
    ZSTD_CCtx* pack = ZSTD_createCCtx();
    ZSTD_DCtx* unpack = ZSTD_createDCtx();
    ByteWriter body, section;
    Bytes plain;
    ~Contexts() {
        ZSTD_freeCCtx(pack);
        ZSTD_freeDCtx(unpack);
    }
};

Contexts& contexts() {
    thread_local Contexts c;
    return c;
}

void put_blocks(ByteWriter& out, const BlockStorage& given) {
    BlockStorage blocks = given;
    blocks.compact();
    out.put_varint(blocks.palette().size());
    for (StateId id : blocks.palette())
        out.put_varint(u32(id));
    out.put_raw(blocks.words().data(), blocks.words().size_bytes());
}

void put_light(ByteWriter& out, const LightVolume& light) {
    const auto* cells = light.cells();
    const Light first = light.get(LocalPos());
    const bool uniform = !cells || std::all_of(cells->begin(), cells->end(), [&](Light l) { return l == first; });
    if (uniform) return out.put_u16(first.bits);
    out.put_raw(cells->data(), sizeof *cells);
}

bool get_blocks(ByteReader& in, const DecodeLimits& limits, BlockStorage& blocks) {
    const u64 count = in.get_varint();
    if (count == 0 || count > kChunkVolume || count > in.remaining()) return false;
    std::vector<StateId> palette(count);
    for (StateId& id : palette) {
        const u64 raw = in.get_varint();
        if (raw >= limits.state_count) return false;
        id = StateId(u32(raw));
    }
    const unsigned bits = bits_for_palette(count);
    const ByteView packed = in.get_bytes(u64(bits) * 512);
    if (in.failed()) return false;
    std::array<u16, kChunkVolume> indices{};
    for (u32 cell = 0; bits > 0 && cell < kChunkVolume; ++cell) {
        const u32 bit = cell * bits;
        u32 v = packed[bit >> 3];
        if (bits == 16) v |= u32(packed[(bit >> 3) + 1]) << 8;
        v = v >> (bit & 7) & ((1u << bits) - 1);
        if (v >= count) return false;
        indices[cell] = u16(v);
    }
    blocks = BlockStorage::from_indices(palette, indices);
    return true;
}

bool get_light(ByteReader& in, LightVolume& light) {
    if (in.remaining() == 2) {
        light = LightVolume(Light(in.get_u16()));
        return true;
    }
    const ByteView raw = in.get_bytes(sizeof(LightVolume::Cells));
    if (in.failed()) return false;
    std::memcpy(light.writable().data(), raw.data(), raw.size());
    return true;
}

// Small vectors of byte strings and such: counts are bounded by what is left before anything is allocated.
bool get_block_entities(ByteReader& in, std::vector<BlockEntity>& out) {
    const u64 count = in.get_varint();
    if (count > in.remaining()) return false;
    for (u64 i = 0; i < count && !in.failed(); ++i) {
        const u64 cell = in.get_varint();
        const ByteView nbt = in.get_bytes(in.get_varint());
        if (cell >= kChunkVolume) return false;
        out.push_back({LocalPos(u32(cell)), Bytes(nbt.begin(), nbt.end())});
    }
    return true;
}

bool get_ticks(ByteReader& in, const DecodeLimits& limits, std::vector<ScheduledTick>& out) {
    const u64 count = in.get_varint();
    if (count > in.remaining()) return false;
    for (u64 i = 0; i < count && !in.failed(); ++i) {
        const u64 cell = in.get_varint(), due = in.get_varint();
        const i64 priority = in.get_svarint();
        const u64 state = in.get_varint();
        if (cell >= kChunkVolume || priority != i32(priority) || state >= limits.state_count) return false;
        out.push_back({LocalPos(u32(cell)), due, i32(priority), StateId(u32(state))});
    }
    return true;
}

bool get_biomes(ByteReader& in, const DecodeLimits& limits, BiomeGrid& out) {
    u32 at = 0;
    while (at < out.cells.size() && !in.failed()) {
        const u64 id = in.get_varint(), run = in.get_varint();
        if (id >= limits.biome_count || run == 0 || run > out.cells.size() - at) return false;
        for (u64 i = 0; i < run; ++i)
            out.cells[at++] = BiomeId(u16(id));
    }
    return true;
}

void put_section(ByteWriter& body, u32 number, const ByteWriter& section) {
    body.put_varint(number);
    body.put_varint(section.size());
    body.put_raw(const_cast<ByteWriter&>(section).bytes().data(), section.size());
}

} // namespace

Bytes encode_chunk(const Chunk& chunk, u32 parts) {
    Bytes out;
    encode_chunk(chunk, parts, out);
    return out;
}

void encode_chunk(const Chunk& chunk, u32 parts, Bytes& out) {
    Contexts& c = contexts();
    ByteWriter& body = c.body;
    ByteWriter& s = c.section;
    body.bytes().clear();
    auto section = [&](SectionNumber number, u32 part, bool wanted, auto fill) {
        if (!(parts & part) || !wanted) return;
        s.bytes().clear();
        fill();
        put_section(body, number, s);
    };
    section(kRevision, kChunkRevision, chunk.revision != 0, [&] { s.put_varint(chunk.revision); });
    section(kBlocks, kChunkBlocks, true, [&] { put_blocks(s, chunk.blocks); });
    section(kLight, kChunkLight, chunk.light != nullptr, [&] { put_light(s, *chunk.light); });
    section(kBiomes, kChunkBiomes, !(chunk.biomes == BiomeGrid{}), [&] {
        for (u32 i = 0; i < 64;) {
            u32 run = 1;
            while (i + run < 64 && chunk.biomes.cells[i + run] == chunk.biomes.cells[i])
                ++run;
            s.put_varint(u32(chunk.biomes.cells[i]));
            s.put_varint(run);
            i += run;
        }
    });
    section(kBlockEntities, kChunkBlockEntities, !chunk.block_entities.empty(), [&] {
        s.put_varint(chunk.block_entities.size());
        for (const auto& e : chunk.block_entities) {
            s.put_varint(e.at.index);
            s.put_varint(e.nbt.size());
            s.put_bytes(e.nbt);
        }
    });
    section(kTicks, kChunkTicks, !chunk.ticks.empty(), [&] {
        s.put_varint(chunk.ticks.size());
        for (const auto& t : chunk.ticks) {
            s.put_varint(t.at.index);
            s.put_varint(t.due);
            s.put_svarint(t.priority);
            s.put_varint(u32(t.state));
        }
    });
    section(kEntities, kChunkEntities, !chunk.entities.empty(), [&] {
        s.put_varint(chunk.entities.size());
        for (const auto& e : chunk.entities) {
            s.put_varint(e.size());
            s.put_bytes(e);
        }
    });
    const std::size_t start = out.size();
    const std::size_t plain = body.size();
    if (plain > 64) {
        ByteWriter head;
        head.put_u8(kFormat | kZstd << 4);
        head.put_varint(plain);
        out.resize(start + head.size() + ZSTD_compressBound(plain));
        std::copy(head.bytes().begin(), head.bytes().end(), out.begin() + std::ptrdiff_t(start));
        const std::size_t packed = ZSTD_compressCCtx(c.pack, out.data() + start + head.size(),
                                                     out.size() - start - head.size(), body.bytes().data(), plain, 1);
        VX_ASSERT(!ZSTD_isError(packed));
        if (packed + head.size() < plain + 1) {
            out.resize(start + head.size() + packed);
            return;
        }
    }
    out.resize(start);
    out.push_back(kFormat | kPlain << 4);
    out.insert(out.end(), body.bytes().begin(), body.bytes().end());
}

// The body of a record, unpacked into this thread's buffer where it is packed.
static Result<ByteView> unpack_body(ByteView bytes, u32 bytes_most) {
    ByteReader in(bytes);
    const u8 first = in.get_u8();
    if (in.failed()) return fail(ErrorCode::damaged, "chunk record is empty");
    if ((first & 15) != kFormat) return fail(ErrorCode::unsupported, "chunk record of another format");
    if (first >> 4 == kPlain) {
        if (in.remaining() > bytes_most) return fail(ErrorCode::limit, "chunk record is too large");
        return bytes.subspan(1);
    }
    if (first >> 4 != kZstd) return fail(ErrorCode::unsupported, "chunk record packed in an unknown way");
    const u64 size = in.get_varint();
    if (in.failed()) return fail(ErrorCode::damaged, "chunk record ends early");
    if (size > bytes_most) return fail(ErrorCode::limit, "chunk record is too large");
    Contexts& c = contexts();
    c.plain.resize(std::size_t(size));
    const ByteView packed = bytes.subspan(in.position());
    const std::size_t got = ZSTD_decompressDCtx(c.unpack, c.plain.data(), c.plain.size(), packed.data(), packed.size());
    if (ZSTD_isError(got) || got != size) return fail(ErrorCode::damaged, "chunk record does not unpack");
    return ByteView(c.plain);
}

Result<Chunk> decode_chunk(ByteView bytes, const DecodeLimits& limits) {
    VX_TRY_ASSIGN(const ByteView body, unpack_body(bytes, limits.bytes_most));
    ByteReader in(body);
    Chunk chunk;
    while (!in.failed() && in.remaining() > 0) {
        const u64 number = in.get_varint();
        ByteReader s(in.get_bytes(in.get_varint()));
        if (in.failed()) break;
        bool good = true;
        switch (number) {
        case kRevision:
            chunk.revision = s.get_varint();
            break;
        case kBlocks:
            good = get_blocks(s, limits, chunk.blocks);
            break;
        case kLight: {
            auto light = std::make_shared<LightVolume>();
            good = get_light(s, *light);
            chunk.light = std::move(light);
            break;
        }
        case kBiomes:
            good = get_biomes(s, limits, chunk.biomes);
            break;
        case kBlockEntities:
            good = get_block_entities(s, chunk.block_entities);
            break;
        case kTicks:
            good = get_ticks(s, limits, chunk.ticks);
            break;
        case kEntities: {
            const u64 count = s.get_varint();
            good = count <= s.remaining();
            for (u64 i = 0; good && i < count && !s.failed(); ++i) {
                const ByteView nbt = s.get_bytes(s.get_varint());
                chunk.entities.emplace_back(nbt.begin(), nbt.end());
            }
            break;
        }
        default:
            continue; // from a later version
        }
        if (!good || !s.finished()) return fail(ErrorCode::damaged, "chunk record does not parse");
    }
    if (in.failed()) return fail(ErrorCode::damaged, "chunk record does not parse");
    return chunk;
}

Result<u64> decode_chunk_revision(ByteView bytes) {
    VX_TRY_ASSIGN(const ByteView body, unpack_body(bytes, DecodeLimits{}.bytes_most));
    ByteReader in(body);
    while (!in.failed() && in.remaining() > 0) {
        const u64 number = in.get_varint();
        ByteReader s(in.get_bytes(in.get_varint()));
        if (number == kRevision && !in.failed()) {
            const u64 revision = s.get_varint();
            if (!s.finished()) break;
            return revision;
        }
    }
    if (in.remaining() > 0 || in.failed()) return fail(ErrorCode::damaged, "chunk record does not parse");
    return u64(0);
}

} // namespace vitrail
