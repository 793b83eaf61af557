// The land and the rays that traversal is measured with.
#pragma once

#include "bench/harness.h"
#include "bench/sample_land.h"
#include "trace/grid/grid.h"
#include "trace/kernel/camera.h"
#include "trace/kernel/traverse.h"

namespace vitrail::bench {

// 512 x 256 x 512 blocks of the sample land, all blocks full cubes as others measure it, in a window of that size.
struct RayScene {
    RayScene();
    trace::SceneView view();
    void fill(); // the grid with all chunks

    std::vector<trace::StateRecord> states;
    std::vector<trace::MediumRecord> media;
    trace::Grid grid;

private:
    std::vector<BlockStorage> blocks_;
};

// Rays of one kind; pieces of 8 x 8 pixels follow each other, as a tracer works.
struct RaySet {
    std::vector<trace::Ray> rays;
    std::vector<trace::Hit> hits; // room for as many
};

// From a hill over the land's middle.
trace::Camera land_camera(u32 width = 854, u32 height = 480);
RaySet camera_rays(RayScene& scene, u32 width = 854, u32 height = 480);
// One from each place that rays of `from` hit, distributed by the cosine to its face.
RaySet bounce_rays(RayScene& scene, const RaySet& from);
// To the sun from each face hit that looks at it.
RaySet sun_rays(RayScene& scene, const RaySet& from);

} // namespace vitrail::bench
