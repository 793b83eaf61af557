#include "render/translucent_order.h"

#include <algorithm>
#include <bit>
#include <tuple>

namespace vitrail::render {

namespace {

constexpr u32 kModelAxis = 3;

// What a quad fills, in cells of the section.
struct Extent {
    i32 low[3], high[3];
    u32 axis = kModelAxis; // across which a cube quad lies flat
};

Extent extent_of(Quad q) {
    Extent e{{i32(q.x()), i32(q.y()), i32(q.z())}, {}, kModelAxis};
    for (u32 k = 0; k < 3; ++k)
        e.high[k] = e.low[k] + 1;
    if (q.is_model()) return e;
    const u32 axis = e.axis = u32(q.face()) >> 1, u = axis == 0 ? 2 : 0, v = axis == 1 ? 2 : 1;
    e.high[u] = e.low[u] + i32(q.w()), e.high[v] = e.low[v] + i32(q.h());
    if (u32(q.face()) & 1)
        e.low[axis] = e.high[axis];
    else
        e.high[axis] = e.low[axis];
    return e;
}

// On each axis a bit for every plane, 0..16, that a cube quad lies in.
struct Planes {
    u32 bits[3] = {};
    explicit Planes(const std::vector<Quad>& quads) {
        for (const Quad& q : quads) {
            if (q.is_model()) continue;
            const u32 axis = u32(q.face()) >> 1;
            bits[axis] |= 1u << u32(extent_of(q).low[axis]);
        }
    }
    u32 inside(const Extent& e, u32 k) const { // those that pass between its ends
        return e.high[k] - e.low[k] < 2 ? 0 : bits[k] & ((1u << u32(e.high[k])) - 1) & ~((2u << u32(e.low[k])) - 1);
    }
    // Where on the axis something lies: planes have odd numbers, what lies between them even ones.
    i32 slot(i32 low, i32 high, u32 k) const {
        const u32 up_to = low < 0 ? 0 : bits[k] & ((2u << u32(low)) - 1);
        return 2 * std::popcount(up_to) - (low == high ? 1 : 0);
    }
};

// Occlusion is told at the corners: along an axis where it differs a part would not look as it did in the whole.
bool even_along(Quad q, bool along_u) {
    const u32 a = q.ao(), c0 = a & 3, c1 = a >> 2 & 3, c2 = a >> 4 & 3, c3 = a >> 6;
    return along_u ? c0 == c1 && c2 == c3 : c0 == c3 && c1 == c2;
}

template <class Part>
void each_part(Quad q, const Planes& planes, Part&& part) {
    const Extent e = extent_of(q);
    if (q.is_model()) return part(q);
    const u32 u = e.axis == 0 ? 2 : 0, v = e.axis == 1 ? 2 : 1;
    const u32 cut_u = even_along(q, true) ? planes.inside(e, u) : 0,
              cut_v = even_along(q, false) ? planes.inside(e, v) : 0;
    for (i32 j = e.low[v], top; j < e.high[v]; j = top) {
        const u32 above = cut_v & ~((2u << u32(j)) - 1);
        top = above ? std::countr_zero(above) : e.high[v];
        for (i32 i = e.low[u], right; i < e.high[u]; i = right) {
            const u32 beyond = cut_u & ~((2u << u32(i)) - 1);
            right = beyond ? std::countr_zero(beyond) : e.high[u];
            i32 at[3] = {i32(q.x()), i32(q.y()), i32(q.z())};
            at[u] = i, at[v] = j;
            constexpr u64 kPlace = 0xfffff; // x, y, z, w, h (quad.h)
            part(Quad{(q.bits & ~kPlace) | u64(at[0]) | u64(at[1]) << 4 | u64(at[2]) << 8 | u64(right - i - 1) << 12 |
                      u64(top - j - 1) << 16});
        }
    }
}

// Far first; equal ones in an order that no earlier eye has a say in.
struct Ranked {
    i32 steps;     // from the eye, negative
    bool away;     // looks away from the eye
    i32 distance2; // of centers, negative
    u64 bits;
    auto operator<=>(const Ranked&) const = default;
};

i32 distance_of_centers(const Extent& e, const std::array<i8, 3>& eye) { // squared, doubled coordinates
    i32 sum = 0;
    for (u32 k = 0; k < 3; ++k) {
        const i32 d = e.low[k] + e.high[k] - (eye[k] * 2 + 1);
        sum += d * d;
    }
    return sum;
}

// Parallel faces have an exact order, that of their planes: they share the places that centers gave them in that order.
void order_parallel(std::vector<Ranked>& order) {
    std::vector<u32> places;
    std::vector<std::tuple<i32, bool, u32, Ranked>> parallel;
    for (u32 axis = 0; axis < 3; ++axis) {
        places.clear(), parallel.clear();
        for (u32 place = 0; place < order.size(); ++place) {
            const Quad q{order[place].bits};
            if (q.is_model() || u32(q.face()) >> 1 != axis) continue;
            places.push_back(place);
            parallel.emplace_back(order[place].steps, order[place].away, place, order[place]);
        }
        std::sort(parallel.begin(), parallel.end());
        for (std::size_t i = 0; i < places.size(); ++i)
            order[places[i]] = std::get<3>(parallel[i]);
    }
}

} // namespace

void cut_where_planes_cross(std::vector<Quad>& quads) {
    const Planes planes(quads);
    std::size_t count = 0;
    for (const Quad& q : quads)
        each_part(q, planes, [&](Quad) { ++count; });
    if (count == quads.size() || count > std::max<std::size_t>(kCutFew, quads.size() * kCutGrowth)) return;
    std::vector<Quad> parts;
    parts.reserve(count);
    for (const Quad& q : quads)
        each_part(q, planes, [&](Quad p) { parts.push_back(p); });
    quads = std::move(parts);
}

void sort_back_to_front(std::vector<Quad>& quads, std::array<i8, 3> eye) {
    const Planes planes(quads);
    i32 at[3];
    for (u32 k = 0; k < 3; ++k)
        at[k] = planes.slot(eye[k], eye[k] + 1, k);
    std::vector<Ranked> order;
    order.reserve(quads.size());
    bool exact = true;
    for (const Quad& q : quads) {
        const Extent e = extent_of(q);
        i32 steps[3], all = 0;
        for (u32 k = 0; k < 3; ++k) {
            if (e.axis != kModelAxis && k != e.axis && planes.inside(e, k)) exact = false;
            all += steps[k] = std::abs(planes.slot(e.low[k], e.high[k], k) - at[k]);
        }
        const bool away =
            e.axis != kModelAxis && ((u32(q.face()) & 1) ? eye[e.axis] < e.low[e.axis] : eye[e.axis] >= e.low[e.axis]);
        order.push_back({-all, away, -distance_of_centers(e, eye), q.bits});
    }
    if (!exact) {
        for (Ranked& r : order) {
            const Extent e = extent_of(Quad{r.bits});
            r.steps =
                e.axis == kModelAxis ? 0 : -std::abs(planes.slot(e.low[e.axis], e.high[e.axis], e.axis) - at[e.axis]);
        }
        std::sort(order.begin(), order.end(), [](const Ranked& a, const Ranked& b) {
            return std::tie(a.distance2, a.bits) < std::tie(b.distance2, b.bits);
        });
        order_parallel(order);
    } else {
        std::sort(order.begin(), order.end());
    }
    for (std::size_t i = 0; i < quads.size(); ++i)
        quads[i].bits = order[i].bits;
}

} // namespace vitrail::render
