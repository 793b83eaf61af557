// Erosion by the slope method (Machado 2019): loose material above its angle of repose towards any of the eight
// neighbors goes. Layer by layer from the lowest; a layer's floor is the rock with the eroded layers below. A fixed
// number of whole Jacobi passes a layer, each reading nothing but the former pass's values, so a block's result depends
// on the blocks within passes * layers (+ 1 for the slope) of it and on nothing else, and can be made in any rectangle,
// order or number of threads.
//
// What a fixed number leaves: with 11 passes and the base content, 0.06 % of a layer's block columns stay above repose
// (400 zones; tests hold it below 0.1 %), most of them by less than a quarter of a block.
//
// A pass that changes nothing is the identity for ever after, and so is any pass where a layer is absent: both may be
// skipped.
#pragma once

#include "terrain/kernel/loose_kernel.h"

namespace vitrail {

// What a surface may rise above a neighbor's.
struct Repose {
    float straight = 0, diagonal = 0; // blocks
};
VX_HD Repose repose_of(const LooseRow& layer) {
    return {layer.repose, layer.repose * kDiagonal};
}

// One pass at one block (a row's blocks): the new surface. above, here, below: the block and its neighbors at -z and +z
// in the surface that the former pass left; also read one to either side. The least of sums with one number is the sum
// with the least, so each kind of neighbor is added up once.
template <class L>
VX_HD typename L::F eroded(const float* above, const float* here, const float* below, typename L::F floor,
                           Repose repose) {
    using F = typename L::F;
    const F straight = least(least(L::load(here - 1), L::load(here + 1)), least(L::load(above), L::load(below)));
    const F diagonal =
        least(least(L::load(above - 1), L::load(above + 1)), least(L::load(below - 1), L::load(below + 1)));
    const F most = least(straight + repose.straight, diagonal + repose.diagonal);
    return greatest(floor, least(L::load(here), most));
}

// A layer after its last pass is `surface - floor` thick; the next layer's floor is floor + that thickness, so that
// rock and layers, added up from the lowest, give every floor and the top to the bit.

} // namespace vitrail
