// The builder of each shape.
#pragma once

#include "terrain/kernel/shapes/birch.h"
#include "terrain/kernel/shapes/caves.h"
#include "terrain/kernel/shapes/conifers.h"
#include "terrain/kernel/shapes/crystals.h"
#include "terrain/kernel/shapes/jungle.h"
#include "terrain/kernel/shapes/mushrooms.h"
#include "terrain/kernel/shapes/palms.h"
#include "terrain/kernel/shapes/savanna.h"
#include "terrain/kernel/shapes/sea.h"
#include "terrain/kernel/shapes/swamp.h"

namespace vitrail {

template <class L>
VX_HD_FN void build_shape(ShapeBuilder<L>& b) {
    switch (b.row.shape) {
    case Shape::coral:
        build_coral(b);
        break;
    case Shape::kelp:
        build_kelp(b);
        break;
    case Shape::iceberg:
        build_iceberg(b);
        break;
    case Shape::acacia:
        build_acacia(b);
        break;
    case Shape::redwood:
        build_redwood(b);
        break;
    case Shape::cypress:
        build_cypress(b);
        break;
    case Shape::birch:
        build_birch(b);
        break;
    case Shape::pine:
        build_pine(b);
        break;
    case Shape::shrub:
        build_shrub(b);
        break;
    case Shape::rafflesia:
        build_rafflesia(b);
        break;
    case Shape::jungle_tree:
        build_jungle_tree(b);
        break;
    case Shape::small_jungle_tree:
        build_small_jungle_tree(b);
        break;
    case Shape::mushroom:
        build_mushroom(b);
        break;
    case Shape::medium_mushroom:
        build_medium_mushroom(b);
        break;
    case Shape::crystal:
        build_crystal(b);
        break;
    case Shape::palm:
        build_palm(b);
        break;
    case Shape::cactus:
        build_cactus(b);
        break;
    case Shape::stormlight:
        build_stormlight(b);
        break;
    case Shape::crystal_pillar:
        build_crystal_pillar(b);
        break;
    case Shape::glowstone_cluster:
        build_glowstone_cluster(b);
        break;
    case Shape::cave_vine:
        build_cave_vine(b);
        break;
    case Shape::fungus:
        build_fungus(b);
        break;
    case Shape::count:
        break;
    }
}

} // namespace vitrail
