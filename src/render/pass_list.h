// The passes of the raster renderer in the order in which they are declared and drawn.
#pragma once

#include "render/passes/pass.h"

#include <memory>
#include <vector>

namespace vitrail::render {

std::vector<std::unique_ptr<RenderPass>> make_passes();

} // namespace vitrail::render
