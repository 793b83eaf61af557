#include "formats/legacy_connect.h"

#include <algorithm>
#include <unordered_map>

namespace vitrail {

LegacyView::LegacyView(const std::array<const RawColumn*, 9>& columns)
    : middle_(columns[4]) {
    for (std::size_t i = 0; i < 9; ++i) {
        if (!columns[i]) continue;
        for (const RawSection& s : columns[i]->sections)
            if (s.legacy && s.y >= 0 && s.y < kSections) sections_[i][std::size_t(s.y)] = &s;
    }
}

LegacyCode LegacyView::at(i32 x, i32 y, i32 z) const {
    if (y < 0 || y >= kSections * 16) return 0;
    const std::size_t column = std::size_t(((z >> 4) + 1) * 3 + (x >> 4) + 1);
    const RawSection* section = sections_[column][std::size_t(y >> 4)];
    return section ? LegacyCode(section->entry_at(LocalPos(x & 15, y & 15, z & 15).index)) : LegacyCode(0);
}

namespace {

// What a number takes part in.
enum Class : u16 {
    kFull = 1,  // opaque full cube: fences, panes and walls join it
    kGourd = 2, // full, but fences do not join it
    kFence = 4,
    kPane = 8,
    kGlass = 16,
    kStairs = 32,
    kGate = 64,
    kDoor = 128,
    kWireEnd = 256, // a wire beside it joins it
    kBurns = 512,
    kAsks = 1024, // its own state follows from neighbors
    kTold = 2048, // its own state follows from its block entity
};

struct Classes {
    std::array<u16, 4096> of{};
    constexpr Classes() {
        auto add = [this](u16 bits, std::initializer_list<int> ids) {
            for (int id : ids)
                of[std::size_t(id)] |= bits;
        };
        auto range = [this](u16 bits, int first, int last) {
            for (int id = first; id <= last; ++id)
                of[std::size_t(id)] |= bits;
        };
        add(kFull, {1,   2,   3,   4,   5,   7,   12,  13,  14,  15,  16,  17,  19,  21,  22,  23,  24,  25,  35,  41,
                    42,  43,  45,  47,  48,  49,  56,  57,  58,  61,  62,  73,  74,  80,  82,  84,  86,  87,  88,  91,
                    97,  98,  99,  100, 103, 110, 112, 121, 123, 124, 125, 129, 133, 137, 152, 153, 155, 158, 159, 162,
                    168, 170, 172, 173, 174, 179, 181, 201, 202, 204, 206, 210, 211, 213, 214, 215, 216, 218, 255});
        range(kFull, 235, 252);
        add(kGourd, {86, 91, 103});
        add(kFence | kAsks, {85, 113, 188, 189, 190, 191, 192});
        add(kPane | kAsks, {101, 102, 160});
        add(kGlass, {20, 95});
        add(kStairs | kAsks, {53, 67, 108, 109, 114, 128, 134, 135, 136, 156, 163, 164, 180, 203});
        add(kGate | kAsks, {107, 183, 184, 185, 186, 187});
        add(kDoor | kAsks, {64, 71, 193, 194, 195, 196, 197});
        add(kWireEnd, {28, 55, 69, 70, 72, 75, 76, 77, 131, 143, 146, 147, 148, 149, 150, 151, 152, 178});
        add(kBurns, {5,   17,  18,  31,  32,  35,  37,  38,  46,  47,  53,  85,  106, 107, 125, 126, 134, 135, 136,
                     161, 162, 163, 164, 170, 171, 173, 175, 183, 184, 185, 186, 187, 188, 189, 190, 191, 192});
        add(kAsks, {2, 3, 51, 54, 55, 90, 93, 94, 104, 105, 106, 110, 132, 139, 146, 175, 199});
        add(kTold, {25, 26, 140, 144, 176, 177});
    }
};
constexpr Classes kClasses;

u32 id_of(LegacyCode code) {
    return code >> 4;
}
u32 meta_of(LegacyCode code) {
    return code & 15u;
}
bool is(LegacyCode code, u16 classes) {
    return kClasses.of[id_of(code)] & classes;
}

// Directions: 0 north, 1 east, 2 south, 3 west.
constexpr i32 kDx[4] = {0, 1, 0, -1}, kDz[4] = {-1, 0, 1, 0};
constexpr u32 opposite(u32 d) {
    return d ^ 2;
}
u32 stairs_facing(LegacyCode c) {
    constexpr u32 kOf[4] = {1, 3, 2, 0};
    return kOf[meta_of(c) & 3];
}
u32 horizontal_facing(LegacyCode c) {
    return (meta_of(c) + 2) & 3;
} // 0 south, 1 west, 2 north, 3 east

struct Cell {
    const LegacyView& view;
    i32 x, y, z;
    LegacyCode code;

    LegacyCode side(u32 d, i32 dy = 0) const { return view.at(x + kDx[d], y + dy, z + kDz[d]); }
    LegacyCode above() const { return view.at(x, y + 1, z); }
    LegacyCode below() const { return view.at(x, y - 1, z); }

