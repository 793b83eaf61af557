// Bit slices of light levels to the cells of a volume.
#pragma once

#include "voxel/cell_mask.h"
#include "voxel/light_volume.h"

namespace vitrail {

// slices[channel * 4 + bit] for the channels sky, red, green, blue; those whose bit is not set in lit_channels are dark
// and not read.
void expand_planes(const std::array<CellMask, 16>& slices, u32 lit_channels, LightVolume::Cells& out);

} // namespace vitrail
