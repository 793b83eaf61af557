// Which sections an eye may see into: straight lines from it, followed through the open faces of sections
// (connectivity.h), where each face passed narrows the directions that go on. Never loses a section that a line from
// the eye reaches through open blocks; it keeps too much where the open blocks inside a section, or of a face, stand in
// the way.
//
// A line never turns back on an axis, so the eight octants around the eye are walked one by one, each in one sweep. In
// an octant a set of directions d >= 0 is kept as bounds of the ratios of its parts, d_i <= u_ij d_j. A box of blocks
// is exactly such a set, so is what passes two boxes (the smaller bounds), and what came by different ways is held by
// the larger bounds. (Difference bounds of logarithms: D. Dill, Timing Assumptions and Verification of Finite-State
// Concurrent Systems, 1989.) The boxes passed are the openings of faces.
#pragma once

#include "voxel/connectivity.h"
#include "voxel/coords.h"

#include <vector>

namespace vitrail {

// Sections min .. min + size - 1, counted x first, then z, then y.
struct SightBox {
    ChunkPos min;
    IVec3 size;
    bool contains(ChunkPos p) const {
        return i64(p.x) - min.x < size.x && p.x >= min.x && i64(p.y) - min.y < size.y && p.y >= min.y &&
               i64(p.z) - min.z < size.z && p.z >= min.z;
    }
    std::size_t count() const { return std::size_t(size.x) * std::size_t(size.y) * std::size_t(size.z); }
    std::size_t index(ChunkPos p) const { // contained ones
        return (std::size_t(p.y - min.y) * std::size_t(size.z) + std::size_t(p.z - min.z)) * std::size_t(size.x) +
               std::size_t(p.x - min.x);
    }
    ChunkPos at(std::size_t index) const;
    friend bool operator==(const SightBox&, const SightBox&) = default;
};

class SightFlood {
public:
    static constexpr std::size_t kSectionsMost = 1 << 22;

    // Every section of the box is `every` until `set` says otherwise. At most kSectionsMost sections.
    void reset(const SightBox& box, const SectionSight& every = {});
    // Without connections what enters it ends there. Sections outside the box are left out.
    void set(ChunkPos at, const SectionSight& section);

    // Lines start anywhere within `slack` blocks (0..1) of the eye on each axis, but all in the eye's section, and what
    // reaches `slack` out of a section is seen with it. An eye outside the box may see all of it.
    void run(WorldPos eye, float slack);

    const SightBox& box() const { return box_; }
    bool reached(ChunkPos at) const { return box_.contains(at) && reached_[box_.index(at)] != 0; }
    const std::vector<u8>& reached() const { return reached_; } // by SightBox::index, 0 or 1
    std::size_t reached_count() const;

private:
    // Directions of an octant: next[i] bounds d_(i+1) / d_i, last[i] bounds d_i / d_(i+1), axes counted round.
    typedef float Lanes __attribute__((vector_size(16))); // x y z and one that is not used
    struct Directions {
        Lanes next, last;
    };
    struct Octant;
    void walk(const Octant& octant);
    static Directions through(Directions in, Lanes least, Lanes most);
    static bool none(const Directions& d);
    static Directions either(const Directions& a, const Directions& b);

    SightBox box_;
    std::vector<SectionSight> sections_;
    std::vector<u8> reached_;
    // What goes on through the faces of an octant: up from each section of a layer, along z from each of a row.
    std::vector<Directions> up_, along_;
    std::vector<u8> up_open_, along_open_, row_open_;
};

} // namespace vitrail
