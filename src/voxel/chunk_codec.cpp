#include "voxel/chunk_codec.h"

#include "base/assert.h"

#include <algorithm>
#include <array>
#include <memory>
#include <zstd.h>

namespace vitrail {

namespace {

constexpr u8 kFormat = 1;
// Shorter bodies (uniform chunks) do not shrink.
constexpr std::size_t kPackFrom = 64;
// Low four bits of the first byte: format; high four: how the rest is packed.
enum Packing : u8 { kPlain = 0, kZstd = 1 };
enum SectionNumber : u32 { kBlocks = 1, kLight, kBiomes, kBlockEntities, kTicks, kEntities, kRevision };

// A thread's own, so that no call allocates them: zstd's are 100 KB and slow to make.
struct Contexts {
    ZSTD_CCtx* pack = ZSTD_createCCtx();
    ZSTD_DCtx* unpack = ZSTD_createDCtx();
    ByteWriter body, section;
    Bytes plain;
    std::array<u16, kChunkVolume> indices, values;
    std::vector<u16> slot_of = std::vector<u16>(65536, kNoSlot); // of a light value in the palette being made
    static constexpr u16 kNoSlot = 0xffff;

    Contexts() {
        ZSTD_CCtx_setParameter(pack, ZSTD_c_compressionLevel, 1);
        ZSTD_CCtx_setParameter(pack, ZSTD_c_contentSizeFlag, 0); // our own head has it
    }
    ~Contexts() {
        ZSTD_freeCCtx(pack);
        ZSTD_freeDCtx(unpack);
    }
};

Contexts& contexts() {
    thread_local Contexts c;
    return c;
}

// 4096 indices, `bits` each (0, 1, 2, 4, 8), low bits first: the words of a BlockStorage as bytes.
template <unsigned Bits>
void pack_bytes(std::span<const u16, kChunkVolume> indices, u8* to) {
    constexpr u32 in_byte = 8 / Bits;
    for (u32 at = 0; at < kChunkVolume / in_byte; ++at) {
        u32 byte = 0;
        for (u32 i = 0; i < in_byte; ++i)
            byte |= u32(indices[at * in_byte + i]) << (i * Bits);
        to[at] = u8(byte);
    }
}

void put_packed(ByteWriter& out, std::span<const u16, kChunkVolume> indices, unsigned bits) {
    const std::size_t start = out.size();
    out.bytes().resize(start + bits * 512);
    u8* to = out.bytes().data() + start;
    switch (bits) {
    case 0:
        return;
    case 1:
        return pack_bytes<1>(indices, to);
    case 2:
        return pack_bytes<2>(indices, to);
    case 4:
        return pack_bytes<4>(indices, to);
    default:
        VX_ASSERT(bits == 8);
        return pack_bytes<8>(indices, to);
    }
}

// Whether all indices in `packed` are below `count`.
template <unsigned Bits>
bool fields_below(ByteView packed, u32 count) {
    u8 most = 0;
    for (u8 byte : packed)
        for (unsigned shift = 0; shift < 8; shift += Bits)
            most = std::max(most, u8(byte >> shift & ((1u << Bits) - 1)));
    return most < count;
}

bool indices_below(ByteView packed, unsigned bits, u32 count) {
    if (count == 1u << bits) return true;
    switch (bits) {
    case 2:
        return fields_below<2>(packed, count);
    case 4:
        return fields_below<4>(packed, count);
    case 8:
        return fields_below<8>(packed, count);
    case 16: {
        u16 most = 0, index;
        for (std::size_t i = 0; i < packed.size(); i += 2) {
            std::memcpy(&index, packed.data() + i, 2);
            most = std::max(most, index);
        }
        return most < count;
    }
    default:
        return true; // 0 and 1 bits: count is always 1 or 2
    }
}

// Palette entries in order of first appearance, all of them used: then equal chunks have equal records.
bool in_first_use_order(const BlockStorage& blocks) {
    const unsigned bits = blocks.bits();
    const u64 mask = (u64(1) << bits) - 1;
    const u64 count = blocks.palette().size();
    u64 next = 0, last = ~blocks.words()[0];
    for (u64 word : blocks.words()) {
        if (word == last) continue; // most rows repeat
        last = word;
        for (unsigned shift = 0; shift < 64; shift += bits) {
            const u64 index = word >> shift & mask;
            if (index < next) continue;
            if (index > next) return false;
            if (++next == count) return true;
        }
    }
    return false;
}

void put_blocks(ByteWriter& out, const BlockStorage& blocks) {
    if (blocks.uniform()) {
        out.put_varint(1);
        return out.put_varint(u32(blocks.palette()[0]));
    }
    const bool ready = in_first_use_order(blocks);
    BlockStorage tidy;
    if (!ready) {
        tidy = blocks;
        tidy.compact();
    }
    const BlockStorage& b = ready ? blocks : tidy;
    out.put_varint(b.palette().size());
    for (StateId id : b.palette())
        out.put_varint(u32(id));
    out.put_raw(b.words().data(), b.words().size_bytes());
}

// Light goes through a palette like blocks: it has few different values a chunk, and zstd finds repeated rows in four
// bits a cell where it does not in sixteen. More than 256 values: palette length 0 and the cells as they are.
void put_light(ByteWriter& out, const LightVolume& light) {
    const auto* cells = light.cells();
    if (!cells) {
        out.put_varint(1);
        return out.put_varint(light.get(LocalPos()).bits);
    }
    Contexts& c = contexts();
    u32 count = 0;
    u16 last = u16(~(*cells)[0].bits), slot = 0;
    for (u32 i = 0; i < kChunkVolume && count <= 256; ++i) {
        const u16 value = (*cells)[i].bits;
        if (value != last) {
            last = value;
            u16& known = c.slot_of[value];
            if (known == Contexts::kNoSlot) {
                known = u16(count);
                c.values[count++] = value;
            }
            slot = known;
        }
        c.indices[i] = slot;
    }
    for (u32 i = 0; i < count; ++i)
        c.slot_of[c.values[i]] = Contexts::kNoSlot;
    if (count > 256) {
        out.put_varint(0);
        return out.put_raw(cells->data(), sizeof *cells);
    }
    out.put_varint(count);
    for (u32 i = 0; i < count; ++i)
        out.put_varint(c.values[i]);
    put_packed(out, c.indices, bits_for_palette(count));
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
    if (in.failed() || !indices_below(packed, bits, u32(count))) return false;
    std::vector<u64> words(std::size_t(bits) * 64);
    if (bits > 0) std::memcpy(words.data(), packed.data(), packed.size());
    blocks = BlockStorage::from_packed(std::move(palette), std::move(words));
    return true;
}

template <unsigned Bits>
void unpack_light(ByteView packed, const std::array<u16, 256>& values, LightVolume::Cells& cells) {
    constexpr u32 in_byte = 8 / Bits;
    for (u32 i = 0; i < kChunkVolume / in_byte; ++i)
        for (u32 k = 0; k < in_byte; ++k)
            cells[i * in_byte + k] = Light(values[packed[i] >> (k * Bits) & ((1u << Bits) - 1)]);
}

bool get_light(ByteReader& in, LightVolume& light) {
    const u64 count = in.get_varint();
    if (count == 0) {
        const ByteView raw = in.get_bytes(sizeof(LightVolume::Cells));
        if (in.failed()) return false;
        std::memcpy(light.writable().data(), raw.data(), raw.size());
        return true;
    }
    if (count > 256 || count > in.remaining()) return false;
    std::array<u16, 256> values{}; // all 256, so that no index can lie outside
    for (u64 i = 0; i < count; ++i) {
        const u64 value = in.get_varint();
        if (value > 0xffff) return false;
        values[i] = u16(value);
    }
    if (count == 1) {
        light = LightVolume(Light(values[0]));
        return !in.failed();
    }
    const unsigned bits = bits_for_palette(count);
    const ByteView packed = in.get_bytes(bits * 512);
    if (in.failed() || !indices_below(packed, bits, u32(count))) return false;
    auto& cells = light.writable();
    switch (bits) {
    case 1:
        unpack_light<1>(packed, values, cells);
        break;
    case 2:
        unpack_light<2>(packed, values, cells);
        break;
    case 4:
        unpack_light<4>(packed, values, cells);
        break;
    default:
        unpack_light<8>(packed, values, cells);
        break;
    }
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

// Runs of equal biomes over the lowest layer of 4 x 4, and over the other three only where they differ from it.
void put_biomes(ByteWriter& out, const BiomeGrid& biomes) {
    const auto& cells = biomes.cells;
    const bool alike = std::equal(cells.begin(), cells.begin() + 48, cells.begin() + 16);
    const u32 size = alike ? 16 : 64;
    out.put_u8(u8(size / 16));
    for (u32 i = 0; i < size;) {
        u32 run = 1;
        while (i + run < size && cells[i + run] == cells[i])
            ++run;
        out.put_varint(u32(cells[i]));
        out.put_varint(run);
        i += run;
    }
}

bool get_biomes(ByteReader& in, const DecodeLimits& limits, BiomeGrid& out) {
    const u32 layers = in.get_u8();
    if (layers != 1 && layers != 4) return false;
    const u32 size = layers * 16;
    for (u32 at = 0; at < size && !in.failed();) {
        const u64 id = in.get_varint(), run = in.get_varint();
        if (id >= limits.biome_count || id > 0xffff || run == 0 || run > size - at) return false;
        for (u64 i = 0; i < run; ++i)
            out.cells[at++] = BiomeId(u16(id));
    }
    for (u32 i = size; i < 64; ++i)
        out.cells[i] = out.cells[i - 16];
    return true;
}

void put_section(ByteWriter& body, u32 number, ByteWriter& section) {
    body.put_varint(number);
    body.put_varint(section.size());
    body.put_bytes(section.bytes());
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
    section(kBiomes, kChunkBiomes, !(chunk.biomes == BiomeGrid{}), [&] { put_biomes(s, chunk.biomes); });
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
    if (plain > kPackFrom) {
        ByteWriter head;
        head.put_u8(kFormat | kZstd << 4);
        head.put_varint(plain);
        out.resize(start + head.size() + ZSTD_compressBound(plain));
        std::copy(head.bytes().begin(), head.bytes().end(), out.begin() + std::ptrdiff_t(start));
        const std::size_t packed = ZSTD_compress2(c.pack, out.data() + start + head.size(),
                                                  out.size() - start - head.size(), body.bytes().data(), plain);
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
