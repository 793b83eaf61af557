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

using Draw = Image (*)(Renderer&, const scene::FrameView&);

// Eyes that turn faster than anybody and step about, each frame drawn by a renderer that culls and by one that does
// not.
struct Turning {
    u64 in_frustum = 0, in_sight = 0, drawn = 0;
    u32 frames = 0;
    u32 ties_most = 0; // pixels of a picture

    template <class Scene>
    void run(Preset preset, Effects::Culling culling, Scene& scene, const std::vector<WorldPos>& eyes, Draw draw) {
        Effects effects = preset_effects(preset);
        // What culling has no part in, and takes its time on software OpenGL.
        effects.shadows.on = effects.ssao.on = effects.reflections.on = effects.fog.volumetric = false;
        effects.culling = culling;
        auto made = Renderer::create({.effects = effects});
        effects.culling = {.caves = false, .occlusion = false};
        auto plain = Renderer::create({.effects = effects});
        ASSERT_TRUE(made) << made.error().message;
        ASSERT_TRUE(plain);
        Renderer &culled = **made, &whole = **plain;
        scene.give(culled), scene.give(whole);
        Rng rng(3);
        for (WorldPos eye : eyes) {
            float yaw = 10;
            for (u32 frame = 0; frame < 8; ++frame) {
                auto view = bench::SampleScene::frame(160, 90, eye, yaw, 40 * std::sin(float(frame)), 9);
                const Image with = draw(culled, view), without = draw(whole, view);
                // A hole would show in the depth. Where the edges of two faces have the very same depth, whichever was
                // drawn first stays, and what is drawn late may come second: seen in single pixels of leaves alone.
                ASSERT_EQ(culled.read_target("depth")->values, whole.read_target("depth")->values) << frames;
                u32 differ = 0;
                for (std::size_t i = 0; i < with.pixels.size(); i += 3)
                    differ += !std::equal(&with.pixels[i], &with.pixels[i] + 3, &without.pixels[i]);
                ASSERT_LE(differ, ties_most) << "frame " << frames;
                const FrameStats &s = culled.stats(), &w = whole.stats();
                EXPECT_LE(s.sections_visible, s.sections_in_sight);
                EXPECT_LE(s.sections_in_sight, s.sections_in_frustum);
                EXPECT_EQ(s.sections_in_frustum, w.sections_in_frustum);
                EXPECT_EQ(w.sections_visible, w.sections_in_frustum);
                in_frustum += s.sections_in_frustum, in_sight += s.sections_in_sight, drawn += s.sections_visible;
                ++frames;
                yaw += frame % 4 == 3 ? 2 : 67;
                if (frame % 3 == 2) eye = offset_by(eye, {rng.unit() - 0.5f, rng.unit() - 0.5f, rng.unit() - 0.5f});
            }
        }
    }
};

std::vector<WorldPos> rooms(const MazeScene& scene) {
    return {scene.eye({4, 1, 4}), scene.eye({0, 0, 0}), scene.eye({6, 3, 2})};
}

TEST_F(CullingTest, MazeLooksTheSameByLinesOfSight) {
    MazeScene scene(7, {7, 4, 7});
    Turning turning;
    turning.run(Preset::low, {.caves = true, .occlusion = false}, scene, rooms(scene), draw);
    EXPECT_GT(turning.in_frustum, turning.frames * 20);
    EXPECT_LE(turning.drawn * 10, turning.in_frustum * 6);
}

TEST_F(CullingTest, MazeLooksTheSameByOcclusionAlone) {
    MazeScene scene(7, {7, 4, 7});
    Turning turning;
    turning.run(Preset::low, {.caves = false, .occlusion = true}, scene, rooms(scene), draw);
    EXPECT_EQ(turning.in_sight, turning.in_frustum);
    EXPECT_LE(turning.drawn * 10, turning.in_frustum * 6);
}

TEST_F(CullingTest, MazeLooksTheSameByBoth) {
    MazeScene scene(8, {7, 4, 7});
    Turning turning;
    turning.run(Preset::high, {.caves = true, .occlusion = true}, scene, rooms(scene), draw);
    EXPECT_LE(turning.drawn * 10, turning.in_frustum * 6);
}

// Hills, trees and a lake under open sky, where lines of sight lead almost everywhere.
TEST_F(CullingTest, HillsLookTheSameByOcclusion) {
    bench::SampleScene scene(4);
    Turning turning;
    turning.ties_most = 4;
    const auto above = [&](i32 x, i32 z, double up) { return eye_at(x + 0.5, scene.ground(x, z) + up, z + 0.5); };
    turning.run(Preset::high, {.caves = true, .occlusion = true}, scene,
                {above(0, 0, 1.6), above(30, -20, 1.6), above(-40, 35, 12)}, draw);
    EXPECT_LT(turning.drawn, turning.in_frustum);
}

// The walk is done again where something moved, and only there.
TEST_F(CullingTest, WalksOnlyWhereSomethingMoved) {
    SectionStore store(1024, true);
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
