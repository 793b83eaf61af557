#include "render/passes/shadow/shadow_cascades.h"

#include <algorithm>
#include <cmath>

namespace vitrail::render {

namespace {

constexpr double kAnchorReach = 256; // blocks; within, a place is exact to 1/256 texel in floats

double blocks(i64 fixed) {
    return double(fixed) * 0x1p-32;
}
// Wrapping difference: right wherever the true one fits into 64 bits.
D3 between(BlockPos from, WorldPos to) {
    const WorldPos a = corner_of(from);
    return {blocks(i64(u64(to.x) - u64(a.x))), blocks(i64(u64(to.y) - u64(a.y))), blocks(i64(u64(to.z) - u64(a.z)))};
}
D3 unit(D3 a) {
    const double l = std::sqrt(dot(a, a));
    return {a.x / l, a.y / l, a.z / l};
}
D3 cross(D3 a, D3 b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
Vec4 row(D3 a, double w) {
    return {float(a.x), float(a.y), float(a.z), float(w)};
}
D3 times(D3 a, double s) {
    return {a.x * s, a.y * s, a.z * s};
}

// What filters read beside a point of the ball.
double guard(const ShadowMapPlace& place) {
    return double(kPenumbraMost) + 3 * place.texel;
}

// The center's place from the eye along the three axes, blocks.
D3 center_from_eye(const ShadowMapPlace& place, WorldPos eye) {
    const D3 d = between(place.anchor, eye);
    return {double(place.u) * place.texel - dot(d, place.right), double(place.v) * place.texel - dot(d, place.up),
            double(place.w) * place.texel - dot(d, place.toward)};
}

} // namespace

std::array<float, kCascadesMost> cascade_ends(u32 count, float distance) {
    std::array<float, kCascadesMost> ends{};
    const float first = std::min(4.0f, distance);
    for (u32 i = 0; i < kCascadesMost; ++i) {
        const float share = std::min(float(i + 1) / float(count), 1.0f);
        const float ratios = first * std::pow(distance / first, share), steps = first + (distance - first) * share;
        ends[i] = lerp(steps, ratios, 0.9f);
    }
    return ends;
}

ShadowMapPlace place_shadow_map(const ShadowMapPlace& before, Located<WorldPos> eye, Vec3 toward, float radius,
                                u32 size) {
    ShadowMapPlace place;
    place.dimension = eye.dimension;
    place.toward = unit({double(toward.x), double(toward.y), double(toward.z)});
    // The sun's path turns about an axis near z: with z as the second axis the grid turns as little as can be.
    const D3 t = place.toward;
    const D3 axis = std::abs(t.z) < 0.9 ? D3{0, 0, 1} : D3{1, 0, 0};
    place.right = unit(cross(axis, t));
    place.up = cross(t, place.right);
    // Texels are whole 2^-20 blocks, so that whole numbers of them are exact.
    const double wanted = double(radius) * 1.1 + 2 + double(kPenumbraMost);
    place.texel = std::ceil(wanted * 2 / double(size) * 0x1p20) * 0x1p-20;
    place.half = place.texel * double(size) / 2;
    const bool same_grid = before.texel == place.texel && before.dimension == place.dimension &&
                           before.toward.x == t.x && before.toward.y == t.y && before.toward.z == t.z;
    place.anchor = block_of(eye.at);
    if (same_grid) {
        const D3 d = between(before.anchor, eye.at);
        if (dot(d, d) < kAnchorReach * kAnchorReach) place.anchor = before.anchor;
    }
    const D3 d = between(place.anchor, eye.at);
    auto texels = [&](D3 direction) { return i64(std::floor(dot(d, direction) / place.texel + 0.5)); };
    place.u = texels(place.right), place.v = texels(place.up), place.w = texels(place.toward);
    return place;
}

bool covers(const ShadowMapPlace& place, Located<WorldPos> eye, float radius) {
    if (place.texel == 0 || place.dimension != eye.dimension) return false;
    const D3 c = center_from_eye(place, eye.at);
    const double reach = place.half - double(radius) - guard(place);
    return std::abs(c.x) <= reach && std::abs(c.y) <= reach && std::abs(c.z) <= reach;
}

bool may_cast(const ShadowMapPlace& place, ChunkPos at) {
    const BlockPos o = origin_of(at);
    const D3 middle{double(i64(o.x) - place.anchor.x) + 8, double(i64(o.y) - place.anchor.y) + 8,
                    double(i64(o.z) - place.anchor.z) + 8};
    auto reach = [](D3 a) { return 8.5 * (std::abs(a.x) + std::abs(a.y) + std::abs(a.z)); };
    auto from_center = [&](D3 a, i64 center) { return dot(middle, a) - double(center) * place.texel; };
    return std::abs(from_center(place.right, place.u)) <= place.half + reach(place.right) &&
           std::abs(from_center(place.up, place.v)) <= place.half + reach(place.up) &&
           from_center(place.toward, place.w) >= -place.half - reach(place.toward);
}

ShadowRows rows_from_eye(const ShadowMapPlace& place, WorldPos eye) {
    const D3 c = center_from_eye(place, eye);
    const double across = 1 / (2 * place.half), deep = 1 / place.depth_range();
    return {row(times(place.right, across), 0.5 - c.x * across), row(times(place.up, across), 0.5 - c.y * across),
            row(times(place.toward, -deep), (place.half + kCasterReach + c.z) * deep)};
}

std::array<Vec4, 4> rows_from_anchor(const ShadowMapPlace& place, u32 size) {
    const double texels = 1 / place.texel, deep = 1 / place.depth_range();
    const double top = place.half + kCasterReach + double(place.w) * place.texel;
    return {row(times(place.right, texels), 0), row(times(place.up, texels), 0),
            row(times(place.toward, -deep), top * deep), Vec4{float(place.u), float(place.v), 2.0f / float(size), 0}};
}

} // namespace vitrail::render
