#include "terrain/cpu/features_stage.h"

#include "terrain/kernel/placement_kernel.h"

namespace vitrail {

namespace {
// A lane type of this file's own: what it instantiates is never a copy made under other vector flags.
struct PlaceLanes : ScalarLanes {};
} // namespace

void features_stage(const TerrainTables& tables, ColumnPos at, const GroundTile& ground, const CaveTile& caves,
                    FeatureTile& out) {
    place_features<PlaceLanes>(tables, at, ground, caves, out);
}

} // namespace vitrail
