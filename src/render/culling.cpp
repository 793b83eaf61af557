#include "render/culling.h"

#include <algorithm>
#include <cmath>

namespace vitrail::render {

Frustum make_frustum(const scene::View& view, float aspect) {
    const float t = std::tan(view.fov_y * 0.5f), s = t * aspect;
    const auto& m = view.rotation.m; // rows: right, up, -forward
    const Vec3 right{m[0], m[4], m[8]}, up{m[1], m[5], m[9]}, forward{-m[2], -m[6], -m[10]};
    auto plane = [](Vec3 n) {
        n = normalized(n);
        return Vec4{n.x, n.y, n.z, 0};
    };
    return {{plane(right + forward * s), plane(forward * s - right), plane(up + forward * t), plane(forward * t - up),
             plane(forward)}};
}

bool box_in_frustum(const Frustum& frustum, Vec3 min, Vec3 max) {
    for (const Vec4& p : frustum.planes) {
        const float far =
            p.x * (p.x > 0 ? max.x : min.x) + p.y * (p.y > 0 ? max.y : min.y) + p.z * (p.z > 0 ? max.z : min.z);
        if (far + p.w < 0) return false;
    }
    return true;
}

static constexpr float kStill = 1.0f / 16; // an eye that moves by less keeps its walk
static constexpr i32 kLayersMost = 256;

void Culler::walk(const SectionStore& store, const scene::View& view, i32 radius) {
    const ChunkPos from = chunk_of(block_of(view.eye.at));
    const Vec3 moved = view_from(walked_from_, view.eye.at).v;
    const bool still = view.eye.dimension == walked_in_ && from == chunk_of(block_of(walked_from_)) &&
                       std::abs(moved.x) < kStill && std::abs(moved.y) < kStill && std::abs(moved.z) < kStill;
    const bool same = store.revision() == walked_revision_ && radius == walked_radius_;
    if (still && same) return;
    const ChunkPos before = chunk_of(block_of(walked_from_));
    const bool same_box = same && from == before && view.eye.dimension == walked_in_;
    walked_from_ = view.eye.at, walked_in_ = view.eye.dimension, walked_radius_ = radius;
    walked_revision_ = store.revision();
    ++walks_;
    if (!same_box) {
        i32 low = from.y, high = from.y;
        everything_ = true;
        for (const SectionPlace& p : store.places()) {
            if (p.dimension != view.eye.dimension) continue;
            low = std::min(low, p.at.y), high = std::max(high, p.at.y);
            everything_ = false;
        }
        // An empty layer above and below joins everything open to the sky.
        const i64 layers = i64(high) - low + 3, side = 2 * i64(radius) + 1;
        everything_ |= layers > kLayersMost || side * side * layers > i64(SightFlood::kSectionsMost);
        if (everything_) return;
        flood_.reset({{from.x - radius, low - 1, from.z - radius}, {i32(side), i32(layers), i32(side)}});
        for (const Section* s : store.all())
            if (s->dimension == view.eye.dimension) flood_.set(s->at, s->sight);
    }
    if (!everything_) flood_.run(view.eye.at, kStill + kSectionReach);
}

CullCounts Culler::find_visible(const SectionStore& store, const scene::View& view, float aspect, float distance,
                                bool caves, std::vector<VisibleSection>& out) {
    out.clear();
    CullCounts counts;
    const i32 radius = i32(std::ceil(distance / kChunkSize)) + 1;
    if (caves) walk(store, view, radius);
    const bool all = !caves || everything_;
    const Frustum frustum = make_frustum(view, aspect);
    const BlockPos eye = block_of(view.eye.at);
    const Vec3 fraction = view_from(corner_of(eye), view.eye.at).v;
    const i64 reach = i64(distance) + 16;
    for (std::size_t i = 0; i < store.places().size(); ++i) {
        const SectionPlace& place = store.places()[i];
        if (place.quad_count == 0 || place.dimension != view.eye.dimension) continue;
        const BlockPos origin = origin_of(place.at);
        const i64 dx = i64(origin.x) - eye.x, dy = i64(origin.y) - eye.y, dz = i64(origin.z) - eye.z;
        if (std::abs(dx + 8) > reach || std::abs(dz + 8) > reach || std::abs(dy) > (1 << 20)) continue;
        // A little beyond 0..16: fences, liquids and swaying leaves reach over.
        const Vec3 min = Vec3{float(dx), float(dy), float(dz)} - fraction - Vec3{0.5f, 0.5f, 0.5f};
        if (!box_in_frustum(frustum, min, min + Vec3{17, 17, 17})) continue;
        ++counts.in_frustum;
        if (!all && !flood_.reached(place.at)) continue;
        ++counts.in_sight;
        const i64 cx = dx * 2 + 15, cy = dy * 2 + 15, cz = dz * 2 + 15;
        out.push_back({store.all()[i], {i32(dx), i32(dy), i32(dz)}, u64(cx * cx + cy * cy + cz * cz)});
    }
    std::sort(out.begin(), out.end(), [](const VisibleSection& a, const VisibleSection& b) {
        if (a.distance2 != b.distance2) return a.distance2 < b.distance2;
        if (a.offset.y != b.offset.y) return a.offset.y < b.offset.y;
        return a.offset.x != b.offset.x ? a.offset.x < b.offset.x : a.offset.z < b.offset.z;
    });
    return counts;
}

} // namespace vitrail::render
