#include "light/column_solver.h"

#include "light/expand_planes.h"
#include "voxel/cell_mask.h"

#include <algorithm>
#include <cstring>

namespace vitrail {

namespace {

enum Channel : u32 { kSky, kRed, kGreen, kBlue, kChannels };
// Byte lane of each channel in a spread light (packed.h).
constexpr u32 kLane[kChannels] = {0, 16, 8, 24};

struct Source {
    u16 cell;
    u8 level;
};

// A pending chunk while its column is solved. at_least[l]: the cells with level l or more, for the channel in work.
struct Part {
    i32 slot = 0, y = 0;
    Part *below = nullptr, *above = nullptr;     // parts of the same column right below and above
    bool open = false, dark = false;             // all cells see the sky; no cell lets light in
    CellMask passing;                            // cells of cost 1
    std::vector<std::pair<u32, CellMask>> thick; // costs 2..14 and their cells
    CellMask sky;                                // cells that see the sky
    std::vector<Source> sources[kChannels];
    u32 next_source = 0;
    bool changed = false, changes = false;
    std::array<CellMask, 17> at_least;
    std::array<CellMask, 16> slices; // bits of the finished Lights
    u32 lit_channels = 0;
};

std::vector<std::unique_ptr<Part>>& part_pool() {
    static thread_local std::vector<std::unique_ptr<Part>> pool;
    return pool;
}

// Which cells are at or above their column's height.
void mark_open_sky(Part& part, const ColumnHeights& heights) {
    const i32 base = part.y * 16;
    u8 first[256]; // first open layer, 16: none
    i32 lowest = 16, highest = 0;
    for (u32 i = 0; i < 256; ++i) {
        const i64 from = i64(heights.above[i]) - base;
        first[i] = u8(std::clamp<i64>(from, 0, 16));
        lowest = std::min(lowest, i32(first[i]));
        highest = std::max(highest, i32(first[i]));
    }
    part.open = highest == 0;
    if (part.open || lowest == 16) {
        part.sky.fill(part.open ? ~u64(0) : 0);
        return;
    }
    // Each column opens in one layer and stays open above it.
    part.sky.fill(0);
    for (u32 i = 0; i < 256; ++i)
        if (first[i] < 16) part.sky[first[i] * 4u + (i >> 6)] |= u64(1) << (i & 63);
    for (u32 w = 4; w < 64; ++w)
        part.sky[w] |= part.sky[w - 4];
}

void classify(LightField& field, Part& part) {
    const LightField::Slot& s = field.slot(part.slot);
    const auto palette = s.chunk->blocks.palette();
    std::vector<u8> classes(palette.size());
    u32 costs_seen = 0;
    bool emits = false;
    const auto cost = [&](std::size_t p) {
        const u32 o = field.lights()[u32(palette[p])].opacity;
        return o == 0 ? 1 : std::min(o, 15u);
    };
    for (std::size_t p = 0; p < palette.size(); ++p) {
        const u32 c = cost(p);
        costs_seen |= 1u << c;
        const bool lamp = LightField::emission(field.lights()[u32(palette[p])]) != 0;
        emits |= lamp;
        classes[p] = u8((c == 1) | u32(lamp) << 1);
    }
    CellMask found[2];
    classify_cells(s.chunk->blocks, classes.data(), emits ? 2 : 1, found);
    part.passing = found[0];
    part.thick.clear();
    part.dark = costs_seen == 1u << 15;
    for (u32 c = 2; c < 15; ++c) {
        if (!(costs_seen >> c & 1)) continue;
        for (std::size_t p = 0; p < palette.size(); ++p)
            classes[p] = cost(p) == c;
        part.thick.emplace_back(c, CellMask{});
        classify_cells(s.chunk->blocks, classes.data(), 1, &part.thick.back().second);
    }
    for (auto& list : part.sources)
        list.clear();
    if (!emits) return;
    for (u32 w = 0; w < 64; ++w)
        for (u64 rest = found[1][w]; rest; rest &= rest - 1) {
            const u32 cell = w * 64 + u32(__builtin_ctzll(rest));
            const u32 light = field.emission_of(s, cell);
            for (u32 c = kRed; c < kChannels; ++c)
                if (const u32 level = light >> kLane[c] & 15) part.sources[c].push_back({u16(cell), u8(level)});
        }
}

// The cell at (a, b) of a face of the chunk, and its neighbor's index across it.
u32 face_cell(u32 face, u32 i) {
    const u32 a = i & 15, b = i >> 4;
    switch (face) {
    case 0:
        return a << 4 | b << 8;
    case 1:
        return 15 | a << 4 | b << 8;
    case 2:
        return i;
    case 3:
        return 15 << 8 | i;
    case 4:
        return a | b << 8;
    default:
        return a | 15 << 4 | b << 8;
    }
}

// Bits of face_cell order, taken from a mask of the chunk.
void face_bits(const CellMask& m, u32 face, std::array<u64, 4>& out) {
    out.fill(0);
    if (face >= 2 && face <= 3) {
        for (u32 q = 0; q < 4; ++q)
            out[q] = m[(face == 2 ? 0 : 60) + q];
    } else if (face >= 4) {
        for (u32 y = 0; y < 16; ++y)
            out[y >> 2] |= (face == 4 ? m[y * 4] & 0xffff : m[y * 4 + 3] >> 48) << ((y & 3) * 16);
    } else {
        for (u32 w = 0; w < 64; ++w) {
            const u64 v = m[w] >> (face == 0 ? 0 : 15);
            const u64 four = (v & 1) | (v >> 15 & 2) | (v >> 30 & 4) | (v >> 45 & 8);
            out[w >> 4] |= four << ((w & 15) * 4);
        }
    }
}

// The 256 values of a volume along a face, in face_cell order.
void face_values(const LightVolume& volume, u32 face, u16* out) {
    if (volume.uniform()) {
        std::fill_n(out, 256, volume.get(LocalPos()).bits);
        return;
    }
    const Light* cells = volume.cells()->data();
    if (face < 2) {
        for (u32 i = 0; i < 256; ++i)
            out[i] = cells[i << 4 | (face == 0 ? 0 : 15)].bits;
    } else if (face < 4) {
        std::memcpy(out, cells + (face == 2 ? 0 : 3840), 512);
    } else {
        for (u32 y = 0; y < 16; ++y)
            std::memcpy(out + y * 16, cells + y * 256 + (face == 4 ? 0 : 240), 32);
    }
}

// Light of lit chunks around becomes sources in the cells along the border.
void take_inflow(LightField& field, Part& part) {
    if (part.dark) return;
    CellMask below_sky; // cells that let light in and do not see the sky
    CellMask admits = part.passing;
    for (const auto& [cost, cells] : part.thick)
        for (u32 w = 0; w < 64; ++w)
            admits[w] |= cells[w];
    for (u32 w = 0; w < 64; ++w)
        below_sky[w] = admits[w] & ~part.sky[w];
    for (u32 face = 0; face < 6; ++face) {
        const i32 to = field.beside(part.slot, face);
        if (to == LightField::kNone) continue;
        const LightField::Slot& n = field.slot(to);
        if (n.pending) continue;
        const bool uniform = n.now->uniform();
        const u32 all = n.now->get(LocalPos()).bits;
        if (uniform && all == 0) continue;
        const bool sky_only = n.sky_only || (uniform && (all & 0xfff0) == 0);
        if (sky_only && part.open) continue;
        std::array<u64, 4> wanted, unlit;
        face_bits(sky_only ? below_sky : admits, face, wanted);
        if (!(wanted[0] | wanted[1] | wanted[2] | wanted[3])) continue;
        face_bits(below_sky, face, unlit);
        alignas(64) u16 values[256];
        face_values(*n.now, face ^ 1, values);
        for (u32 i = 0; i < 256; ++i) {
            if (i % 64 == 0 && wanted[i / 64] == 0) {
                i += 63;
                continue;
            }
            if (!(wanted[i / 64] >> (i & 63) & 1)) continue;
            u32 bits = values[i];
            if (!(unlit[i / 64] >> (i & 63) & 1)) bits &= 0xfff0; // open to the sky already
            if (bits == 0) continue;
            const u32 cell = face_cell(face, i);
            const u32 level = lanes_less(spread_light(Light(u16(bits))), field.cost_of(field.slot(part.slot), cell));
            for (u32 c = 0; c < kChannels; ++c)
                if (const u32 l = level >> kLane[c] & 15) part.sources[c].push_back({u16(cell), u8(l)});
        }
    }
}

// The cells beside any set cell, in the chunk and across its top and bottom.
void dilate(const CellMask& m, const CellMask* below, const CellMask* above, CellMask& out) {
    for (u32 y = 0; y < 16; ++y) {
        const u64* row = &m[y * 4];
        const u64* down = y ? row - 4 : below ? &(*below)[60] : nullptr;
        const u64* up = y < 15 ? row + 4 : above ? &(*above)[0] : nullptr;
        u64* to = &out[y * 4];
        for (u32 q = 0; q < 4; ++q) {
            const u64 w = row[q];
            to[q] = (w & ~kRowHigh) << 1 | (w & ~kRowLow) >> 1 | w << 16 | w >> 16;
        }
        to[0] |= row[1] << 48;
        to[1] |= row[0] >> 48 | row[2] << 48;
        to[2] |= row[1] >> 48 | row[3] << 48;
        to[3] |= row[2] >> 48;
        if (down)
            for (u32 q = 0; q < 4; ++q)
                to[q] |= down[q];
        if (up)
            for (u32 q = 0; q < 4; ++q)
                to[q] |= up[q];
    }
}

bool differ(const CellMask& a, const CellMask& b) {
    u64 d = 0;
    for (u32 w = 0; w < 64; ++w)
        d |= a[w] ^ b[w];
    return d != 0;
}

void step_level(Part& part, u32 channel, u32 level) {
    CellMask& now = part.at_least[level];
    const CellMask& higher = part.at_least[level + 1];
    auto& sources = part.sources[channel];
    const bool has_source = part.next_source < sources.size() && sources[part.next_source].level == level;
    const bool grows = part.changed || (part.below && part.below->changed) || (part.above && part.above->changed);
    part.changes = false;
    now = higher;
    if (!grows && !has_source && part.thick.empty()) return;
    CellMask reach;
    if (grows && !part.dark) {
        dilate(higher, part.below ? &part.below->at_least[level + 1] : nullptr,
               part.above ? &part.above->at_least[level + 1] : nullptr, reach);
        for (u32 w = 0; w < 64; ++w)
            now[w] |= reach[w] & part.passing[w];
    }
    for (const auto& [cost, cells] : part.thick) {
        if (level + cost > 15) continue;
        dilate(part.at_least[level + cost], part.below ? &part.below->at_least[level + cost] : nullptr,
               part.above ? &part.above->at_least[level + cost] : nullptr, reach);
        for (u32 w = 0; w < 64; ++w)
            now[w] |= reach[w] & cells[w];
    }
    for (; part.next_source < sources.size() && sources[part.next_source].level == level; ++part.next_source) {
        const u32 cell = sources[part.next_source].cell;
        now[cell >> 6] |= u64(1) << (cell & 63);
    }
    part.changes = differ(now, higher);
}

// The four bits of each cell's level, from its thermometer code.
void slice_levels(Part& part, u32 channel) {
    const auto& s = part.at_least;
    CellMask* out = &part.slices[channel * 4];
    for (u32 w = 0; w < 64; ++w) {
        u64 bit0 = 0, bit1 = 0, bit2 = 0;
        for (u32 l = 1; l <= 15; l += 2)
            bit0 |= s[l][w] & ~s[l + 1][w];
        for (u32 l = 2; l <= 14; l += 4)
            bit1 |= s[l][w] & ~s[std::min(l + 2, 16u)][w];
        bit2 = (s[4][w] & ~s[8][w]) | s[12][w];
        out[0][w] = bit0;
        out[1][w] = bit1;
        out[2][w] = bit2;
        out[3][w] = s[8][w];
    }
    part.lit_channels |= 1u << channel;
}

void solve_channel(std::span<Part*> parts, u32 channel) {
    bool any = false;
    for (Part* p : parts) {
        auto& sources = p->sources[channel];
        std::sort(sources.begin(), sources.end(), [](Source a, Source b) { return a.level > b.level; });
        any |= !sources.empty() || (channel == kSky && any_cell(p->sky));
    }
    if (!any) return;
    for (Part* p : parts) {
        p->at_least[16].fill(0);
        p->next_source = 0;
        if (channel == kSky)
            p->at_least[15] = p->sky;
        else
            p->at_least[15].fill(0);
        auto& sources = p->sources[channel];
        for (; p->next_source < sources.size() && sources[p->next_source].level == 15; ++p->next_source) {
            const u32 cell = sources[p->next_source].cell;
            p->at_least[15][cell >> 6] |= u64(1) << (cell & 63);
        }
        p->changed = any_cell(p->at_least[15]);
    }
    for (u32 level = 14; level >= 1; --level) {
        for (Part* p : parts) {
            if (channel == kSky && p->open) {
                p->at_least[level] = p->at_least[15];
                p->changes = false;
                continue;
            }
            step_level(*p, channel, level);
        }
        for (Part* p : parts)
            p->changed = p->changes;
    }
    for (Part* p : parts)
        if (any_cell(p->at_least[1])) slice_levels(*p, channel);
}

std::shared_ptr<LightVolume> volume_of(const Part& part) {
    if (part.lit_channels == 0) return std::make_shared<LightVolume>();
    if (part.lit_channels == 1u << kSky && part.open) return std::make_shared<LightVolume>(Light(15, 0, 0, 0));
    auto volume = std::make_shared<LightVolume>();
    auto& cells = volume->writable();
    expand_planes(part.slices, part.lit_channels, cells);
    return volume;
}

// Cells along the border whose light is worth a look from outside.
void find_outflow(LightField& field, const Part& part) {
    for (u32 face = 0; face < 6; ++face) {
        if ((face == 2 && part.below) || (face == 3 && part.above)) continue; // solved together
        const i32 to = field.beside(part.slot, face);
        if (to == LightField::kNone) continue;
        const LightField::Slot &s = field.slot(part.slot), &n = field.slot(to);
        if (n.pending) continue;
        if (s.now->uniform() && s.now->get(LocalPos()).bits == 0) continue;
        if (s.now->uniform() && n.now->uniform() && s.now->get(LocalPos()) == n.now->get(LocalPos())) continue;
        alignas(64) u16 own[256], other[256], flows[256];
        face_values(*s.now, face, own);
        face_values(*n.now, face ^ 1, other);
        u32 any = 0;
        for (u32 i = 0; i < 256; ++i) { // a level at least two below, in any channel
            const u32 a = own[i], b = other[i];
            flows[i] = u16(((a & 15) > (b & 15) + 1) | ((a & 0xf0) > (b & 0xf0) + 0x10) |
                           ((a & 0xf00) > (b & 0xf00) + 0x100) | ((a >> 12) > (b >> 12) + 1));
            any |= flows[i];
        }
        if (!any) continue;
        for (u32 i = 0; i < 256; ++i) {
            if (!flows[i]) continue;
            const u32 cell = face_cell(face, i);
            bool crosses;
            const u32 cost = field.cost_of(n, step_index(cell, face, crosses));
            if (lanes_minus(lanes_less(spread_light(Light(own[i])), cost), spread_light(Light(other[i]))))
                field.rising.push_back(u32(part.slot) << 12 | cell);
        }
    }
}

} // namespace

void solve_column(LightField& field, std::span<const i32> slots, const ColumnHeights& heights) {
    auto& pool = part_pool();
    while (pool.size() < slots.size())
        pool.push_back(std::make_unique<Part>());
    std::vector<Part*> parts;
    for (std::size_t i = 0; i < slots.size(); ++i) {
        Part& part = *pool[i];
        part.slot = slots[i];
        part.y = field.slot(slots[i]).at.y;
        part.below = part.above = nullptr;
        part.lit_channels = 0;
        parts.push_back(&part);
    }
    std::sort(parts.begin(), parts.end(), [](Part* a, Part* b) { return a->y < b->y; });
    for (std::size_t i = 0; i + 1 < parts.size(); ++i)
        if (parts[i]->y + 1 == parts[i + 1]->y) {
            parts[i]->above = parts[i + 1];
            parts[i + 1]->below = parts[i];
        }
    const bool has_sky = field.dimension().info().has_sky;
    for (Part* p : parts) {
        if (has_sky) {
            mark_open_sky(*p, heights);
        } else {
            p->sky.fill(0);
            p->open = false;
        }
        classify(field, *p);
        take_inflow(field, *p);
    }
    for (u32 c = 0; c < kChannels; ++c)
        solve_channel(parts, c);
    for (Part* p : parts) {
        field.light_up(p->slot, volume_of(*p));
        field.slot(p->slot).sky_only = (p->lit_channels & ~(1u << kSky)) == 0;
    }
    for (Part* p : parts)
        find_outflow(field, *p);
}

} // namespace vitrail
