#include "trace/lights/light_tree_build.h"

#include <algorithm>
#include <numeric>

namespace vitrail::trace {

static constexpr u32 kBins = 8;

static float least(float a, float b) {
    return a < b ? a : b;
}
static float most(float a, float b) {
    return a > b ? a : b;
}

LightNode united(const LightNode& a, const LightNode& b) {
    LightNode out;
    out.least = {least(a.least.x, b.least.x), least(a.least.y, b.least.y), least(a.least.z, b.least.z)};
    out.most = {most(a.most.x, b.most.x), most(a.most.y, b.most.y), most(a.most.z, b.most.z)};
    out.power = a.power + b.power;
    const float share = out.power > 0 ? a.power / out.power : 0;
    for (int f = 0; f < 6; ++f) {
        const float mixed = float(a.shares[f]) * share + float(b.shares[f]) * (1 - share);
        const u32 up = u32(std::ceil(mixed));
        out.shares[f] = u8(std::min(up, 255u));
    }
    return out;
}

// What a node costs: lights that are strong, far apart and shine into many directions make a poor cluster.
static float cost(const LightNode& n) {
    const Vec3 d = n.most - n.least;
    float directions = 1;
    for (u8 s : n.shares)
        directions += s ? 1.0f : 0.0f;
    return n.power * (d.x * d.y + d.y * d.z + d.z * d.x + 0.1f * (d.x + d.y + d.z) + 0.01f) * directions;
}

static float along(Vec3 v, int axis) {
    return axis == 0 ? v.x : axis == 1 ? v.y : v.z;
}

namespace {

struct Builder {
    const std::vector<LightNode>& items;
    BuiltTree& tree;
    std::vector<u32> order;

    Vec3 center(u32 i) const { return (items[order[i]].least + items[order[i]].most) * 0.5f; }

    // Where to part order[begin, end): first of the right half; the order is changed so that both halves are together.
    u32 part(u32 begin, u32 end) {
        if (end - begin == 2) return begin + 1;
        Vec3 low = center(begin), high = low;
        for (u32 i = begin + 1; i < end; ++i) {
            const Vec3 c = center(i);
            low = {least(low.x, c.x), least(low.y, c.y), least(low.z, c.z)};
            high = {most(high.x, c.x), most(high.y, c.y), most(high.z, c.z)};
        }
        const Vec3 extent = high - low;
        const float longest = most(extent.x, most(extent.y, extent.z));
        float best = kFar;
        int best_axis = -1;
        u32 best_bin = 0;
        for (int axis = 0; axis < 3; ++axis) {
            const float width = along(extent, axis);
            if (!(width > 0)) continue;
            LightNode bins[kBins];
            u32 counts[kBins] = {};
            for (u32 i = begin; i < end; ++i) {
                const u32 b = bin_of(i, axis, along(low, axis), width);
                bins[b] = counts[b]++ ? united(bins[b], items[order[i]]) : items[order[i]];
            }
            LightNode right[kBins];
            u32 right_count[kBins] = {};
            for (u32 b = kBins - 1; b > 0; --b) {
                const bool more = b + 1 < kBins && right_count[b + 1];
                right_count[b] = counts[b] + (more ? right_count[b + 1] : 0);
                right[b] = !more ? bins[b] : counts[b] ? united(bins[b], right[b + 1]) : right[b + 1];
            }
            LightNode left;
            u32 left_count = 0;
            for (u32 b = 0; b + 1 < kBins; ++b) {
                if (counts[b]) left = left_count ? united(left, bins[b]) : bins[b];
                left_count += counts[b];
                if (left_count == 0 || right_count[b + 1] == 0) continue;
                const float c = (cost(left) + cost(right[b + 1])) * longest / width;
                if (c < best) best = c, best_axis = axis, best_bin = b;
            }
        }
        if (best_axis < 0) return begin + (end - begin) / 2; // all in one place
        const float start = along(low, best_axis), width = along(extent, best_axis);
        u32 middle = begin;
        for (u32 i = begin; i < end; ++i)
            if (bin_of(i, best_axis, start, width) <= best_bin) std::swap(order[i], order[middle++]);
        return middle;
    }
    u32 bin_of(u32 i, int axis, float start, float width) const {
        return std::min(u32((along(center(i), axis) - start) / width * float(kBins)), kBins - 1);
    }

    LightNode build(u32 begin, u32 end, u32 self) {
        if (end - begin == 1) {
            const u32 item = order[begin];
            tree.placed[item] = self;
            if (self != BuiltTree::kRootParent) tree.own[self] = 1;
            return items[item];
        }
        const u32 middle = part(begin, end), pair = u32(tree.nodes.size());
        tree.nodes.resize(pair + 2);
        tree.own.resize(pair + 2, 0);
        const LightNode a = build(begin, middle, pair), b = build(middle, end, pair + 1);
        tree.nodes[pair] = a;
        tree.nodes[pair + 1] = b;
        tree.nodes[pair].parent = tree.nodes[pair + 1].parent = self;
        LightNode out = united(a, b);
        out.first = pair;
        return out;
    }
};

} // namespace

BuiltTree build_light_tree(const std::vector<LightNode>& items) {
    BuiltTree tree;
    tree.placed.resize(items.size());
    tree.nodes.reserve(items.size() * 2);
    Builder builder{items, tree, {}};
    builder.order.resize(items.size());
    std::iota(builder.order.begin(), builder.order.end(), 0u);
    tree.root = builder.build(0, u32(items.size()), BuiltTree::kRootParent);
    return tree;
}

} // namespace vitrail::trace
