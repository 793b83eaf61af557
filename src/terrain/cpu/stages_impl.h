// Included by the three stages_*.cpp only, each under flags of its own.
#pragma once

#include "terrain/cpu/biomes_stage.h"
#include "terrain/cpu/caves_stage.h"
#include "terrain/cpu/decorate_stage.h"
#include "terrain/cpu/draw_stage.h"
#include "terrain/cpu/features_stage.h"
#include "terrain/cpu/fill_stage.h"
#include "terrain/cpu/ground_stage.h"
#include "terrain/cpu/land_stage.h"
#include "terrain/cpu/stages.h"

namespace vitrail {

template <int I>
TerrainStages make_stages() {
    using L = WideLanes<I>;
    return {Isa(I),         &land_stage<L>, &ground_stage<L>,      &lattice_stage<L>, &caves_stage<L>,
            &features_stage, &fill_stage<L>, &draw_stage<L>, &decorate_stage<L>, &biomes_stage<L>};
}

} // namespace vitrail
