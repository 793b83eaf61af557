// What clouds are made of: noise that repeats. Red: wide shapes; green: heaps, round above and sharp between.
#pragma once

#include "gfx/handles.h"

namespace vitrail::render {

gfx::Texture make_cloud_texture(); // 256 x 256, two bytes, with mip levels

} // namespace vitrail::render
