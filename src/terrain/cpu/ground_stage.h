// Lays and erodes the loose layers of a rectangle of columns, a zone (kZoneColumns^2) at a time. Planes of the zone and
// the columns around it; only what can be felt in the wanted columns is computed, and of that only where something lies
// or moves:
// - a layer that is absent has no passes, so the fewer layers, the smaller the margin. Columns are laid in rings
// outwards
//   until the margin covers the passes of all layers found within it;
// - the passes of a layer follow each other down the rows, one row behind the other, in place, so that the rows stay in
// the
//   nearest cache; what a pass overwrites and the next row of the same pass still reads is set aside;
// - in each row bits say which groups of 16 blocks have any of the layer, and which ones the former pass changed.
#pragma once

#include "terrain/kernel/erosion_kernel.h"

#include <cstdlib>
#include <cstring>

namespace vitrail {

// One thread's working memory, kept between calls; a template so that no two vector sets share its code.
template <class L>
struct GroundScratch {
    static constexpr i32 kColumns = kZoneColumns + 2 * kGroundReach;
    static constexpr i32 kSide = kColumns * 16;
    static constexpr i32 kMargin = 16;                  // floats a side that loads at the edges may touch
    static constexpr i32 kStride = kSide + 2 * kMargin; // floats from row to row
    static constexpr i32 kPlane = kSide * kStride;
    static constexpr u32 kPassesMost = kGroundReach * 16;
    static_assert(kColumns <= 32, "a row's groups fit in the bits of a u32");

    struct Memory {
        float height[kPlane], floor[kPlane], surface[kPlane];
        float loose[kLooseMost][kPlane]; // valid where `present` says so
        float saved[kPassesMost + 1][kStride], fresh[kStride];
        u32 present[kLooseMost][kSide];
        u32 changed[kPassesMost + 1][kSide];
    };
    Memory* memory;

    GroundScratch()
        : memory(static_cast<Memory*>(std::calloc(1, sizeof(Memory)))) {
        if (!memory) std::abort();
    }
    ~GroundScratch() { std::free(memory); }
    GroundScratch(const GroundScratch&) = delete;
    GroundScratch& operator=(const GroundScratch&) = delete;

    static Memory& of_thread() {
        static thread_local GroundScratch scratch;
        return *scratch.memory;
    }
};

// One zone or a smaller rectangle of columns_x * columns_z.
template <class L>
class ZoneGround {
public:
    using Scratch = GroundScratch<L>;
    using F = typename L::F;

    // lands: tile of the zone's least column less the reach; rows of tiles lie `lands_pitch`, `out_pitch` pointers
    // (tiles) apart.
    ZoneGround(const TerrainTables& t, i32 columns_x, i32 columns_z, const LandTile* const* lands, i32 lands_pitch,
               GroundTile* out, i32 out_pitch)
        : t_(t)
        , m_(Scratch::of_thread())
        , columns_x_(columns_x)
        , columns_z_(columns_z)
        , lands_(lands)
        , lands_pitch_(lands_pitch)
        , out_(out)
        , out_pitch_(out_pitch) {}

    void run() {
        std::memset(m_.present, 0, sizeof m_.present);
        gather_heights();
        const u32 layers = lay();
        i32 rest = passes() * __builtin_popcount(layers);
        for (u32 l = 0; l < t_.loose; ++l)
            if (layers >> l & 1) {
                erode(l, rest);
                rest -= passes();
            }
        write();
    }

private:
    static constexpr i32 kReach = kGroundReach * 16;

    i32 passes() const { return i32(t_.erosion_passes); }
    const LandTile& land(i32 x, i32 z) const { return *lands_[z * lands_pitch_ + x]; }
    static i32 offset(i32 group, i32 row) { return row * Scratch::kStride + Scratch::kMargin + group * 16; }

    void gather_heights() {
        for (i32 z = 0; z < columns_z_ + 2 * kGroundReach; ++z)
            for (i32 x = 0; x < columns_x_ + 2 * kGroundReach; ++x)
                for (i32 row = 0; row < 16; ++row)
                    std::memcpy(m_.height + offset(x, z * 16 + row), land(x, z).height + row * 16, 16 * sizeof(float));
    }

