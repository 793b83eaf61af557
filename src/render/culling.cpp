#include "render/culling.h"

#include "voxel/connectivity.h"

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

void Culler::walk(SectionStore& store, const scene::View& view, i32 radius) {
    const ChunkPos from = chunk_of(block_of(view.eye.at));
    const bool moved = !(from == walked_from_) || view.eye.dimension != walked_in_ || radius != walked_radius_;
    const bool changed = store.revision() != walked_revision_;
    ++frames_since_;
    // While sections stream in, a walk every few frames will do: sections newer than the walk are drawn anyway.
    if (!moved && (!changed || frames_since_ < 4)) return;
    frames_since_ = 0;
    walked_from_ = from, walked_in_ = view.eye.dimension, walked_radius_ = radius, walked_revision_ = store.revision();
    ++stamp_;
    i32 low = from.y, high = from.y;
    bool any = false;
    for (const Section* s : store.all()) {
        if (s->dimension != view.eye.dimension) continue;
        low = any ? std::min(low, s->at.y) : s->at.y;
        high = any ? std::max(high, s->at.y) : s->at.y;
        any = true;
    }
    // One empty layer above and below, through which everything open to the sky is joined.
    constexpr i32 edge = kWorldEdge / kChunkSize - 1;
    auto sat = [](i64 v) { return i32(std::clamp<i64>(v, -i64(edge) - 1, edge)); };
    const SectionBounds bounds{{sat(i64(from.x) - radius), sat(i64(low) - 1), sat(i64(from.z) - radius)},
                               {sat(i64(from.x) + radius), sat(i64(high) + 1), sat(i64(from.z) + radius)}};
    everything_ = !any || !bounds.contains(from);
    if (everything_) return;
    const auto connections_at = [&](ChunkPos at) {
        const Section* s = store.find({at, view.eye.dimension});
        return s ? s->connections : kAllConnected;
    };
    for (ChunkPos at : reachable_sections(from, connections_at, bounds))
        if (Section* s = store.find({at, view.eye.dimension})) s->reached = stamp_;
    // What the walk looked at and left out.
    for (Section* s : store.all())
        if (s->reached != stamp_) s->reached = 1;
}

void Culler::find_visible(SectionStore& store, const scene::View& view, float aspect, float distance, bool caves,
                          std::vector<VisibleSection>& out) {
    out.clear();
    const i32 radius = i32(std::ceil(distance / kChunkSize)) + 1;
    if (caves) walk(store, view, radius);
    const Frustum frustum = make_frustum(view, aspect);
    const BlockPos eye = block_of(view.eye.at);
    const Vec3 fraction = view_from(corner_of(eye), view.eye.at).v;
    const i64 reach = i64(distance) + 16;
    for (Section* s : store.all()) {
        if (s->quad_count == 0 || s->dimension != view.eye.dimension) continue;
        if (caves && !everything_ && s->reached != stamp_ && s->reached != 0) continue;
        const BlockPos origin = origin_of(s->at);
        const i64 dx = i64(origin.x) - eye.x, dy = i64(origin.y) - eye.y, dz = i64(origin.z) - eye.z;
        if (std::abs(dx + 8) > reach || std::abs(dz + 8) > reach || std::abs(dy) > (1 << 20)) continue;
        // A little beyond 0..16: fences, liquids and swaying leaves reach over.
        const Vec3 min = Vec3{float(dx), float(dy), float(dz)} - fraction - Vec3{0.5f, 0.5f, 0.5f};
        if (!box_in_frustum(frustum, min, min + Vec3{17, 17, 17})) continue;
        const i64 cx = dx * 2 + 15, cy = dy * 2 + 15, cz = dz * 2 + 15;
        out.push_back({s, {i32(dx), i32(dy), i32(dz)}, u64(cx * cx + cy * cy + cz * cz)});
    }
    std::sort(out.begin(), out.end(), [](const VisibleSection& a, const VisibleSection& b) {
        if (a.distance2 != b.distance2) return a.distance2 < b.distance2;
        if (a.offset.y != b.offset.y) return a.offset.y < b.offset.y;
        return a.offset.x != b.offset.x ? a.offset.x < b.offset.x : a.offset.z < b.offset.z;
    });
}

} // namespace vitrail::render
