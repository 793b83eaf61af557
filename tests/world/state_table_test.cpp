#include "world/state_table.h"

#include <gtest/gtest.h>
#include <thread>

using namespace vitrail;

static std::shared_ptr<BlockRegistry> sample_registry() {
    auto registry = std::make_shared<BlockRegistry>();
    BlockDef log;
    log.name = "minecraft:oak_log";
    log.properties = {{"axis", {"x", "y", "z"}, "y"}};
    log.look.shape = ShapeKind::pillar;
    log.look.textures = {"oak_log", "oak_log_top"};
    registry->add_block(log);
    BlockDef lamp;
    lamp.name = "minecraft:redstone_lamp";
    lamp.properties = {{"lit", {"true", "false"}, "false"}};
    lamp.look.textures = {"lamp"};
    BlockVariant lit{{{"lit", "true"}}, lamp.look};
    lit.look.textures = {"lamp_on"};
    lit.look.light = {15, 12, 8};
    lamp.variants = {lit};
    registry->add_block(lamp);
    BlockDef furnace;
    furnace.name = "minecraft:furnace";
    furnace.look.textures = {"front", "side", "top", "bottom"};
    registry->add_block(furnace);
    return registry;
}

TEST(StateTable, AirAndHiddenComeFirst) {
    StateTable table(sample_registry());
    EXPECT_EQ(table.size(), 2u);
    EXPECT_EQ(table.flags(StateId::air) & (kOpaqueCube | kSolid | kAirLike), kAirLike);
    EXPECT_EQ(table.flags(StateId::hidden) & (kOpaqueCube | kSolid), kOpaqueCube | kSolid);
    EXPECT_EQ(table.light_data()[0].opacity, 0);
    EXPECT_EQ(table.light_data()[1].opacity, 15);
}

TEST(StateTable, IdsAreGivenOnceAndStay) {
    StateTable table(sample_registry());
    const StateId a = *table.intern(*parse_block_state("oak_log[axis=y]"));
    const StateId b = *table.intern(*parse_block_state("oak_log[axis=x]"));
    EXPECT_NE(a, b);
    EXPECT_EQ(*table.intern(*parse_block_state("oak_log[axis=y]")), a);
    EXPECT_EQ(*table.intern_with_defaults(*parse_block_state("oak_log")), a);
    EXPECT_EQ(table.find("minecraft:oak_log[axis=x]"), b);
}

TEST(StateTable, FacesTurnWithAxisAndFacing) {
    StateTable table(sample_registry());
    const auto& r = table.registry();
    const TextureId bark = *r.find_texture("oak_log"), rings = *r.find_texture("oak_log_top"),
                    front = *r.find_texture("front");
    const auto& lying = table.info(*table.intern(*parse_block_state("oak_log[axis=x]"))).face_textures;
    EXPECT_EQ(lying[u8(Face::west)], rings);
    EXPECT_EQ(lying[u8(Face::up)], bark);
    for (auto [facing, face] :
         {std::pair{"north", Face::north}, {"south", Face::south}, {"west", Face::west}, {"east", Face::east}}) {
        const auto& faces =
            table.info(*table.intern(*parse_block_state(std::string("furnace[facing=") + facing + "]"))).face_textures;
        for (u8 f = 0; f < 6; ++f)
            EXPECT_EQ(faces[f] == front, f == u8(face)) << facing << int(f);
    }
}

TEST(StateTable, VariantsDecideLookAndLight) {
    StateTable table(sample_registry());
    const StateId lit = *table.intern(*parse_block_state("redstone_lamp[lit=true]"));
    const StateId dark = *table.intern(*parse_block_state("redstone_lamp[lit=false]"));
    EXPECT_TRUE(table.flags(lit) & kEmitsLight);
    EXPECT_FALSE(table.flags(dark) & kEmitsLight);
    EXPECT_EQ(table.light_data()[u32(lit)].green, 12);
}

TEST(StateTable, UnknownStatesKeepTheirTextAndAreSolidCubes) {
    StateTable table(sample_registry());
    const StateId id = *table.intern(*parse_block_state("mod:thing[power=3]"));
    EXPECT_EQ(table.info(id).state.to_string(), "mod:thing[power=3]");
    EXPECT_EQ(table.flags(id) & (kUnknownState | kOpaqueCube | kSolid), kUnknownState | kOpaqueCube | kSolid);
}

TEST(StateTable, InterningFromManyThreadsGivesOneIdAText) {
    StateTable table(sample_registry());
    std::vector<std::vector<StateId>> ids(4);
    std::vector<std::thread> threads;
    for (auto& mine : ids)
        threads.emplace_back([&] {
            for (int i = 0; i < 2000; ++i) {
                const StateId id = *table.intern(BlockState{"mod:b" + std::to_string(i), {}});
                EXPECT_EQ(table.info(id).state.name, "mod:b" + std::to_string(i));
                mine.push_back(id);
            }
        });
    for (auto& t : threads)
        t.join();
    for (auto& mine : ids)
        EXPECT_EQ(mine, ids[0]);
    EXPECT_EQ(table.size(), 2002u);
}
