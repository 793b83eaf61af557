// Entities' boxes under a small tree, made anew whenever they move.
#pragma once

#include "scene/frame_view.h"
#include "trace/kernel/scene_view.h"

#include <span>
#include <vector>

namespace vitrail::trace {

// The block that holds it and the place in there.
Place place_of(WorldPos at);

class BoxTree {
public:
    // Takes the boxes of that dimension; such as have no volume, or look like nothing that there is, are left out.
    // around: the eye; boxes should lie within 2^20 blocks of it. True where other boxes are seen than before.
    bool update(std::span<const scene::EntityBox> entities, DimensionId dimension, Place around,
                std::span<const StateRecord> states);

    // SceneView's fields of boxes. Pointers hold until the next update.
    void fill(SceneView& scene) const;
    u32 nodes() const { return u32(nodes_.size()); }
    u64 generation() const { return generation_; } // grows when anything that fill gives changes
    u64 memory_bytes() const { return boxes_.capacity() * sizeof(EntityBox) + nodes_.capacity() * sizeof(BoxNode); }

private:
    void build();

    std::vector<EntityBox> boxes_; // as the leaves have them
    std::vector<EntityBox> given_; // in the order of the last update
    std::vector<BoxNode> nodes_;
    Place from_;
    u64 generation_ = 0;
};

} // namespace vitrail::trace
