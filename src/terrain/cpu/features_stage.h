// The features of a column: placements and their solids. Scalar, so one build for all vector sets.
#pragma once

#include "terrain/tiles.h"

namespace vitrail {

// Reads the column's own tiles only. `out` need not be cleared.
void features_stage(const TerrainTables& tables, ColumnPos at, const GroundTile& ground, const CaveTile& caves,
                    FeatureTile& out);

} // namespace vitrail
