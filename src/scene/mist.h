// Mist by the time of day, for raster and tracer: thin haze everywhere, and mist that is dense up to the height of
// seas (View::sea_level) and falls
// exponentially above it. Kernel-safe: values only.
#pragma once

#include "scene/frame_view.h"

namespace vitrail::scene {

struct Mist {
    float haze = 0;    // extinction a block, everywhere
    float mist = 0;    // and up to the sea
    float height = 10; // blocks above it in which the mist thins to 1/e
};

// Most at dawn, some at dusk, little by night, a breath at noon. Smooth.
Mist mist_at(const SkyState& sky);

// Optical depth of `away` blocks from a place `above` blocks above the sea's height, along a unit direction that rises by `rise`
// a block: the exact integral of the extinction.
float mist_depth(const Mist& mist, float above, float rise, float away);

// Mist between the height of the sea and `above`, in blocks of the density there; negative below.
float mist_column(const Mist& mist, float above);

} // namespace vitrail::scene