    // Whether the neighbor in direction d turns a whole face to this cell.
    static bool whole_face(LegacyCode n, u32 d) {
        return is(n, kFull) || (is(n, kStairs) && stairs_facing(n) == opposite(d));
    }
    static bool gate_across(LegacyCode n, u32 d) { return is(n, kGate) && (horizontal_facing(n) & 1) != (d & 1); }

    u32 arms(auto&& joins) const {
        u32 bits = 0;
        for (u32 d = 0; d < 4; ++d)
            if (joins(side(d), d)) bits |= 1u << d;
        return bits;
    }

    u32 fence() const {
        const bool nether = id_of(code) == 113;
        return arms([&](LegacyCode n, u32 d) {
            if (is(n, kFence)) return (id_of(n) == 113) == nether;
            return gate_across(n, d) || (whole_face(n, d) && !is(n, kGourd));
        });
    }
    u32 pane() const {
        return arms([&](LegacyCode n, u32 d) { return is(n, kPane | kGlass) || whole_face(n, d); });
    }
    u32 wall() const {
        const u32 bits = arms([&](LegacyCode n, u32 d) {
            return id_of(n) == 139 || gate_across(n, d) || (whole_face(n, d) && !is(n, kGourd));
        });
        const bool straight = bits == 5 || bits == 10;
        return bits | (straight && above() == 0 ? 0u : 16u);
    }

    bool same_stairs(u32 d, u32 facing, u32 half) const {
        const LegacyCode n = side(d);
        return is(n, kStairs) && stairs_facing(n) == facing && (meta_of(n) & 4) == half;
    }
    u32 stairs() const {
        const u32 facing = stairs_facing(code), half = meta_of(code) & 4;
        const LegacyCode front = side(facing), back = side(opposite(facing));
        if (is(front, kStairs) && (meta_of(front) & 4) == half) {
            const u32 f = stairs_facing(front);
            if ((f & 1) != (facing & 1) && !same_stairs(opposite(f), facing, half))
                return f == ((facing + 3) & 3) ? 3 : 4;
        }
        if (is(back, kStairs) && (meta_of(back) & 4) == half) {
            const u32 f = stairs_facing(back);
            if ((f & 1) != (facing & 1) && !same_stairs(f, facing, half)) return f == ((facing + 3) & 3) ? 1 : 2;
        }
        return 0;
    }

    u32 door() const {
        if (meta_of(code) & 8) {
            const LegacyCode lower = below();
            if (id_of(lower) != id_of(code) || meta_of(lower) & 8) return 0;
            return 1 | (meta_of(lower) & 3) << 1 | (meta_of(lower) & 4 ? 8 : 0);
        }
        const LegacyCode upper = above();
        if (id_of(upper) != id_of(code) || !(meta_of(upper) & 8)) return 0;
        return 1 | (meta_of(upper) & 1) << 1 | (meta_of(upper) & 2) << 1;
    }

    u32 gate() const {
        const u32 d = (horizontal_facing(code) + 1) & 3;
        return id_of(side(d)) == 139 || id_of(side(opposite(d))) == 139;
    }

    u32 wire() const {
        const bool open_above = !is(above(), kFull);
        u32 to[4];
        for (u32 d = 0; d < 4; ++d) {
            const LegacyCode n = side(d);
            const u32 id = id_of(n);
            const bool diode_along = (id == 93 || id == 94) && (horizontal_facing(n) & 1) == (d & 1);
            // An observer's back gives its pulse: it looks the way it faces.
            constexpr u32 kLooks[6] = {9, 9, 0, 2, 3, 1};
            const bool observer = id == 218 && kLooks[std::min(meta_of(n) & 7, 5u)] == d;
            to[d] = 0;
            if (is(n, kWireEnd) || diode_along || observer)
                to[d] = 1;
            else if (is(n, kFull) && open_above && id_of(side(d, 1)) == 55)
                to[d] = 2;
            else if (!is(n, kFull) && id_of(side(d, -1)) == 55)
                to[d] = 1;
        }
        // A wire that leads one way or none was drawn through, as 1.16 stores it.
        const bool ns = to[0] || to[2], ew = to[1] || to[3];
        for (u32 d = 0; d < 4; ++d)
            if (to[d] == 0 && (d & 1 ? !ns : !ew)) to[d] = 1;
        return to[0] | to[1] << 2 | to[2] << 4 | to[3] << 6;
    }

    u32 chest() const {
        constexpr u32 kOf[8] = {9, 9, 0, 2, 3, 1, 9, 9};
        u32 facing = kOf[meta_of(code) & 7], bits = 0;
        u32 partner = 9;
        for (u32 d = 0; d < 4 && partner > 3; ++d)
            if (id_of(side(d)) == id_of(code)) partner = d;
        if (facing > 3) { // Beta did not store it: away from walls
            const u32 across = partner < 4 && !(partner & 1) ? 1 : 2;
            facing = across;
            if (is(side(facing), kFull) && !is(side(opposite(facing)), kFull)) facing = opposite(facing);
            bits = (1 + facing) << 2;
        }
        if (partner < 4 && (partner & 1) != (facing & 1)) bits |= partner == ((facing + 1) & 3) ? 1 : 2;
        return bits;
    }

