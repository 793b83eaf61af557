// The sky of a frame as kernels read it: the same numbers as the raster renderer's, from the same FrameView.
#pragma once

#include "scene/frame_view.h"
#include "trace/kernel/sky_view.h"

namespace vitrail::trace {

// Sky, air and clouds as view 0 sees them. Its pointers lead into `frame` (the dome) and to scene::cloud_noise(), in
// host memory; a device's backend puts its own copies in their place.
SkyView sky_view_of(const scene::FrameView& frame);

} // namespace vitrail::trace
