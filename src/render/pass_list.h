// The passes in the order in which they are declared and drawn: of a rasterized frame, and of one whose light was
// traced (passes/film), which share those of the eye.
#pragma once

#include "render/passes/pass.h"

#include <memory>
#include <vector>

namespace vitrail::render {

class FilmPass;

struct PassList {
    std::vector<std::unique_ptr<RenderPass>> all;
    std::vector<RenderPass*> raster, traced;
    FilmPass* film = nullptr;
};
PassList make_passes();

} // namespace vitrail::render
