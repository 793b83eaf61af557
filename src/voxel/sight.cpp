#include "voxel/sight.h"

#include "base/assert.h"

#include <algorithm>
#include <type_traits>
#include <utility>

namespace vitrail {

namespace {

// Stand for zero and infinity: ratios of world sizes lie far between, products of two stay inside a float.
constexpr float kTiny = 1e-12f, kHuge = 1e15f;
constexpr float kRounding = 1e-4f; // by which the bounds of a set may contradict each other before it is empty

} // namespace

// Axes point away from the eye: a coordinate is sign * (world - eye), so that all directions are >= 0.
struct SightFlood::Octant {
    i32 place[3], size[3]; // the eye's section in the box; the box
    i32 sign[3];
    i32 count[3];   // sections from the eye's to the edge of the box, both included
    float begin[3]; // where the eye's section begins, blocks: -16 .. 0
    float slack;
    u32 in[3], out[3]; // faces that lines come in and go out by, an axis each
    u32 bit[3][3];     // of SectionSight::connections: what came in along a goes out along b

    float section_begin(u32 axis, std::size_t k) const { return begin[axis] + float(k) * kChunkSize; }
    // The least and most of an opening on the axis that is `turn` after its own, from where the section begins.
    std::pair<float, float> span(FaceOpening opening, u32 axis, u32 turn) const {
        const u32 bits = u32(opening) >> ((turn - 1) * 8), least = bits & 15, most = (bits >> 4 & 15) + 1;
        if (sign[(axis + turn) % 3] > 0) return {float(least), float(most)};
        return {float(16 - most), float(16 - least)};
    }
};

ChunkPos SightBox::at(std::size_t i) const {
    const std::size_t x = i % std::size_t(size.x), rest = i / std::size_t(size.x);
    return {min.x + i32(x), min.y + i32(rest / std::size_t(size.z)), min.z + i32(rest % std::size_t(size.z))};
}

void SightFlood::reset(const SightBox& box, const SectionSight& every) {
    VX_ASSERT(box.size.x >= 0 && box.size.y >= 0 && box.size.z >= 0 && box.count() <= kSectionsMost);
    box_ = box;
    sections_.assign(box.count(), every);
    reached_.assign(box.count(), 0);
}

void SightFlood::set(ChunkPos at, const SectionSight& section) {
    if (box_.contains(at)) sections_[box_.index(at)] = section;
}

std::size_t SightFlood::reached_count() const {
    return std::size_t(std::count(reached_.begin(), reached_.end(), u8(1)));
}

// Of the directions, those that meet the box; `least` > 0.
inline SightFlood::Directions SightFlood::through(Directions in, Lanes least, Lanes most) {
    const auto smaller = [](Lanes a, Lanes b) { return a < b ? a : b; };
    const Lanes inverse = 1.0f / least;
    const Lanes next = smaller(in.next, __builtin_shufflevector(most, most, 1, 2, 0, 3) * inverse);
    const Lanes last = smaller(in.last, most * __builtin_shufflevector(inverse, inverse, 1, 2, 0, 3));
    // What two bounds say together: d_i+1 <= last_i+1 d_i+2 <= last_i+1 last_i+2 d_i, and so on.
    return {smaller(next,
                    __builtin_shufflevector(last, last, 1, 2, 0, 3) * __builtin_shufflevector(last, last, 2, 0, 1, 3)),
            smaller(last,
                    __builtin_shufflevector(next, next, 1, 2, 0, 3) * __builtin_shufflevector(next, next, 2, 0, 1, 3))};
}

inline bool SightFlood::none(const Directions& d) {
    const Lanes both = d.next * d.last;
    return std::min(std::min(both[0], both[1]), both[2]) < 1 - kRounding;
}

inline SightFlood::Directions SightFlood::either(const Directions& a, const Directions& b) {
    return {a.next > b.next ? a.next : b.next, a.last > b.last ? a.last : b.last};
}

void SightFlood::walk(const Octant& o) {
    const std::size_t row = std::size_t(o.count[0]), layer = row * std::size_t(o.count[2]);
    up_.resize(std::max(up_.size(), layer)), along_.resize(std::max(along_.size(), row));
    up_open_.assign(layer, 0), along_open_.resize(row), row_open_.assign(std::size_t(o.count[2]), 0);
    const auto larger = [](Lanes a, Lanes b) { return a > b ? a : b; };
    const Lanes tiny{kTiny, kTiny, kTiny, 1}, slack{o.slack, o.slack, o.slack, 0};

    // Of `in`, what passes the opening of a face on this axis; `begin` is where the section begins, `plane` the face.
    const auto pass = [&]<u32 kAxis>(std::integral_constant<u32, kAxis>, Directions& in, FaceOpening opening,
                                     Lanes begin, Lanes plane) {
        constexpr u32 kFirst = (kAxis + 1) % 3, kSecond = (kAxis + 2) % 3;
        Lanes least = begin, most = begin + float(kChunkSize);
        if (opening != kWholeFace) {
            const auto [from, to] = o.span(opening, kAxis, 1);
            const auto [from2, to2] = o.span(opening, kAxis, 2);
            most[kFirst] = begin[kFirst] + to, least[kFirst] = begin[kFirst] + from;
            most[kSecond] = begin[kSecond] + to2, least[kSecond] = begin[kSecond] + from2;
        }
        least[kAxis] = most[kAxis] = plane[kAxis];
        least = larger(least - slack, tiny), most += slack;
        most[3] = 1;
        if (std::min({most[0], most[1], most[2]}) <= 0) return false; // all of it lies on the other side of the eye
        in = through(in, least, most);
        return !none(in);
    };

    for (std::size_t y = 0; y < std::size_t(o.count[1]); ++y) {
        bool layer_open = false, along_any = false;
        std::fill(along_open_.begin(), along_open_.end(), u8(0));
        for (std::size_t z = 0; z < std::size_t(o.count[2]); ++z) {
            const bool first_row = y == 0 && z == 0;
            if (!row_open_[z] && !along_any && !first_row) continue; // nothing comes into this row
            Directions came[3] = {{{kHuge, kHuge, kHuge, 1}, {kHuge, kHuge, kHuge, 1}}, {}, {}};
            bool open[3] = {first_row, false, false};
            bool up_any = false;
            along_any = false;
            const i64 across = (i64(o.place[1]) + o.sign[1] * i64(y)) * o.size[2] + o.place[2] + o.sign[2] * i64(z);
            std::size_t cell = std::size_t(across * o.size[0] + o.place[0]);
            for (std::size_t x = 0; x < row; ++x, cell = std::size_t(i64(cell) + o.sign[0])) {
                open[1] = up_open_[z * row + x] != 0, open[2] = along_open_[x] != 0;
                if (!open[0] && !open[1] && !open[2]) continue;
                reached_[cell] = 1;
                const bool first = first_row && x == 0;
                const SectionSight& here = sections_[cell];
                const u64 joins = first ? kAllConnected : here.connections;
                came[1] = up_[z * row + x], came[2] = along_[x];
                const Lanes begin{o.section_begin(0, x), o.section_begin(1, y), o.section_begin(2, z), 0};
                const Lanes end = begin + float(kChunkSize);
                Directions go[3];
                bool goes[3] = {false, false, false};
                const bool more[3] = {x + 1 < row, y + 1 < std::size_t(o.count[1]), z + 1 < std::size_t(o.count[2])};
                const auto enter = [&]<u32 kAxis>(std::integral_constant<u32, kAxis> axis) {
                    const FaceOpening opening = here.openings[o.in[kAxis]];
                    if (open[kAxis] && opening != kWholeFace)
                        open[kAxis] = pass(axis, came[kAxis], opening, begin, begin);
                };
                const auto leave = [&]<u32 kAxis>(std::integral_constant<u32, kAxis> axis) {
                    if (!more[kAxis]) return;
                    Directions out{};
                    bool any = false;
                    for (u32 a = 0; a < 3; ++a)
                        if (open[a] && (joins >> o.bit[a][kAxis] & 1)) {
                            out = any ? either(out, came[a]) : came[a];
                            any = true;
                        }
                    if (!any) return;
                    goes[kAxis] = pass(axis, out, first ? kWholeFace : here.openings[o.out[kAxis]], begin, end);
                    go[kAxis] = out;
                };
                constexpr std::integral_constant<u32, 0> kX;
                constexpr std::integral_constant<u32, 1> kY;
                constexpr std::integral_constant<u32, 2> kZ;
                if (!first) enter(kX), enter(kY), enter(kZ);
                if (joins != 0) leave(kX), leave(kY), leave(kZ);
                open[0] = goes[0], came[0] = go[0];
                up_open_[z * row + x] = goes[1], up_[z * row + x] = go[1];
                along_open_[x] = goes[2], along_[x] = go[2];
                up_any |= goes[1], along_any |= goes[2];
            }
            row_open_[z] = up_any, layer_open |= up_any;
        }
        if (!layer_open) break;
    }
}

void SightFlood::run(WorldPos eye, float slack) {
    const ChunkPos at = chunk_of(block_of(eye));
    if (!box_.contains(at)) {
        reached_.assign(reached_.size(), 1);
        return;
    }
    std::fill(reached_.begin(), reached_.end(), u8(0));
    const Vec3 v = view_from(corner_of(origin_of(at)), eye).v;
    const float within[3] = {v.x, v.y, v.z};
    Octant o{{at.x - box_.min.x, at.y - box_.min.y, at.z - box_.min.z},
             {box_.size.x, box_.size.y, box_.size.z},
             {},
             {},
             {},
             slack,
             {},
             {},
             {}};
    for (u32 number = 0; number < 8; ++number) {
        for (u32 a = 0; a < 3; ++a) {
            const bool up = number >> a & 1;
            o.sign[a] = up ? 1 : -1;
            o.count[a] = up ? o.size[a] - o.place[a] : o.place[a] + 1;
            o.begin[a] = up ? -within[a] : within[a] - float(kChunkSize);
            o.in[a] = a * 2 + (up ? 0 : 1), o.out[a] = a * 2 + (up ? 1 : 0);
        }
        for (u32 a = 0; a < 3; ++a)
            for (u32 b = 0; b < 3; ++b)
                o.bit[a][b] = o.in[a] * 6 + o.out[b];
        walk(o);
    }
}

} // namespace vitrail