    // Returns which layers (bits) there are within reach of the zone.
    u32 lay() {
        u32 layers = 0;
        for (i32 ring = 0;; ++ring) {
            const i32 low = kGroundReach - ring, high_x = columns_x_ + kGroundReach + ring,
                      high_z = columns_z_ + kGroundReach + ring;
            for (i32 z = low; z < high_z; ++z) {
                const bool whole = ring == 0 || z == low || z == high_z - 1;
                for (i32 x = low; x < high_x; x += whole || x == high_x - 1 ? 1 : high_x - 1 - low)
                    layers |= lay_column(x, z);
            }
            if (ring == kGroundReach || ring * 16 >= passes() * __builtin_popcount(layers)) return layers;
        }
    }

    u32 lay_column(i32 x, i32 z) {
        const LandTile& tile = land(x, z);
        const LandTile& next = land(x + 1 < columns_x_ + 2 * kGroundReach ? x + 1 : x, z);
        u32 layers = 0;
        // The outermost row has no neighbor to tell its slope, and nobody feels it.
        const i32 last = z == columns_z_ + 2 * kGroundReach - 1 ? 15 : 16;
        for (i32 row = z == 0 ? 1 : 0; row < last; ++row) {
            const i32 at = offset(x, z * 16 + row);
            F attribute[kAttributesMost], loose[kLooseMost];
            load_attributes<L>(t_, tile, row * 16, attribute);
            for (u32 i = 0; i < t_.attributes; ++i)
                __builtin_prefetch(next.attribute[i] + row * 16); // tiles lie anywhere, mostly outside the near caches
            lay_loose<L>(t_, attribute, slope_at<L>(m_.height + at, Scratch::kStride), loose);
            const F rock = rock_below<L>(t_, L::load(m_.height + at), loose);
            L::store(m_.floor + at, rock);
            L::store(m_.surface + at, rock);
            for (u32 l = 0; l < t_.loose; ++l)
                if (L::any(loose[l] > L::f(0.0f))) {
                    L::store(m_.loose[l] + at, loose[l]);
                    m_.present[l][z * 16 + row] |= 1u << x;
                    layers |= 1u << l;
                }
        }
        const i32 own_x = x - kGroundReach, own_z = z - kGroundReach;
        if (own_x >= 0 && own_x < columns_x_ && own_z >= 0 && own_z < columns_z_) {
            float* rock = out_[own_z * out_pitch_ + own_x].rock;
            for (i32 row = 0; row < 16; ++row)
                L::store(rock + row * 16, L::load(m_.floor + offset(x, z * 16 + row)));
        }
        return layers;
    }

    // Rows and groups that are within `blocks` of the zone.
    struct Part {
        i32 first = 0, end = 0; // rows
        u32 groups = 0;
        bool has(i32 row) const { return row >= first && row < end; }
    };
    Part within(i32 blocks) const {
        const i32 low = (kReach - blocks) >> 4, high = (kReach + columns_x_ * 16 + blocks - 1) >> 4;
        return {kReach - blocks, kReach + columns_z_ * 16 + blocks, u32((u64(2) << high) - (u64(1) << low))};
    }

    // rest: passes still to do, this layer's among them.
    void erode(u32 l, i32 rest) {
        const Repose repose = repose_of(t_.loose_layer[l]);
        const Part start = within(rest), finish = within(rest - passes());
        for (i32 pass = 1; pass <= passes(); ++pass)
            m_.changed[pass][within(rest - pass).first - 1] = 0;
        for (i32 step = start.first; step < start.end + passes() + 1; ++step) {
            if (start.has(step)) raise(l, step, start.groups);
            for (i32 pass = 1; pass <= passes(); ++pass) {
                const Part part = within(rest - pass);
                if (part.has(step - pass)) pass_row(l, pass, step - pass, part.groups, repose);
            }
            const i32 done = step - passes() - 1;
            if (finish.has(done)) settle(l, done, finish.groups);
        }
    }

    void raise(u32 l, i32 row, u32 groups) {
        u32 bits = m_.present[l][row] & groups;
        m_.changed[0][row] = bits;
        for (; bits; bits &= bits - 1) {
            const i32 at = offset(__builtin_ctz(bits), row);
            L::store(m_.surface + at, L::load(m_.floor + at) + L::load(m_.loose[l] + at));
        }
    }

