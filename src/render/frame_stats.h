// What a frame took; for the debug overlay, --stats, benchmarks and tests.
#pragma once

#include "base/types.h"

#include <string>
#include <utility>
#include <vector>

namespace vitrail::render {

struct FrameStats {
    u32 width = 0, height = 0;   // that were drawn, before they were enlarged to the picture
    u32 sections = 0;            // held
    // Of all views, with anything to draw: within frustum and distance; of these, where lines of sight lead; of these,
    // drawn.
    u32 sections_in_frustum = 0, sections_in_sight = 0, sections_visible = 0;
    u32 draws = 0;                // commands in multi-draws
    u64 quads = 0, triangles = 0; // drawn
    u32 shadow_draws = 0;         // into shadow maps drawn in this frame
    u64 shadow_quads = 0;
    u64 quads_held = 0;
    u64 gpu_bytes = 0;                               // buffers, textures and targets, without the driver's padding
    u64 cpu_bytes = 0;                               // what the renderer keeps of sections
    double cull_ms = 0, submit_ms = 0, total_ms = 0; // CPU time of the last render(); software OpenGL draws inside
    std::vector<std::pair<std::string, double>> passes_ms; // GPU time a pass, some frames old, with set_timing(true)
};

} // namespace vitrail::render
