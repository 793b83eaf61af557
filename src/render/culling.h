// Which sections a view sees: frustum, distance, and the walk through open space (voxel/connectivity.h).
#pragma once

#include "render/section_store.h"
#include "scene/frame_view.h"

#include <vector>

namespace vitrail::render {

struct VisibleSection {
    Section* section = nullptr;
    IVec3 offset;      // blocks from the eye's block to the section's least corner
    u64 distance2 = 0; // of centers, doubled coordinates: exact, so that the order is the same everywhere
};

// Camera-relative planes n.p + d >= 0 inside: left, right, bottom, top, near. No far plane.
struct Frustum {
    std::array<Vec4, 5> planes;
};
Frustum make_frustum(const scene::View& view, float aspect);
bool box_in_frustum(const Frustum& frustum, Vec3 min, Vec3 max); // may say yes for boxes just outside

class Culler {
public:
    // Nearest first. distance in blocks, horizontally.
    void find_visible(SectionStore& store, const scene::View& view, float aspect, float distance, bool caves,
                      std::vector<VisibleSection>& out);

private:
    void walk(SectionStore& store, const scene::View& view, i32 radius_chunks);
    ChunkPos walked_from_;
    DimensionId walked_in_{};
    i32 walked_radius_ = -1;
    u64 walked_revision_ = 0, stamp_ = 1;
    u32 frames_since_ = 0;
    bool everything_ = true; // the last walk could not tell: draw all
};

} // namespace vitrail::render
