#include "formats/anvil.h"

#include "formats/legacy_ids.h"
#include "formats/mcregion.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <fmt/format.h>

namespace vitrail {

namespace {

using nbt::Tag;
using nbt::Type;

constexpr i32 kLeastSection = -2048, kMostSection = 2047; // far beyond any data pack's height

std::string_view chars_of(ByteView b) {
    return {reinterpret_cast<const char*>(b.data()), b.size()};
}

u64 word_at(const u8* words, std::size_t i) {
    u64 v;
    std::memcpy(&v, words + i * 8, 8);
    return __builtin_bswap64(v);
}

// Words of `cells` cells of `bits` bits that never straddle.
std::size_t padded_words(std::size_t cells, unsigned bits) {
    const std::size_t per_word = 64 / bits;
    return (cells + per_word - 1) / per_word;
}

void unpack_padded(const u8* words, std::size_t cells, unsigned bits, u16* out) {
    const u64 mask = (u64(1) << bits) - 1;
    const std::size_t per_word = 64 / bits;
    std::size_t cell = 0;
    for (std::size_t w = 0; cell < cells; ++w) {
        u64 word = word_at(words, w);
        const std::size_t n = std::min(per_word, cells - cell);
        for (std::size_t i = 0; i < n; ++i, word >>= bits)
            out[cell++] = u16(word & mask);
    }
}

void unpack_straddling(const u8* words, unsigned bits, u16* out) {
    const u64 mask = (u64(1) << bits) - 1;
    for (u32 cell = 0; cell < kChunkVolume; ++cell) {
        const u32 bit = cell * bits, shift = bit & 63;
        u64 v = word_at(words, bit >> 6) >> shift;
        if (shift + bits > 64) v |= word_at(words, (bit >> 6) + 1) << (64 - shift);
        out[cell] = u16(v & mask);
    }
}

} // namespace

bool unpack_indices(ByteView words, std::size_t entries, i32 data_version, std::vector<u16>& out, u32& bad) {
    const std::size_t n = words.size() / 8;
    // Minecraft uses 4 bits or more; some editors write fewer.
    const unsigned needed = std::max(1u, unsigned(std::bit_width(entries > 0 ? entries - 1 : 0)));
    const bool padded_first = data_version >= kPaddedIndicesVersion;
    unsigned bits = 0;
    bool padded = padded_first;
    // Lengths decide; the version breaks ties. Wider cells than the palette needs occur in edited worlds.
    for (unsigned b = needed; b <= 16 && bits == 0; ++b) {
        const bool fits_padded = n == padded_words(kChunkVolume, b), fits_straddling = n == std::size_t(b) * 64;
        if (!fits_padded && !fits_straddling) continue;
        bits = b;
        padded = fits_padded && (padded_first || !fits_straddling);
    }
    if (bits == 0) return false;
    out.resize(kChunkVolume);
    if (padded)
        unpack_padded(words.data(), kChunkVolume, bits, out.data());
    else
        unpack_straddling(words.data(), bits, out.data());
    if (entries < (std::size_t(1) << bits))
        for (u16& index : out)
            if (index >= entries) index = 0, ++bad;
    return true;
}

void block_state_text(const Tag& entry, std::string& out) {
    out.clear();
    if (entry.is(Type::string)) { // a bare name
        out = entry.text();
        return;
    }
    const Tag name = entry["Name"];
    if (!name.is(Type::string)) return;
    out = name.text();
    const Tag properties = entry["Properties"];
    std::array<std::pair<std::string_view, std::string_view>, 32> list;
    std::size_t n = 0;
    for (Tag p : properties)
        if (p.is(Type::string) && n < list.size()) list[n++] = {p.name(), p.text()};
    if (n == 0) return;
    std::sort(list.begin(), list.begin() + std::ptrdiff_t(n));
    for (std::size_t i = 0; i < n; ++i) {
        out += i == 0 ? '[' : ',';
        out += list[i].first;
        out += '=';
        out += list[i].second;
    }
    out += ']';
}

void set_legacy_blocks(const LegacyCode* codes, DecodeContext& context, RawSection& out) {
    auto& slots = context.slot_of_code;
    if (slots.empty()) slots.assign(65536, 0xffff);
    out.legacy = true;
    out.palette.clear();
    out.indices.resize(kChunkVolume);
    for (u32 i = 0; i < u32(kChunkVolume); ++i) {
        u16& slot = slots[codes[i]];
        if (slot == 0xffff) {
            slot = u16(out.palette.size());
            out.palette.push_back(codes[i]);
        }
        out.indices[i] = slot;
    }
    for (u32 code : out.palette)
        slots[code] = 0xffff;
    if (out.palette.size() == 1) out.indices.clear();
}

namespace {

// Sections of 1.2 to 1.12: Blocks, Data, perhaps Add.
bool decode_numeric_section(const Tag& tag, DecodeContext& context, RawColumn& column, RawSection& out) {
    const ByteView blocks = tag["Blocks"].bytes(), data = tag["Data"].bytes(), add = tag["Add"].bytes();
    if (blocks.size() != kChunkVolume) {
        column.problems.push_back(
            fmt::format("section {}: block array holds {} bytes instead of 4096", out.y, blocks.size()));
        return false;
    }
    const bool has_data = data.size() == kChunkVolume / 2, has_add = add.size() == kChunkVolume / 2;
    if (!has_data) column.problems.push_back(fmt::format("section {}: block data is missing, taken as 0", out.y));
    LegacyCode codes[kChunkVolume];
    for (u32 i = 0; i < u32(kChunkVolume); ++i) {
        const u32 shift = (i & 1) * 4;
        const u32 meta = has_data ? data[i >> 1] >> shift & 15u : 0, high = has_add ? add[i >> 1] >> shift & 15u : 0;
        codes[i] = LegacyCode(high << 12 | blocks[i] << 4 | meta);
    }
    set_legacy_blocks(codes, context, out);
    return true;
}

u32 intern_state(const Tag& entry, DecodeContext& context) {
    const std::string_view raw = chars_of(entry.payload());
    if (u32* known = context.names.find_alias(raw)) return *known;
    block_state_text(entry, context.text);
    if (context.text.empty()) return ~0u;
    const u32 number = context.names.intern(context.text);
    context.names.add_alias(raw, number);
    return number;
}

bool decode_palette_section(const Tag& palette, const Tag& data, DecodeContext& context, RawColumn& column,
                            RawSection& out) {
    if (palette.size() == 0 || palette.size() > kChunkVolume || !palette.complete()) {
        column.problems.push_back(fmt::format("section {}: palette of {} entries", out.y, palette.size()));
        return false;
    }
    for (Tag entry : palette) {
        const u32 number = intern_state(entry, context);
        if (number == ~0u) {
            column.problems.push_back(fmt::format("section {}: palette entry without a name", out.y));
            return false;
        }
        out.palette.push_back(number);
    }
    const ByteView words = data.longs();
    if (words.empty() && out.palette.size() == 1) return true; // all the same
    u32 bad = 0;
    if (!unpack_indices(words, out.palette.size(), column.data_version, out.indices, bad)) {
        column.problems.push_back(fmt::format("section {}: {} words of block indices fit no packing of {} states",
                                              out.y, words.size() / 8, out.palette.size()));
        return false;
    }
    if (bad > 0) column.problems.push_back(fmt::format("section {}: {} blocks point beyond the palette", out.y, bad));
    if (out.palette.size() == 1) out.indices.clear();
    return true;
}

// 1.18 on: 64 cells, a palette of names, words padded, 0 or more bits.
void decode_biome_container(const Tag& biomes, DecodeContext& context, RawColumn& column, RawSection& out) {
    const Tag palette = biomes["palette"];
    const std::size_t entries = palette.size();
    if (entries == 0 || entries > 64 || palette.element_type() != Type::string) return;
    std::array<u32, 64> numbers{};
    std::size_t n = 0;
    for (Tag entry : palette)
        numbers[n++] = context.names.intern(entry.text());
    out.biomes.fill(numbers[0]);
    const ByteView words = biomes["data"].longs();
    if (n > 1) {
        const unsigned bits = unsigned(std::bit_width(n - 1));
        if (words.size() / 8 != padded_words(64, bits)) {
            column.problems.push_back(fmt::format("section {}: biome indices fit no packing", out.y));
        } else {
            u16 indices[64];
            unpack_padded(words.data(), 64, bits, indices);
            for (u32 i = 0; i < 64; ++i)
                out.biomes[i] = numbers[indices[i] < n ? indices[i] : 0];
        }
    }
    out.has_biomes = true;
}

// Numeric biomes: 256 bytes or ints, one a block column, or 16 ints a level of 4 blocks.
void decode_numeric_biomes(const Tag& tag, i32 least_section, DecodeContext& context, RawColumn& out) {
    const std::size_t n = tag.size();
    if ((!tag.is(Type::byte_array) && !tag.is(Type::int_array)) || n < 256 || n > 65536) return;
    auto number = [&](std::size_t i) {
        const u32 id = tag.is(Type::byte_array) ? u32(tag.bytes()[i]) : u32(tag.integer_at(i));
        return context.names.intern(legacy_biome_name(id));
    };
    if (n == 256) {
        // One grid cell stands for 4 x 4 block columns: the one at its middle speaks, as in Minecraft's own upgrade.
        for (std::size_t z = 0; z < 4; ++z)
            for (std::size_t x = 0; x < 4; ++x)
                out.level_biomes.push_back(number((z * 4 + 2) * 16 + x * 4 + 2));
    } else {
        out.biome_min_y = n == 1024 ? 0 : least_section * 16;
        for (std::size_t i = 0; i < n / 16 * 16; ++i)
            out.level_biomes.push_back(number(i));
    }
}

i32 clamped(i64 v) {
    return i32(std::clamp<i64>(v, -kWorldEdge, kWorldEdge - 1));
}

void decode_block_entities(const Tag& list, bool legacy, RawColumn& out) {
    for (Tag tag : list) {
        if (!tag.is(Type::compound) || !tag.complete()) continue;
        RawBlockEntity e;
        e.at = {clamped(tag["x"].integer()), clamped(tag["y"].integer()), clamped(tag["z"].integer())};
        if (e.at.x >> 4 != out.at.x || e.at.z >> 4 != out.at.z) {
            // Copied chunks keep the old place in their block entities; the low bits still tell the cell.
            if (out.problems.size() < 32)
                out.problems.push_back(fmt::format("block entity {} lies in another chunk", tag["id"].text()));
            e.at.x = out.at.x * 16 + (e.at.x & 15), e.at.z = out.at.z * 16 + (e.at.z & 15);
        }
        if (legacy) e.legacy_bits = legacy_bits_of_block_entity(tag);
        e.nbt = nbt::document_of(tag);
        out.block_entities.push_back(std::move(e));
    }
}

void decode_entity_list(const Tag& list, RawColumn& out) {
    for (Tag tag : list) {
        if (!tag.is(Type::compound) || !tag.complete()) continue;
        const double y = tag["Pos"].number_at(1);
        out.entities.push_back({y > -1e6 && y < 1e6 ? i32(std::floor(y)) : 0, nbt::document_of(tag)});
    }
}

void decode_ticks(const Tag& list, RawColumn& out) {
    for (Tag tag : list) {
        if (!tag.is(Type::compound)) continue;
        RawTick t;
        t.at = {clamped(tag["x"].integer()), clamped(tag["y"].integer()), clamped(tag["z"].integer())};
        if (t.at.x >> 4 != out.at.x || t.at.z >> 4 != out.at.z) continue;
        t.delay = clamped(tag["t"].integer());
        t.priority = clamped(tag["p"].integer());
        out.ticks.push_back(t);
    }
}

} // namespace

Result<> decode_chunk(const Tag& root, ColumnPos at, DecodeContext& context, RawColumn& out) {
    out.clear();
    out.at = at;
    out.data_version = i32(std::clamp<i64>(root["DataVersion"].integer(), 0, 1 << 24));
    const Tag level = root["Level"];
    const Tag body = level.is(Type::compound) ? level : root;
    const Tag sections = body.has("sections") ? body["sections"] : body["Sections"];
    const bool mcregion = is_mcregion_level(body);
    if (!mcregion && !sections && !body.has("xPos") && !body.has("Status"))
        return fail(ErrorCode::damaged, "this NBT is no chunk");
    if (body.has("xPos") && body.has("zPos"))
        out.position_disagrees = body["xPos"].integer() != at.x || body["zPos"].integer() != at.z;
    const std::string_view status = body["Status"].text();
    out.status = status.substr(status.find(':') == status.npos ? 0 : status.find(':') + 1);

    bool legacy = mcregion;
    i32 least_section = 0;
    if (mcregion) {
        decode_mcregion_blocks(body, context, out);
    } else {
        for (Tag tag : sections) {
            const i64 y = tag.has("Y") ? tag["Y"].integer() : i64(INT32_MAX);
            const Tag states = tag["block_states"], blocks = tag["Blocks"], palette = tag["Palette"];
            if (!states && !blocks && !palette) continue; // light only
            if (y < kLeastSection || y > kMostSection || out.section_at(i32(y))) {
                out.problems.push_back(
                    fmt::format("section {}: {}", y, y == INT32_MAX ? "no height" : "wrong or doubled height"));
                ++out.sections_skipped;
                continue;
            }
            RawSection& section = out.add_section();
            section.y = i32(y);
            least_section = std::min(least_section, section.y);
            bool ok;
            if (states)
                ok = decode_palette_section(states["palette"], states["data"], context, out, section);
            else if (palette)
                ok = decode_palette_section(palette, tag["BlockStates"], context, out, section);
            else
                ok = legacy = decode_numeric_section(tag, context, out, section);
            if (!ok) {
                out.sections.pop_back();
                ++out.sections_skipped;
                continue;
            }
            if (!context.blocks_only && tag.has("biomes")) decode_biome_container(tag["biomes"], context, out, section);
        }
    }
    if (context.blocks_only) return {};
    if (const Tag biomes = body["Biomes"]) decode_numeric_biomes(biomes, least_section, context, out);
    decode_block_entities(body.has("block_entities") ? body["block_entities"] : body["TileEntities"], legacy, out);
    decode_entity_list(body.has("entities") ? body["entities"] : body["Entities"], out);
    for (const char* list : {"TileTicks", "LiquidTicks", "block_ticks", "fluid_ticks"})
        decode_ticks(body[list], out);
    return {};
}

void decode_entities(const Tag& root, RawColumn& out) {
    decode_entity_list(root["Entities"], out);
}

} // namespace vitrail
