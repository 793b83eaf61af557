// Which sections a view sees: frustum, distance, and lines of sight through open faces (voxel/sight.h).
#pragma once

#include "render/section_store.h"
#include "scene/frame_view.h"
#include "voxel/sight.h"

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

// Blocks reach out of their section by up to this: what sways, hangs over, or grows by a hair against cracks.
inline constexpr float kSectionReach = 3.0f / 16;

// Sections with anything to draw.
struct CullCounts {
    u32 in_frustum = 0; // and within the distance
    u32 in_sight = 0;   // of these, where lines of sight lead
};

class Culler {
public:
    // Nearest first. distance in blocks, horizontally. caves: leave out what no line of sight reaches.
    CullCounts find_visible(const SectionStore& store, const scene::View& view, float aspect, float distance,
                            bool caves, std::vector<VisibleSection>& out);
    u64 walks() const { return walks_; } // done so far: none where neither the eye nor the sections moved

private:
    void walk(const SectionStore& store, const scene::View& view, i32 radius_chunks);
    SightFlood flood_;
    WorldPos walked_from_{};
    DimensionId walked_in_{};
    i32 walked_radius_ = -1;
    u64 walked_revision_ = 0, walks_ = 0;
    bool everything_ = true; // the last walk could not tell: draw all
};

} // namespace vitrail::render
