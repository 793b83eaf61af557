// A maze under ground, drawn with and without culling: the same picture byte for byte, in every frame of a fast turn.
#include "bench/voxel/sample_maze.h"
#include "math/angle.h"
#include "meshing/mesh_world.h"
#include "render/culling.h"
#include "render_fixture.h"

#include <map>

namespace vitrail::render {
namespace {

// Rooms and corridors with lamps, plants, glass, leaves and water in them.
class MazeScene {
public:
    MazeScene(u64 seed, IVec3 size)
        : rng_(seed)
        , maze(size) {
        world_.registry->content_roots = {test_content()};
        maze.carve_maze(rng_, 25);
        const StateId stone = world_("minecraft:stone"), dirt = world_("minecraft:dirt");
        const StateId things[] = {world_("minecraft:fern"),     world_("minecraft:red_stained_glass"),
                                  world_("minecraft:ice"),      world_("minecraft:oak_leaves"),
                                  world_("minecraft:water"),    world_("minecraft:oak_fence"),
                                  world_("minecraft:oak_slab"), world_("minecraft:glass")};
        maze.each_section([&](ChunkPos at) {
            chunks_[index(at)] = std::make_unique<Chunk>(test::make_chunk([&](LocalPos p) {
                const BlockPos b = block_at(at, p);
                if (maze.rock(b)) return random_unit({seed, 1}, b.x >> 1, b.y >> 1, b.z >> 1) < 0.3f ? dirt : stone;
                const float roll = random_unit({seed, 2}, b.x, b.y, b.z);
                if (roll > 0.12f) return StateId::air;
                return things[std::min(u32(roll / 0.12f * 8), 7u)];
            }));
        });
    }
    void give(Renderer& renderer) {
        EXPECT_TRUE(renderer.load_textures(*world_.registry));
        MeshScratch scratch;
        SectionMesh mesh;
        world_.models.ensure(*world_.states);
        maze.each_section([&](ChunkPos at) {
            MeshInput in;
            in.models = &world_.models;
            for (i32 dy = -1; dy <= 1; ++dy)
                for (i32 dz = -1; dz <= 1; ++dz)
                    for (i32 dx = -1; dx <= 1; ++dx) {
                        const auto near = chunks_.find(index({at.x + dx, at.y + dy, at.z + dz}));
                        if (near != chunks_.end()) in.chunks[MeshInput::index(dx, dy, dz)] = near->second.get();
                    }
            mesh_section(in, mesh, scratch);
            renderer.sync_models(world_.models);
            renderer.set_section(at, DimensionId::overworld, mesh);
        });
    }
    // In the middle of a room.
    WorldPos eye(ChunkPos at) const {
        const WorldPos p = corner_of(origin_of(at));
        return {p.x + 8 * kFixedOne + kFixedOne / 3, p.y + 8 * kFixedOne + kFixedOne / 5, p.z + 8 * kFixedOne};
    }

private:
    static u64 index(ChunkPos p) { return u64(p.x + 1) << 40 | u64(p.y + 1) << 20 | u64(p.z + 1); }
    Rng rng_;
    test::MeshWorld world_;
    std::map<u64, std::unique_ptr<Chunk>> chunks_;

public:
    bench::SampleMaze maze;
};

using CullingTest = RenderTest;

void turn_and_compare(Preset preset, Image (*draw)(Renderer&, const scene::FrameView&)) {
    MazeScene scene(7, {9, 4, 9});
    Effects effects = preset_effects(preset);
    auto made = Renderer::create({.effects = effects});
    effects.culling = {.caves = false, .occlusion = false};
    auto plain = Renderer::create({.effects = effects});
    ASSERT_TRUE(made && plain);
    Renderer &culled = **made, &whole = **plain;
    scene.give(culled), scene.give(whole);
    u64 in_frustum = 0, in_sight = 0, drawn = 0;
    Rng rng(3);
    for (const ChunkPos room : {ChunkPos{4, 1, 4}, ChunkPos{0, 0, 0}, ChunkPos{8, 3, 2}, ChunkPos{2, 2, 7}}) {
        WorldPos eye = scene.eye(room);
        float yaw = 10;
        for (u32 frame = 0; frame < 10; ++frame) {
            auto view = bench::SampleScene::frame(160, 90, eye, yaw, 40 * std::sin(float(frame)), 9);
            const Image with = draw(culled, view), without = draw(whole, view);
            if (with.pixels != without.pixels) {
                u64 differ = 0;
                for (std::size_t i = 0; i < with.pixels.size(); i += 3)
                    differ += !std::equal(&with.pixels[i], &with.pixels[i] + 3, &without.pixels[i]);
                if (std::getenv("VITRAIL_TEST_KEEP")) {
                    (void)write_png("/tmp/culling_with.png", with);
                    (void)write_png("/tmp/culling_without.png", without);
                }
                FAIL() << differ << " pixels differ, room " << room.x << " frame " << frame;
            }
            const FrameStats &s = culled.stats(), &w = whole.stats();
            EXPECT_LE(s.sections_visible, s.sections_in_sight);
            EXPECT_LE(s.sections_in_sight, s.sections_in_frustum);
            EXPECT_EQ(s.sections_in_frustum, w.sections_in_frustum);
            EXPECT_EQ(w.sections_visible, w.sections_in_frustum);
            in_frustum += s.sections_in_frustum, in_sight += s.sections_in_sight, drawn += s.sections_visible;
            yaw += 67; // faster than anybody turns
            if (frame % 3 == 2) eye = offset_by(eye, {rng.unit() - 0.5f, rng.unit() - 0.5f, rng.unit() - 0.5f});
        }
    }
    EXPECT_GT(in_frustum, 40 * 10u);
    EXPECT_LE(drawn * 10, in_frustum * 6);
}

TEST_F(CullingTest, MazeLooksTheSameAtLow) {
    turn_and_compare(Preset::low, draw);
}
TEST_F(CullingTest, MazeLooksTheSameAtHigh) {
    turn_and_compare(Preset::high, draw);
}

// The walk is done again where something moved, and only there.
TEST_F(CullingTest, WalksOnlyWhereSomethingMoved) {
    SectionStore store(1024);
    SectionMesh mesh;
    mesh.connections = kAllConnected;
    for (i32 x = 0; x < 5; ++x)
        store.set({{x, 0, 0}, DimensionId::overworld}, mesh);
    Culler culler;
    std::vector<VisibleSection> out;
    scene::FrameView frame = bench::SampleScene::frame(64, 64, eye_at(8, 8, 8), 0, 0, 6);
    const auto look = [&] {
        culler.find_visible(store, frame.views[0], 1, 96, true, out);
        return culler.walks();
    };
    EXPECT_EQ(look(), 1u);
    frame.views[0].rotation = view_rotation(1, 0.5f);
    EXPECT_EQ(look(), 1u) << "turning";
    frame.views[0].eye.at = eye_at(8.03, 8, 8.03);
    EXPECT_EQ(look(), 1u) << "a hair";
    frame.views[0].eye.at = eye_at(8.2, 8, 8);
    EXPECT_EQ(look(), 2u);
    store.set({{9, 0, 0}, DimensionId::overworld}, mesh);
    EXPECT_EQ(look(), 3u) << "a new section";
    mesh.openings[0] = 0x1010;
    store.set({{3, 0, 0}, DimensionId::overworld}, mesh);
    EXPECT_EQ(look(), 4u) << "another opening";
    store.set({{3, 0, 0}, DimensionId::overworld}, mesh);
    EXPECT_EQ(look(), 4u) << "the same again";
}

} // namespace
} // namespace vitrail::render
