#include "world/block_state.h"

#include <gtest/gtest.h>

using namespace vitrail;

TEST(BlockState, ParsesAndSortsProperties) {
    const auto state = parse_block_state("minecraft:oak_stairs[half=top,facing=east]");
    ASSERT_TRUE(state);
    EXPECT_EQ(state->to_string(), "minecraft:oak_stairs[facing=east,half=top]");
    EXPECT_EQ(state->get("half"), "top");
    EXPECT_EQ(state->get("shape", "straight"), "straight");
    EXPECT_EQ(parse_block_state("stone")->name, "minecraft:stone");
}

TEST(BlockState, RefusesWhatIsNoState) {
    for (const char* text : {"", "[a=b]", "a b", "stone[", "stone[a]", "stone[a=]", "stone[=b]", "stone[a=b,]",
                             "stone[a=b,a=c]", "stone[a=b]x", "sto\nne", "stone[a=\x01]"})
        EXPECT_FALSE(parse_block_state(text)) << text;
    EXPECT_FALSE(parse_block_state(std::string(2000, 'a')));
}
