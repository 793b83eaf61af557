// The order in which the quads of a section that let light through are drawn: back to front.
//
// Merged quads across different axes can lie over each other in a ring (a lake, windows in it), which no order
// serves. Cut where the planes of the others pass, they are single cells of an uneven grid, and of two things in a
// grid's cells the one that is fewer cells away from the eye is never hidden by the other: one sort is exact.
#pragma once

#include "render/meshing/quad.h"

#include <array>
#include <vector>

namespace vitrail::render {

// Cuts cube quads along the planes of those across other axes. Where that would make more than kCutGrowth times as
// many and more than kCutFew, or would bend corner occlusion that differs along the cut, they stay whole.
void cut_where_planes_cross(std::vector<Quad>& quads);

inline constexpr u32 kCutGrowth = 4, kCutFew = 1024;

// Sorts them as seen from anywhere in the cell `eye` of the section, -1..16 on each axis: outside, the nearest cell
// beside it stands for all that lie farther on its side, which see the same order. Of two quads in one plane, as
// between glass and water, the one that looks away from the eye belongs to the nearer block and is drawn last.
// Exact where quads are cut; else parallel ones are, and the others go by their centers. Model quads count as their
// cell.
void sort_back_to_front(std::vector<Quad>& quads, std::array<i8, 3> eye);

} // namespace vitrail::render
