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
#include "terrain/cpu/pack_stage.h"
#include "terrain/cpu/stages.h"

namespace vitrail {

template <int I>
TerrainStages make_stages() {
    using L = WideLanes<I>;
    TerrainStages s;
    s.isa = Isa(I);
    s.land = &land_stage<L>;
    s.ground = &ground_stage<L>;
    s.lattice = &lattice_stage<L>;
    s.caves = &caves_stage<L>;
    s.features = &features_stage;
    s.fill = &fill_stage<L>;
    s.draw = &draw_stage<L>;
    s.decorate = &decorate_stage<L>;
    s.biomes = &biomes_stage<L>;
    s.pack = &pack_stage<L>;
    return s;
}

} // namespace vitrail
