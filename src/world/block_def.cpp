#include "world/block_def.h"

namespace vitrail {

const std::array<const char*, std::size_t(ShapeKind::count)> kShapeKindNames = {
    "none",   "cube",      "pillar", "slab",  "stairs",     "fence",  "wall",     "fence_gate",
    "pane",   "cross",     "crop",   "torch", "wall_torch", "door",   "trapdoor", "liquid",
    "layers", "carpet",    "ladder", "faces", "rail",       "button", "lever",    "pressure_plate",
    "sign",   "wall_sign", "chest",  "bed",   "lantern",    "chain",  "lily_pad", "boxes"};

const std::array<const char*, std::size_t(OpticsKind::count)> kOpticsKindNames = {
    "automatic", "matte", "metal", "leaf", "thin", "dielectric", "water",
};

} // namespace vitrail
