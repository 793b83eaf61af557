// The mist's extinction and its integrals, for raster and tracer. Kernel-safe.
#pragma once

#include "base/hd.h"
#include "math/exp.h"
#include "math/vec.h"

namespace vitrail::scene {

struct Mist {
    float haze = 0;    // extinction a block, everywhere
    float mist = 0;    // and up to the sea
    float height = 10; // blocks above it in which the mist thins to 1/e
};

// Share of the mist's density `above` blocks above the sea's height.
VX_HD float mist_density(const Mist& mist, float above) {
    return above > 0 ? exp_of(-above / mist.height) : 1.0f;
}

// Mist between the height of the sea and `above`, in blocks of the density there; negative below.
VX_HD float mist_column(const Mist& mist, float above) {
    return above < 0 ? above : mist.height * (1 - exp_of(-above / mist.height));
}

// Mean density over `away` blocks along a unit direction that rises by `rise` a block.
VX_HD float mean_mist_density(const Mist& mist, float above, float rise, float away) {
    const float climb = rise * away;
    return std::abs(climb) < 0.05f ? mist_density(mist, above + 0.5f * climb)
                                   : (mist_column(mist, above + climb) - mist_column(mist, above)) / climb;
}

// Optical depth of `away` blocks from a place `above` blocks above the sea's height: the exact integral of the
// extinction.
VX_HD float mist_depth(const Mist& mist, float above, float rise, float away) {
    return (mist.haze + mist.mist * mean_mist_density(mist, above, rise, away)) * away;
}

} // namespace vitrail::scene
