#include "bench/harness.h"
#include "render/meshing/light_brick.h"
#include "sample_terrain.h"

#include <map>

namespace vitrail {

namespace {

using namespace render;

const bench::SampleTerrain& terrain() {
    static const bench::SampleTerrain sample;
    return sample;
}

std::vector<MeshInput> terrain_inputs(bool occlusion, bool with_faces_only, u64* quads = nullptr) {
    const bench::SampleTerrain& t = terrain();
    std::vector<MeshInput> out;
    MeshScratch scratch;
    SectionMesh mesh;
    for (i32 y = 0; y < t.kY; ++y)
        for (i32 z = 0; z < t.kZ; ++z)
            for (i32 x = 0; x < t.kX; ++x) {
                MeshInput in = t.input(x, y, z);
                in.ambient_occlusion = occlusion;
                in.connections = false;
                mesh_section(in, mesh, scratch);
                if (quads) *quads += mesh.quads.size();
                if (!with_faces_only || !mesh.empty()) out.push_back(in);
            }
    return out;
}

void run(bench::Context& c, const std::vector<MeshInput>& inputs) {
    MeshScratch scratch;
    SectionMesh mesh;
    c.measure(double(inputs.size()), [&] {
        for (const MeshInput& in : inputs) {
            mesh_section(in, mesh, scratch);
            bench::keep(mesh.quads.data());
        }
    });
}

// 64 sections, each with 26 like it around.
struct Cubes {
    test::MeshWorld world;
    std::vector<test::Neighborhood> sections;
    std::vector<MeshInput> inputs;

    explicit Cubes(const std::function<StateId(Rng&, LocalPos, test::MeshWorld&)>& state_of)
        : sections(64) {
        Rng rng(11);
        for (test::Neighborhood& n : sections) {
            for (auto& chunk : n.chunks)
                chunk = std::make_unique<Chunk>(test::make_chunk([&](LocalPos p) { return state_of(rng, p, world); }));
            inputs.push_back(n.input(world.models));
            inputs.back().ambient_occlusion = false;
            inputs.back().connections = false;
        }
    }
    u64 quads() const {
        MeshScratch scratch;
        SectionMesh mesh;
        u64 sum = 0;
        for (const MeshInput& in : inputs) {
            mesh_section(in, mesh, scratch);
            sum += mesh.quads.size();
        }
        return sum;
    }
};

StateId random_state(Rng& rng, LocalPos, test::MeshWorld& w) {
    static constexpr const char* kNames[3] = {"stone", "dirt", "sand"};
    return rng.below(2) ? StateId::air : w(kNames[rng.below(3)]);
}

StateId checkered_state(Rng&, LocalPos p, test::MeshWorld& w) {
    return (p.x() + p.y() + p.z()) % 2 ? w("stone") : StateId::air;
}

StateId flat_state(Rng&, LocalPos p, test::MeshWorld& w) {
    return p.y() < 8 ? w("stone") : StateId::air;
}

// Time a quad: the same run, divided by quads.
void run_by_quad(bench::Context& c, const std::vector<MeshInput>& inputs, u64 quads) {
    MeshScratch scratch;
    SectionMesh mesh;
    c.measure(double(quads), [&] {
        for (const MeshInput& in : inputs) {
            mesh_section(in, mesh, scratch);
            bench::keep(mesh.quads.data());
        }
    });
}

// Terrain under random light: no volume is uniform, every cell takes the slow way.
struct LitTerrain {
    std::vector<std::unique_ptr<Chunk>> chunks;
    std::vector<MeshInput> inputs;

    LitTerrain() {
        const bench::SampleTerrain& t = terrain();
        std::map<const Chunk*, const Chunk*> lit;
        Rng rng(3);
        for (i32 z = 4; z < 12; ++z)
            for (i32 x = 4; x < 12; ++x) {
                MeshInput in = t.input(x, 6, z);
                for (const Chunk*& c : in.chunks) {
                    const Chunk*& copy = lit[c];
                    if (!copy) {
                        chunks.push_back(std::make_unique<Chunk>(*c));
                        LightVolume light;
                        for (Light& l : light.writable())
                            l = Light(u16(rng.next()));
                        chunks.back()->light = std::make_shared<LightVolume>(std::move(light));
                        copy = chunks.back().get();
                    }
                    c = copy;
                }
                inputs.push_back(in);
            }
    }
};

} // namespace

} // namespace vitrail

void register_meshing_benches(vitrail::bench::Suite& suite) {
    using namespace vitrail;
    suite.add("mesh.terrain", "us",
              "a 16^3 chunk of 512x256x512 land with caves and trees, empty ones included; geometry only",
              [](bench::Context& c) { run(c, terrain_inputs(false, false)); });
    suite.add("mesh.terrain_quad", "ns", "a quad of mesh.terrain", [](bench::Context& c) {
        u64 quads = 0;
        const auto inputs = terrain_inputs(false, false, &quads);
        run_by_quad(c, inputs, quads);
    });
    suite.add("mesh.surface", "us", "a chunk that has faces, ambient occlusion included",
              [](bench::Context& c) { run(c, terrain_inputs(true, true)); });
    suite.add("mesh.surface_quad", "ns", "a quad of mesh.surface", [](bench::Context& c) {
        u64 quads = 0;
        const auto inputs = terrain_inputs(true, true, &quads);
        run_by_quad(c, inputs, quads);
    });
    suite.add("mesh.random", "us", "a chunk of half air, three kinds of block at random; geometry only",
              [](bench::Context& c) {
                  const Cubes cubes(random_state);
                  run(c, cubes.inputs);
              });
    suite.add("mesh.random_quad", "ns", "a quad of mesh.random", [](bench::Context& c) {
        const Cubes cubes(random_state);
        run_by_quad(c, cubes.inputs, cubes.quads());
    });
    suite.add("mesh.flat", "us", "a chunk half full of stone below a level surface; geometry only",
              [](bench::Context& c) {
                  const Cubes cubes(flat_state);
                  run(c, cubes.inputs);
              });
    suite.add("mesh.checkerboard", "us", "a chunk of alternating air and stone: 12288 quads; geometry only",
              [](bench::Context& c) {
                  const Cubes cubes(checkered_state);
                  run(c, cubes.inputs);
              });
    suite.add("mesh.brick", "us", "the light brick of a terrain section, no light uniform", [](bench::Context& c) {
        const LitTerrain lit;
        LightBrick brick;
        c.measure(double(lit.inputs.size()), [&] {
            for (const MeshInput& in : lit.inputs) {
                build_light_brick(in, brick);
                bench::keep(brick.cells);
            }
        });
    });
}
