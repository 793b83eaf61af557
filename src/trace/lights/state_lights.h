// What each block state gives as a lamp: which of its faces and quads shine, and how strongly.
#pragma once

#include "trace/kernel/scene_view.h"

#include <vector>

namespace vitrail::trace {

struct StateLight {
    float face_power[6] = {0, 0, 0, 0, 0, 0}; // mean luminance x area of cube faces; a liquid's: its surface and sides
    float quad_power = 0;                     // all quads, both sides of those that have two
    Vec3 quad_least, quad_most;               // box of those that shine, in the cell
    float quad_shares[6] = {0, 0, 0,
                            0, 0, 0}; // of quad_power, along each axis (sums above 1: slanting ones count twice)
    float top = 1;                    // liquids: height of the level surface, blocks
    u8 fluid = 0;                     // medium of the cell: equal for all levels of a liquid
    bool emits = false;
    bool liquid = false;
    bool hides = false; // opaque cube: covers what touches it
    bool joins = false; // cubes of glass: no face towards the same state
};

// By state. Emission is averaged over the texels that a face or quad shows.
std::vector<StateLight> make_state_lights(const SceneView& scene, u32 quad_count);

} // namespace vitrail::trace
