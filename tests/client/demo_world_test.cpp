// What must hold of the demo world and its stations whatever they look like.
#include "demo_world.h"

#include <algorithm>
#include <cmath>

namespace vitrail {
namespace {

TEST(DemoWorld, StationsAreWhereOneCanStandAndSee) {
    const DemoWorld& demo = demo_world();
    ASSERT_TRUE(demo.world) << demo.trouble;
    const Dimension& land = demo.world->dimension;
    EXPECT_GE(demo.world->stations.size(), 16u);
    const render::Effects high = render::preset_effects(render::Preset::high);
    for (const Station& s : demo.world->stations) {
        const BlockPos eye = block_of(world_pos_from_numbers(s.at[0], s.at[1], s.at[2]));
        EXPECT_FALSE(land.states().flags(land.state_at(eye)) & kSolid) << s.name << " looks out of a block";
        EXPECT_FALSE(s.text.empty()) << s.name;
        EXPECT_LT(std::max(std::abs(s.at[0]), std::abs(s.at[2])), 130) << s.name << " is far from the middle";
        if (!s.without.empty())
            EXPECT_FALSE(effects_without(s) == high) << s.name << ": without its effect is the same";
    }
}

TEST(DemoWorld, HoldsOnlyBlocksOfTheBaseGame) {
    const DemoWorld& demo = demo_world();
    ASSERT_TRUE(demo.world) << demo.trouble;
    const StateTable& states = demo.world->dimension.states();
    for (u32 id = 0; id < states.size(); ++id)
        if (StateId(id) != StateId::hidden)
            EXPECT_FALSE(states.flags(StateId(id)) & kUnknownState) << states.info(StateId(id)).state.to_string();
}

} // namespace
} // namespace vitrail
