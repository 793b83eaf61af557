#include "trace/boxes.h"

#include "trace/kernel/box_hit.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace vitrail::trace {

namespace {

constexpr u32 kLeaf = 4;                // boxes, at most
constexpr float kLongestSide = 1 << 16; // blocks; keeps all numbers small enough to be exact where it counts
constexpr float kRayReach = 1 << 10;    // blocks that rays start from the anchor, mostly
constexpr float kRounding = 0x1p-21f;   // of coordinates relative to the anchor, generously
constexpr u32 kBoxesMost = 1u << 20;

bool sound(Vec3 size) {
    const auto fits = [](float v) { return v > 0 && v <= kLongestSide; };
    return fits(size.x) && fits(size.y) && fits(size.z);
}

bool same(std::span<const EntityBox> a, std::span<const EntityBox> b) {
    static_assert(sizeof(EntityBox) == 40, "no padding: bytes tell");
    return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size_bytes()) == 0);
}

float axis_of(Vec3 v, u32 axis) {
    return axis == 0 ? v.x : axis == 1 ? v.y : v.z;
}

struct Bounds {
    Vec3 least{kFar, kFar, kFar}, most{-kFar, -kFar, -kFar};
    void grow(Vec3 a, Vec3 b) {
        least = {std::min(least.x, a.x), std::min(least.y, a.y), std::min(least.z, a.z)};
        most = {std::max(most.x, b.x), std::max(most.y, b.y), std::max(most.z, b.z)};
    }
    u32 longest() const {
        const Vec3 d = most - least;
        return d.x >= d.y && d.x >= d.z ? 0 : d.y >= d.z ? 1 : 2;
    }
};

} // namespace

Place place_of(WorldPos at) {
    const BlockPos block = block_of(at);
    return {{block.x, block.y, block.z}, view_from(corner_of(block), at).v};
}

bool BoxTree::update(std::span<const scene::EntityBox> entities, DimensionId dimension, Place around,
                     std::span<const StateRecord> states) {
    std::vector<EntityBox> now;
    for (const scene::EntityBox& e : entities) {
        const u32 state = u32(e.looks_like);
        if (e.least.dimension != dimension || !sound(e.size) || state >= states.size() || now.size() == kBoxesMost)
            continue;
        if (states[state].kind == CellKind::empty) continue;
        now.push_back({place_of(e.least.at), e.size, state});
    }
    const IVec3 anchor = around.cell;
    const bool others = !same(now, given_);
    if (!others && (now.empty() || anchor == from_.cell)) return false;
    given_ = std::move(now);
    from_ = {anchor, {}};
    build();
    ++generation_;
    return others;
}

// Halves at the median along the longest side, so the tree is as deep as the logarithm of its boxes.
void BoxTree::build() {
    static_assert(kBoxesMost >> (kBoxDepthMost - 2) <= kLeaf);
    boxes_ = given_;
    nodes_.clear();
    if (boxes_.empty()) return;
    nodes_.push_back({{}, {}, 0, u32(boxes_.size())});
    for (std::size_t n = 0; n < nodes_.size(); ++n) {
        const u32 first = nodes_[n].first, count = nodes_[n].count;
        Bounds bounds, middles;
        for (u32 i = first; i < first + count; ++i) {
            const Vec3 least = offset(from_, boxes_[i].least), most = least + boxes_[i].size,
                       middle = (least + most) * 0.5f;
            bounds.grow(least, most), middles.grow(middle, middle);
        }
        // Wider than the boxes by what rounding may take from a ray's numbers, as the node test has them.
        const auto slack = [](float v) { return (std::fabs(v) + kRayReach) * kRounding; };
        const Vec3 a = bounds.least, b = bounds.most;
        nodes_[n].least = {a.x - slack(a.x), a.y - slack(a.y), a.z - slack(a.z)};
        nodes_[n].most = {b.x + slack(b.x), b.y + slack(b.y), b.z + slack(b.z)};
        if (count <= kLeaf) continue;
        const u32 axis = middles.longest(), half = count / 2;
        const auto middle = [&](const EntityBox& e) { return axis_of(offset(from_, e.least) + e.size * 0.5f, axis); };
        const auto begin = boxes_.begin() + first;
        std::nth_element(begin, begin + half, begin + count,
                         [&](const EntityBox& x, const EntityBox& y) { return middle(x) < middle(y); });
        nodes_[n].first = u32(nodes_.size()), nodes_[n].count = 0;
        nodes_.push_back({{}, {}, first, half});
        nodes_.push_back({{}, {}, first + half, count - half});
    }
}

void BoxTree::fill(SceneView& scene) const {
    scene.boxes = boxes_.data();
    scene.box_nodes = nodes_.data();
    scene.box_count = u32(boxes_.size());
    scene.boxes_from = from_;
}

} // namespace vitrail::trace
