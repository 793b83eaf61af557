// A small tiling cloud noise.
#pragma once

#include "gfx/handles.h"

namespace vitrail::render {

gfx::Texture make_noise_texture(); // 256 x 256, one channel, repeats

} // namespace vitrail::render
