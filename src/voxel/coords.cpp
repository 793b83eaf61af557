#include "voxel/coords.h"

#include <algorithm>
#include <cmath>

namespace vitrail {

static i64 fixed_from(float blocks) {
    // Whole and fraction apart: a float holds neither 2^31 nor a fraction beside a large whole in one product.
    const float whole = std::floor(blocks);
    return i64(whole) * kFixedOne + i64((blocks - whole) * 4294967296.0f);
}

// Wrapping difference: right wherever the true one fits into 64 bits.
static float blocks_between(i64 from, i64 to) {
    return float(double(i64(u64(to) - u64(from))) * 0x1p-32);
}

WorldPos offset_by(WorldPos p, Vec3 o) {
    return clamp_to_world({i64(u64(p.x) + u64(fixed_from(o.x))), i64(u64(p.y) + u64(fixed_from(o.y))),
                           i64(u64(p.z) + u64(fixed_from(o.z)))});
}

ViewPos view_from(WorldPos anchor, WorldPos p) {
    return {{blocks_between(anchor.x, p.x), blocks_between(anchor.y, p.y), blocks_between(anchor.z, p.z)}};
}

ViewPos view_from(WorldPos anchor, BlockPos p) {
    return view_from(anchor, corner_of(p));
}

WorldPos clamp_to_world(WorldPos p) {
    constexpr i64 lo = -i64(kWorldEdge) * kFixedOne, hi = i64(kWorldEdge) * kFixedOne - 1;
    return {std::clamp(p.x, lo, hi), std::clamp(p.y, lo, hi), std::clamp(p.z, lo, hi)};
}

static i64 fixed_from_number(double v) {
    if (!(v > -double(kWorldEdge))) v = v != v ? 0.0 : -double(kWorldEdge);
    v = std::min(v, double(kWorldEdge));
    const double whole = std::floor(v);
    return i64(whole) * kFixedOne + i64((v - whole) * 4294967296.0);
}

WorldPos world_pos_from_numbers(double x, double y, double z) {
    return clamp_to_world({fixed_from_number(x), fixed_from_number(y), fixed_from_number(z)});
}

} // namespace vitrail