    void pass_row(u32 l, i32 pass, i32 row, u32 groups, Repose repose) {
        // The first pass looks at all of the layer, later ones only where the former one moved anything nearby.
        const u32* former = m_.changed[pass - 1];
        u32 bits = m_.present[l][row] & groups;
        if (pass > 1) {
            const u32 moved = former[row - 1] | former[row] | former[row + 1];
            bits &= moved | moved << 1 | moved >> 1;
        }
        u32 changed = 0;
        const i32 begin = row * Scratch::kStride;
        // What the row above was before this pass.
        const float* above = m_.changed[pass][row - 1] ? m_.saved[pass] : m_.surface + begin - Scratch::kStride;
        for (; bits; bits &= bits - 1) {
            const i32 group = __builtin_ctz(bits), in_row = Scratch::kMargin + group * 16;
            const float* here = m_.surface + begin + in_row;
            const F fresh =
                eroded<L>(above + in_row, here, here + Scratch::kStride, L::load(m_.floor + begin + in_row), repose);
            L::store(m_.fresh + in_row, fresh);
            if (L::any(fresh != L::load(here))) changed |= 1u << group;
        }
        m_.changed[pass][row] = changed;
        if (!changed) return;
        std::memcpy(m_.saved[pass], m_.surface + begin, sizeof m_.fresh);
        for (; changed; changed &= changed - 1) {
            const i32 in_row = Scratch::kMargin + __builtin_ctz(changed) * 16;
            L::store(m_.surface + begin + in_row, L::load(m_.fresh + in_row));
        }
    }

    void settle(u32 l, i32 row, u32 groups) {
        for (u32 bits = m_.present[l][row] & groups; bits; bits &= bits - 1) {
            const i32 at = offset(__builtin_ctz(bits), row);
            const F floor = L::load(m_.floor + at), left = L::load(m_.surface + at) - floor, top = floor + left;
            L::store(m_.loose[l] + at, left);
            L::store(m_.floor + at, top);
            L::store(m_.surface + at, top);
        }
    }

    void write() {
        for (i32 z = 0; z < columns_z_; ++z)
            for (i32 x = 0; x < columns_x_; ++x) {
                GroundTile& out = out_[z * out_pitch_ + x];
                const LandTile& from = land(x + kGroundReach, z + kGroundReach);
                std::memcpy(out.attribute, from.attribute, sizeof out.attribute);
                std::memcpy(out.land, from.height, sizeof out.land);
                for (i32 row = 0; row < 16; ++row) {
                    const i32 plane_row = (z + kGroundReach) * 16 + row, at = offset(x + kGroundReach, plane_row);
                    for (u32 l = 0; l < kLooseMost; ++l) { // those beyond the tables' hold 0
                        const bool here = (m_.present[l][plane_row] >> (x + kGroundReach) & 1) != 0;
                        L::store(out.loose[l] + row * 16, here ? L::load(m_.loose[l] + at) : L::f(0.0f));
                    }
                    L::store(out.top + row * 16, L::load(m_.floor + at));
                }
            }
    }

    const TerrainTables& t_;
    typename Scratch::Memory& m_;
    i32 columns_x_, columns_z_;
    const LandTile* const* lands_;
    i32 lands_pitch_;
    GroundTile* out_;
    i32 out_pitch_;
};

template <class L>
void ground_stage(const TerrainTables& t, ColumnPos, i32 columns_x, i32 columns_z, const LandTile* const* lands,
                  GroundTile* out) {
    const i32 pitch = columns_x + 2 * kGroundReach;
    for (i32 z = 0; z < columns_z; z += kZoneColumns)
        for (i32 x = 0; x < columns_x; x += kZoneColumns) {
            const i32 wide = columns_x - x < kZoneColumns ? columns_x - x : kZoneColumns;
            const i32 deep = columns_z - z < kZoneColumns ? columns_z - z : kZoneColumns;
            ZoneGround<L>(t, wide, deep, lands + z * pitch + x, pitch, out + z * columns_x + x, columns_x).run();
        }
}

} // namespace vitrail
