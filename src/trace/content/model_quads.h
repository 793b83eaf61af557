// Quads of models as rays meet them.
#pragma once

#include "scene/block_model.h"
#include "trace/kernel/scene_view.h"

#include <vector>

namespace vitrail::trace {

// Appends the model quad with the look that a state draws it with: one parallelogram where its corners and texture
// coordinates are one exactly, else the two triangles that the rasterizer draws; pieces without area are left out.
// medium: of a dielectric's body, else 0.
void add_trace_quads(const scene::ModelQuad& geometry, const scene::StateQuad& look, Optics optics, u32 medium,
                     std::vector<TraceQuad>& out);

} // namespace vitrail::trace
