#include "voxel/connectivity.h"

#include "voxel/cell_mask.h"

#include <algorithm>
#include <bit>
#include <unordered_map>

namespace vitrail {

namespace {

u64 joined(u32 faces) {
    u64 out = 0;
    for (u32 a = 0; a < 6; ++a)
        if (faces >> a & 1) out |= u64(faces) << (a * 6);
    return out;
}

// Faces of the section that these cells touch.
u32 faces_touched(const CellMask& m) {
    u64 any = 0, north = 0, south = 0;
    for (u32 w = 0; w < 64; w += 4) {
        north |= m[w] & 0xffff;
        south |= m[w + 3] >> 48;
        any |= m[w] | m[w + 1] | m[w + 2] | m[w + 3];
    }
    return u32((any & kRowLow) != 0) | u32((any & kRowHigh) != 0) << 1 | u32((m[0] | m[1] | m[2] | m[3]) != 0) << 2 |
           u32((m[60] | m[61] | m[62] | m[63]) != 0) << 3 | u32(north != 0) << 4 | u32(south != 0) << 5;
}

// Grows `fill` inside `open` until nothing changes: whole words at a time, up and down in turn.
void flood(CellMask& fill, const CellMask& open) {
    const auto grow = [&](u32 w) {
        u64 m = fill[w];
        if (w >= 4) m |= fill[w - 4];
        if (w < 60) m |= fill[w + 4];
        if (w & 3) m |= fill[w - 1] >> 48;
        if ((w & 3) != 3) m |= fill[w + 1] << 48;
        m &= open[w];
        for (u64 last = 0; m != last;) {
            last = m;
            m |= (m & ~kRowHigh) << 1 | (m & ~kRowLow) >> 1 | m << 16 | m >> 16;
            m &= open[w];
        }
        const bool changed = m != fill[w];
        fill[w] = m;
        return changed;
    };
    for (bool changed = true; changed;) {
        changed = false;
        for (u32 w = 0; w < 64; ++w)
            changed |= grow(w);
        if (!changed) break;
        changed = false;
        for (u32 w = 64; w-- > 0;)
            changed |= grow(w);
    }
}

// Open cells of the six outer slices.
CellMask outer(const CellMask& open) {
    CellMask out;
    for (u32 w = 0; w < 64; ++w) {
        u64 shell = kRowLow | kRowHigh;
        if (w < 4 || w >= 60) shell = ~u64(0);
        if ((w & 3) == 0) shell |= 0xffff;
        if ((w & 3) == 3) shell |= u64(0xffff) << 48;
        out[w] = open[w] & shell;
    }
    return out;
}

CellMask open_cells(const BlockStorage& blocks, OpaqueStates opaque) {
    CellMask open = cells_with_flag(blocks, opaque.flags, opaque.bit);
    for (u64& w : open)
        w = ~w;
    return open;
}

u64 connections_of(const CellMask& open) {
    CellMask seeds = outer(open);
    u64 out = 0;
    for (u32 w = 0; w < 64; ++w) {
        while (seeds[w]) {
            CellMask fill{};
            fill[w] = seeds[w] & (~seeds[w] + 1);
            flood(fill, open);
            for (u32 i = w; i < 64; ++i)
                seeds[i] &= ~fill[i];
            out |= joined(faces_touched(fill));
        }
        if (out == kAllConnected) break;
    }
    return out;
}

// Of which rows on the first axis, and which on the second, a slice has open cells.
FaceOpening opening(u32 first, u32 second) {
    if (first == 0) return kWholeFace;
    const auto least = [](u32 bits) { return u32(std::countr_zero(bits)); };
    const auto most = [](u32 bits) { return u32(std::bit_width(bits)) - 1; };
    return FaceOpening(least(first) | most(first) << 4 | least(second) << 8 | most(second) << 12);
}

FaceOpenings openings_of(const CellMask& open) {
    // Bits of open rows by face: over the axes after the face's, as FaceOpening has them.
    u32 rows[6][2] = {};
    const auto note = [](u32(&face)[2], u32 first, u32 second) { face[0] |= first, face[1] |= second; };
    for (u32 y = 0; y < 16; ++y)
        for (u32 z = 0; z < 16; ++z) {
            const u32 row = u32(open[y * 4 + z / 4] >> (z % 4 * 16)) & 0xffff;
            if (row == 0) continue;
            if (row & 1) note(rows[0], 1u << y, 1u << z);
            if (row & 0x8000) note(rows[1], 1u << y, 1u << z);
            if (y == 0) note(rows[2], 1u << z, row);
            if (y == 15) note(rows[3], 1u << z, row);
            if (z == 0) note(rows[4], row, 1u << y);
            if (z == 15) note(rows[5], row, 1u << y);
        }
    FaceOpenings out;
    for (u32 f = 0; f < 6; ++f)
        out[f] = opening(rows[f][0], rows[f][1]);
    return out;
}

} // namespace

u64 face_connections(const BlockStorage& blocks, OpaqueStates opaque) {
    if (blocks.uniform()) return opaque(blocks.get(LocalPos())) ? 0 : kAllConnected;
    return connections_of(open_cells(blocks, opaque));
}

SectionSight section_sight(const BlockStorage& blocks, OpaqueStates opaque) {
    if (blocks.uniform()) return {face_connections(blocks, opaque), kWholeFaces};
    const CellMask open = open_cells(blocks, opaque);
    return {connections_of(open), openings_of(open)};
}

namespace {

// By which faces sections of a box were entered: a byte each, or a hash where the box is too large for that.
class EnteredFaces {
public:
    explicit EnteredFaces(const SectionBounds& bounds)
        : min_(bounds.min)
        , width_(i64(bounds.max.x) - bounds.min.x + 1)
        , depth_(i64(bounds.max.z) - bounds.min.z + 1) {
        const i64 height = i64(bounds.max.y) - bounds.min.y + 1;
        if (width_ <= kFlatMost && depth_ <= kFlatMost / width_ && height <= kFlatMost / (width_ * depth_))
            flat_.resize(std::size_t(width_ * depth_ * height));
    }
    // True for the first time.
    bool enter(ChunkPos at, u32 face) {
        u8& here = flat_.empty() ? far_[at] : flat_[index(at)];
        const bool fresh = here == 0;
        here |= u8(face | kSeen);
        return fresh;
    }
    u32 faces(ChunkPos at) const { return (flat_.empty() ? far_.at(at) : flat_[index(at)]) & (kSeen - 1); }

private:
    static constexpr i64 kFlatMost = 1 << 20;
    static constexpr u32 kSeen = 64;
    std::size_t index(ChunkPos at) const {
        return std::size_t(((i64(at.y) - min_.y) * depth_ + (i64(at.z) - min_.z)) * width_ + (i64(at.x) - min_.x));
    }
    ChunkPos min_;
    i64 width_, depth_;
    std::vector<u8> flat_;
    std::unordered_map<ChunkPos, u8> far_;
};

} // namespace

std::vector<ChunkPos> reachable_sections(ChunkPos start, const ConnectionsLookup& connections_at,
                                         SectionBounds bounds) {
    std::vector<ChunkPos> out;
    if (!bounds.contains(start)) return out;
    // A path that never turns back has, at a given section, always gone the same ways; so a section's walk depends only
    // on the faces it was entered by, and all of these are known once the steps before it are done.
    EnteredFaces entered(bounds);
    out.push_back(start);
    (void)entered.enter(start, 0);
    for (std::size_t i = 0; i < out.size(); ++i) {
        const ChunkPos at = out[i];
        u32 leave = 0;
        const u64 connections = connections_at(at);
        if (i == 0) {
            leave = 63;
        } else {
            const u32 in = entered.faces(at);
            for (u32 f = 0; f < 6; ++f)
                if (in >> f & 1) leave |= u32(connections >> (f * 6)) & 63;
        }
        const i64 gone[3] = {i64(at.x) - start.x, i64(at.y) - start.y, i64(at.z) - start.z};
        for (u32 f = 0; f < 6; ++f) {
            if (!(leave >> f & 1)) continue;
            const i64 along = gone[f >> 1];
            if (f & 1 ? along < 0 : along > 0) continue;
            const ChunkPos next = neighbor(at, Face(f));
            if (!bounds.contains(next)) continue;
            if (entered.enter(next, 1u << u32(opposite(Face(f))))) out.push_back(next);
        }
    }
    return out;
}

} // namespace vitrail