    u32 repeater() const {
        const u32 facing = horizontal_facing(code);
        for (const u32 d : {(facing + 1) & 3, (facing + 3) & 3}) {
            const LegacyCode n = side(d);
            const bool on = id_of(n) == 94 || id_of(n) == 150 || (id_of(n) == 149 && meta_of(n) & 8);
            if (on && horizontal_facing(n) == d) return 1;
        }
        return 0;
    }

    u32 stem() const {
        if ((meta_of(code) & 7) != 7) return 0;
        const u32 fruit = id_of(code) == 104 ? 86 : 103;
        for (u32 d = 0; d < 4; ++d)
            if (id_of(side(d)) == fruit) return 1 + ((d + 2) & 3); // numbered from south, as metas are
        return 0;
    }

    u32 fire() const {
        if (is(below(), kFull | kBurns)) return 0;
        return arms([](LegacyCode n, u32) { return is(n, kBurns); }) | (is(above(), kBurns) ? 16u : 0u);
    }

    u32 chorus() const {
        auto plant = [](LegacyCode n) { return id_of(n) == 199 || id_of(n) == 200; };
        return arms([&](LegacyCode n, u32) { return plant(n); }) | (plant(above()) ? 16u : 0u) |
               (plant(below()) || id_of(below()) == 121 ? 32u : 0u);
    }

    u32 tripwire() const {
        return arms([](LegacyCode n, u32 d) {
            return id_of(n) == 132 || (id_of(n) == 131 && horizontal_facing(n) == opposite(d));
        });
    }

    u32 bits() const {
        const u32 id = id_of(code);
        if (is(code, kFence)) return fence();
        if (is(code, kPane)) return pane();
        if (is(code, kStairs)) return stairs();
        if (is(code, kDoor)) return door();
        if (is(code, kGate)) return gate();
        switch (id) {
        case 3:
            if (meta_of(code) != 2) return 0;
            [[fallthrough]];
        case 2:
        case 110:
            return id_of(above()) == 78 || id_of(above()) == 80;
        case 51:
            return fire();
        case 54:
        case 146:
            return chest();
        case 55:
            return wire();
        case 90:
            return id_of(side(1)) == 90 || id_of(side(3)) == 90   ? 1
                   : id_of(side(0)) == 90 || id_of(side(2)) == 90 ? 2
                                                                  : 0;
        case 93:
        case 94:
            return repeater();
        case 104:
        case 105:
            return stem();
        case 106:
            return is(above(), kFull);
        case 132:
            return tripwire();
        case 139:
            return wall();
        case 175:
            return meta_of(code) & 8 && id_of(below()) == 175 && !(meta_of(below()) & 8) ? 1 + (meta_of(below()) & 7)
                                                                                         : 0;
        case 199:
            return chorus();
        default:
            return 0;
        }
    }
};

} // namespace

void connect_legacy(const LegacyView& view, const RawSection& section, std::vector<LegacyKey>& palette,
                    std::vector<u16>& indices) {
    palette.assign(section.palette.begin(), section.palette.end());
    indices = section.indices;
    const bool any =
        std::any_of(palette.begin(), palette.end(), [](u32 code) { return is(LegacyCode(code), kAsks | kTold); });
    if (!any) {
        if (indices.empty()) indices.assign(kChunkVolume, 0);
        return;
    }
    if (indices.empty()) indices.assign(kChunkVolume, 0);

    std::unordered_map<u32, LegacyBits> told;
    for (const RawBlockEntity& e : view.middle().block_entities)
        if (e.legacy_bits && e.at.y >> 4 == section.y) told[local_of(e.at).index] = e.legacy_bits;

    std::vector<u8> concerned(palette.size());
    for (std::size_t i = 0; i < palette.size(); ++i)
        concerned[i] = is(LegacyCode(palette[i]), kAsks | kTold);
    std::unordered_map<LegacyKey, u16> slots;
    for (u32 cell = 0; cell < u32(kChunkVolume); ++cell) {
        const u16 index = indices[cell];
        if (index >= concerned.size() || !concerned[index]) continue;
        const LegacyCode code = LegacyCode(palette[index]);
        const LocalPos at(cell);
        u32 bits = 0;
        if (is(code, kTold)) {
            const auto it = told.find(cell);
            bits = it == told.end() ? 0 : it->second;
        } else {
            bits = Cell{view, at.x(), section.y * 16 + at.y(), at.z(), code}.bits();
        }
        if (bits == 0) continue;
        const LegacyKey key = code | bits << 16;
        auto [it, fresh] = slots.try_emplace(key, u16(palette.size()));
        if (fresh) palette.push_back(key);
        indices[cell] = it->second;
    }
}

} // namespace vitrail
