#include "render/meshing/mesh_scratch.h"

#include <algorithm>
#include <array>

namespace vitrail::render {

namespace {

struct Offset {
    i8 x, y, z;
};

// Offsets up to 4 away on each axis, nearest first; of equal distance the lowest y, then z, then x.
const std::vector<Offset>& nearby_offsets() {
    static const std::vector<Offset> offsets = [] {
        std::vector<Offset> out;
        for (i32 y = -4; y <= 4; ++y)
            for (i32 z = -4; z <= 4; ++z)
                for (i32 x = -4; x <= 4; ++x)
                    if (x || y || z) out.push_back({i8(x), i8(y), i8(z)});
        const auto key = [](Offset o) { return std::array<i32, 4>{o.x * o.x + o.y * o.y + o.z * o.z, o.y, o.z, o.x}; };
        std::sort(out.begin(), out.end(), [&](Offset a, Offset b) { return key(a) < key(b); });
        return out;
    }();
    return offsets;
}

} // namespace

void reveal_hidden(const MeshInput& input, MeshScratch::Impl& s) {
    const auto known_opaque = [&](StateId id) {
        return id != StateId::hidden && scene::hides(input.models->kinds()[u32(id)]);
    };
    s.cells.expand(*s.blocks);
    if (s.cells.uniform) s.cells.uniform = false; // entries may differ from now on
    const std::size_t original = s.cells.palette.size();
    const auto is_hidden_cell = [&](u32 cell) {
        const u32 p = s.cells.at(cell);
        return p < original && s.cells.palette[p] == StateId::hidden;
    };
    const auto give = [&](u32 cell, StateId state) {
        auto& palette = s.cells.palette;
        std::size_t p = std::size_t(std::find(palette.begin(), palette.end(), state) - palette.begin());
        if (p == palette.size()) {
            if (!s.cells.is_wide && p >= 256) return; // stays hidden: drawn as the unknown block
            palette.push_back(state);
        }
        if (s.cells.is_wide)
            s.cells.wide[cell] = u16(p);
        else
            s.cells.narrow[cell] = u8(p);
    };
    StateId fallback = StateId::hidden;
    for (u32 cell = 0; cell < kChunkVolume && fallback == StateId::hidden; ++cell) {
        const StateId id = s.cells.palette[s.cells.at(cell)];
        if (known_opaque(id)) fallback = id;
    }
    const auto& rows = s.opaque.first.rows;
    for (u32 cell = 0; cell < kChunkVolume; ++cell) {
        if (!is_hidden_cell(cell)) continue;
        const LocalPos at(cell);
        const u32 x = u32(at.x()) + 1, y = u32(at.y()) + 1, z = u32(at.z()) + 1;
        const u32 walled =
            rows[y - 1][z] & rows[y + 1][z] & rows[y][z - 1] & rows[y][z + 1] & rows[y][z] << 1 & rows[y][z] >> 1;
        if (walled >> x & 1) continue;
        StateId look = fallback;
        for (const Offset o : nearby_offsets()) {
            const StateId id = state_at(input, at.x() + o.x, at.y() + o.y, at.z() + o.z, StateId::hidden);
            if (!known_opaque(id)) continue;
            look = id;
            break;
        }
        if (look != StateId::hidden) give(cell, look);
    }
}

} // namespace vitrail::render
