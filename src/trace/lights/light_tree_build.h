// Builds one tree of lights over given ones: leaves are emitters, or the roots of trees that exist already.
#pragma once

#include "trace/kernel/light_view.h"

#include <vector>

namespace vitrail::trace {

// One node that holds all of these (leaf, first and parent are not set).
LightNode united(const LightNode& a, const LightNode& b);

struct BuiltTree {
    LightNode root;               // inner: `first` is an index into `nodes`; of a single item: that item as it came
    std::vector<LightNode> nodes; // pairs of children; parent: kRootParent, or an index into `nodes`
    std::vector<u32> placed;      // by item: its index in `nodes`; kRootParent: it is the root
    // Index of an inner child pair in this tree; of an item its own `first` (kOwn in `own` by node).
    std::vector<u8> own; // by node: 1 an item, whose `first` is as it came
    static constexpr u32 kRootParent = 0xFFFFFFFFu;
};

// items: not empty; their power above 0. Splits where power x surface x spread of directions is least (binned).
BuiltTree build_light_tree(const std::vector<LightNode>& items);

} // namespace vitrail::trace
