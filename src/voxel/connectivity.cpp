#include "voxel/connectivity.h"

#include "voxel/cell_mask.h"

#include <algorithm>
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

} // namespace

u64 face_connections(const BlockStorage& blocks, OpaqueStates opaque) {
    if (blocks.uniform()) return opaque(blocks.get(LocalPos())) ? 0 : kAllConnected;
    CellMask open = cells_with_flag(blocks, opaque.flags, opaque.bit);
    for (u64& w : open)
        w = ~w;
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
