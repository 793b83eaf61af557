#include "voxel/ray_walk.h"

#include <algorithm>
#include <cmath>

namespace vitrail {

namespace {

__extension__ typedef unsigned __int128 u128;

constexpr double kSpeedOne = 1u << 30;

Face entry_face(int axis, i32 sign) {
    return Face(u8(axis * 2 + (sign > 0 ? 0 : 1)));
}

} // namespace

RayWalk::RayWalk(WorldPos origin, Vec3 direction, float distance)
    : cell_(block_of(origin)) {
    const double d[3] = {direction.x, direction.y, direction.z};
    double length = std::sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
    distance_ = distance > 0 ? std::min(distance, kDistanceMost) : 0;
    if (!(length > 0) || !std::isfinite(length)) length = 0;
    const i64 at[3] = {origin.x, origin.y, origin.z};
    int main_axis = 1;
    for (int a = 0; a < 3; ++a) {
        const u64 fraction = u64(at[a]) & 0xffffffffu;
        sign_[a] = d[a] < 0 ? -1 : 1;
        speed_[a] = length > 0 ? u64(std::llround(std::abs(d[a]) / length * kSpeedOne)) : 0;
        next_[a] = sign_[a] > 0 ? u64(kFixedOne) - fraction : fraction;
        if (speed_[a] > speed_[main_axis]) main_axis = a;
    }
    entry_ = entry_face(main_axis, sign_[main_axis]);
    valid_ = in_world(cell_);
}

void RayWalk::step() {
    // The axis whose boundary comes first: next / speed smallest, compared without dividing.
    int axis = -1;
    for (int a = 0; a < 3; ++a) {
        if (speed_[a] == 0) continue;
        if (axis < 0 || u128(next_[a]) * speed_[axis] < u128(next_[axis]) * speed_[a]) axis = a;
    }
    first_ = false;
    if (axis < 0) {
        valid_ = false;
        return;
    }
    t_ = double(next_[axis]) / double(kFixedOne) * (kSpeedOne / double(speed_[axis]));
    next_[axis] += u64(kFixedOne);
    i32& coordinate = axis == 0 ? cell_.x : axis == 1 ? cell_.y : cell_.z;
    coordinate += sign_[axis];
    entry_ = entry_face(axis, sign_[axis]);
    valid_ = t_ <= distance_ && in_world(cell_);
}

} // namespace vitrail
