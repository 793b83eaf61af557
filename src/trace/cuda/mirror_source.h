// What a mirror on a device is told of the scene on the host.
#pragma once

#include "trace/grid/grid.h"
#include "trace/kernel/scene_view.h"
#include "trace/lights/light_store.h"

#include <span>

namespace vitrail::trace::cuda {

// The scene on the host, and what tells its changes. All of `view` is the host's.
struct MirrorSource {
    SceneView view;
    Grid* grid = nullptr;         // view.grid's, refreshed; its changes are taken
    LightStore* lights = nullptr; // view.lights'; null: none
    u64 quads = 0, media = 0;     // entries of view.quads, view.media
    // Another number: the tables, the pictures are others. While it stays the tables only grow.
    u64 tables = 0, pictures = 0;
    std::span<const u32> changed_layers; // of the pictures
    u64 box_nodes = 0;                   // entries of view.box_nodes; view.box_count are the boxes
    u64 boxes = 0;                       // another number: boxes and nodes are others
};

} // namespace vitrail::trace::cuda
