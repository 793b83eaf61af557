// Mist by the time of day, for raster and tracer: thin haze everywhere, and mist that is dense up to the height of
// seas (View::sea_level) and falls exponentially above it.
#pragma once

#include "scene/frame_view.h"
#include "scene/mist_air.h"

namespace vitrail::scene {

// Most at dawn, some at dusk, little by night, a breath at noon. Smooth.
Mist mist_at(const SkyState& sky);

} // namespace vitrail::scene
