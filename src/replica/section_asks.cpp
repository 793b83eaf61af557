#include "replica/section_asks.h"

#include <algorithm>
#include <cmath>

namespace vitrail::replica {

static constexpr float kStill = 0.5f;               // blocks that the eye may move before it looks again
static constexpr float kSameWay = 0.98f;            // cosine of the turn before it does
static constexpr float kSlack = kStill + 3.0f / 16; // blocks reach out of their sections by 3/16 (render/culling.h)
static constexpr i32 kLayersBeyondMost = 64;        // of air above and below the dimension that sight may pass

bool SectionAsks::stale(const Gaze& gaze) const {
    if (!looked_ || !changed_.empty()) return true;
    const Vec3 moved = view_from(answered_.eye, gaze.eye).v;
    return dot(moved, moved) > kStill * kStill || dot(gaze.forward, answered_.forward) < kSameWay ||
           !(chunk_of(block_of(gaze.eye)) == chunk_of(block_of(answered_.eye)));
}

std::vector<ChunkPos> SectionAsks::missing(const Dimension& dimension, const Gaze& gaze, u32 view_distance,
                                           std::size_t most) {
    if (!looked_)
        for (const auto& [at, chunk] : dimension.chunks())
            changed_.insert(at);
    const OpaqueStates opaque{dimension.states().flags_data(), kOpaqueCube};
    for (ChunkPos at : changed_) {
        const ChunkPtr chunk = dimension.find(at);
        if (chunk)
            known_[at] = section_sight(chunk->blocks, opaque);
        else
            known_.erase(at);
    }
    changed_.clear();
    answered_ = gaze, looked_ = true;

    const ChunkPos eye = chunk_of(block_of(gaze.eye));
    const i32 least = dimension.info().min_y >> 4, most_y = (dimension.info().max_y >> 4) - 1;
    const i32 low = std::min(least, eye.y), high = std::max(most_y + 1, eye.y);
    if (least - low > kLayersBeyondMost || high - most_y > kLayersBeyondMost) return {};
    const i32 radius = i32(view_distance), side = 2 * radius + 1;
    const SightBox box{{eye.x - radius, low, eye.z - radius}, {side, high - low + 1, side}};
    // What is not held ends sight; beyond the dimension there is air.
    flood_.reset(box, {0, kWholeFaces});
    for (i32 y = low; y <= high; ++y) {
        if (y >= least && y <= most_y) continue;
        for (i32 z = 0; z < side; ++z)
            for (i32 x = 0; x < side; ++x)
                flood_.set({box.min.x + x, y, box.min.z + z}, {});
    }
    for (const auto& [at, sight] : known_)
        flood_.set(at, sight);
    flood_.run(gaze.eye, kSlack);

    struct Wanted {
        bool aside;
        i64 distance2;
        ChunkPos at;
    };
    std::vector<Wanted> wanted;
    for (std::size_t i = 0; i < flood_.reached().size(); ++i) {
        if (!flood_.reached()[i]) continue;
        const ChunkPos at = box.at(i);
        const i64 x = i64(at.x) - eye.x, y = i64(at.y) - eye.y, z = i64(at.z) - eye.z;
        if (at.y < least || at.y > most_y || x * x + z * z > i64(radius) * radius || known_.contains(at)) continue;
        const BlockPos origin = origin_of(at);
        const Vec3 to = view_from(gaze.eye, BlockPos{origin.x + 8, origin.y + 8, origin.z + 8}).v;
        const float distance = length(to), half = 8 * std::sqrt(3.0f); // of a section's diagonal
        const float seen_under = distance > half ? std::asin(half / distance) : 4.0f;
        const float off = std::acos(clamp(dot(to, gaze.forward) / std::max(distance, 1e-3f), -1.0f, 1.0f));
        wanted.push_back({off > gaze.half_angle + seen_under, x * x + y * y + z * z, at});
    }
    const auto sooner = [](const Wanted& a, const Wanted& b) {
        if (a.aside != b.aside) return b.aside;
        if (a.distance2 != b.distance2) return a.distance2 < b.distance2;
        if (a.at.y != b.at.y) return a.at.y < b.at.y;
        return a.at.z != b.at.z ? a.at.z < b.at.z : a.at.x < b.at.x;
    };
    const std::size_t kept = std::min(most, wanted.size());
    std::partial_sort(wanted.begin(), wanted.begin() + std::ptrdiff_t(kept), wanted.end(), sooner);
    std::vector<ChunkPos> out;
    for (std::size_t i = 0; i < kept; ++i)
        out.push_back(wanted[i].at);
    return out;
}

} // namespace vitrail::replica
