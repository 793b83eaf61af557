// What FeatureRow::numbers and FeatureRow::blocks mean for each shape: positions, shared by the builders beside this
// file and by compile/shape_info.cpp, so that the two cannot drift apart.
#pragma once

#include "base/types.h"

namespace vitrail::parts {

namespace coral {
enum Number : u8 { size_least, size_most };
enum Part : u8 { tube, brain, bubble, fire, horn };
} // namespace coral
namespace kelp {
enum Number : u8 { height_least, height_most };
enum Part : u8 { stalk, tip };
} // namespace kelp
namespace iceberg {
enum Number : u8 { radius_least, radius_most };
enum Part : u8 { ice, core, snow };
} // namespace iceberg
namespace acacia {
enum Number : u8 { height_least, height_most };
enum Part : u8 { trunk, trunk_x, trunk_z, leaves };
} // namespace acacia
namespace redwood {
enum Number : u8 { height_least, height_most, giant_share };
enum Part : u8 { trunk, trunk_x, trunk_z, leaves };
} // namespace redwood
namespace cypress {
enum Number : u8 { height_least, height_most, branches_least, branches_most };
enum Part : u8 { trunk, trunk_x, trunk_z, leaves };
} // namespace cypress
namespace birch {
enum Number : u8 { height_least, height_most, tall_share, yellow_share, orange_share };
enum Part : u8 { trunk, leaves, leaves_yellow, leaves_orange };
} // namespace birch
namespace pine {
enum Number : u8 { height_least, height_most, lean };
enum Part : u8 { trunk, trunk_x, trunk_z, leaves };
} // namespace pine
namespace shrub {
enum Number : u8 { radius_least, radius_most };
enum Part : u8 { trunk, leaves };
} // namespace shrub
namespace rafflesia {
enum Number : u8 { stem_least, stem_most, petal_least, petal_most };
enum Part : u8 { stem, petal, core, leaves };
} // namespace rafflesia
namespace jungle_tree {
enum Number : u8 { height_least, height_most };
enum Part : u8 { trunk, trunk_x, trunk_z, leaves };
} // namespace jungle_tree
namespace small_jungle_tree {
enum Number : u8 { height_least, height_most, crown_least, crown_most };
enum Part : u8 { trunk, trunk_x, trunk_z, leaves };
} // namespace small_jungle_tree
namespace mushroom { // and medium_mushroom
enum Number : u8 { height_least, height_most, cap_radius_least, cap_radius_most };
enum Part : u8 { stem, stem_x, stem_z, cap, gills };
} // namespace mushroom
namespace crystal {
enum Number : u8 { height_least, height_most, radius_least, radius_most, shards_least, shards_most };
enum Part : u8 { first, second, third }; // a crystal takes one of the three
} // namespace crystal
namespace palm {
enum Number : u8 { height_least, height_most };
enum Part : u8 { trunk, trunk_x, trunk_z, leaves };
} // namespace palm
namespace cactus {
enum Number : u8 { height_least, height_most, arms_least, arms_most };
enum Part : u8 { body };
} // namespace cactus
namespace stormlight {
enum Number : u8 { radius_least, radius_most, hanging }; // hanging 0: a sphere on the floor; 1: hangs by a cord
enum Part : u8 { core, shell, cord };
} // namespace stormlight
namespace crystal_pillar {
enum Number : u8 { radius_least, radius_most };
enum Part : u8 { first, second, third };
} // namespace crystal_pillar
namespace glowstone_cluster {
enum Number : u8 { size_least, size_most };
enum Part : u8 { glow };
} // namespace glowstone_cluster
namespace cave_vine {
enum Number : u8 { length_least, length_most, glowing_share };
enum Part : u8 { vine, glowing, tip };
} // namespace cave_vine
namespace fungus {
enum Number : u8 { height_least, height_most, cap_radius_least, cap_radius_most };
enum Part : u8 { stem, cap, light };
} // namespace fungus

} // namespace vitrail::parts
