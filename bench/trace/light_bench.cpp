// Lamps: lists and trees of 10,000 made anew, one placed and broken again, one chosen and asked for its chance.
#include "bench/trace/benches.h"
#include "trace/grid/grid.h"
#include "trace/kernel/light_tree.h"
#include "trace/lights/light_store.h"

#include "base/rng.h"

#include <map>

namespace vitrail {

namespace {

using namespace trace;

constexpr StateId kStone{1}, kLamp{2};
constexpr u32 kLamps = 10000;

// 256^3 blocks, a stone floor every 16 blocks, lamps strewn between them.
struct LampLand {
    std::vector<StateRecord> states{3};
    std::vector<MediumRecord> media{1};
    std::vector<u32> white{0xFFFFFFFF}, shining{0xFFFF8080};
    std::map<std::array<i32, 3>, std::shared_ptr<Chunk>> chunks;
    std::vector<IVec3> lamps;
    Grid grid{{4, 4, 4}};
    SceneView view;

    LampLand() {
        states[1].kind = states[2].kind = CellKind::cube;
        for (u16& e : states[2].emission)
            e = 16;
        view.states = states.data(), view.state_count = u32(states.size()), view.media = media.data();
        view.textures = {white.data(), shining.data(), 0, 1, 1, 1};
        grid.set_states(states, media);
        grid.center_on({8, 8, 8});
        for (i32 y = 0; y < 16; ++y)
            for (i32 z = 0; z < 16; ++z)
                for (i32 x = 0; x < 16; ++x) {
                    auto& chunk = chunks[{x, y, z}] = std::make_shared<Chunk>();
                    for (u32 i = 0; i < 256; ++i)
                        chunk->blocks.set(LocalPos(i & 15, 0, i >> 4), kStone);
                }
        Rng rng(3);
        while (lamps.size() < kLamps) {
            const IVec3 at{i32(rng.below(256)), i32(rng.below(256)), i32(rng.below(256))};
            if ((at.y & 15) == 0) continue;
            lamps.push_back(at);
            put(at, kLamp);
        }
        std::vector<Grid::Item> items;
        for (const auto& [at, chunk] : chunks)
            items.push_back({{at[0], at[1], at[2]}, &chunk->blocks});
        grid.set_chunks(items);
        grid.refresh();
    }
    void put(IVec3 at, StateId state) {
        chunks[{at.x >> 4, at.y >> 4, at.z >> 4}]->blocks.set(LocalPos(at.x & 15, at.y & 15, at.z & 15), state);
    }
    void fill(LightStore& lights) {
        lights.set_states(view, 0);
        for (const auto& [at, chunk] : chunks)
            lights.mark({at[0], at[1], at[2]}, chunk);
        lights.update(grid.view());
    }
};

LampLand& land() {
    static LampLand land;
    return land;
}

void build(bench::Context& c) {
    LampLand& l = land();
    c.measure(1, [&] {
        LightStore lights;
        l.fill(lights);
        bench::keep(lights.count());
    });
}

void update(bench::Context& c) {
    LampLand& l = land();
    LightStore lights;
    l.fill(lights);
    constexpr u32 kEdits = 32;
    c.measure(2 * kEdits, [&] {
        for (u32 i = 0; i < kEdits; ++i)
            for (const StateId state : {StateId::air, kLamp}) {
                const IVec3 at = l.lamps[i * 211];
                const ChunkPos chunk{at.x >> 4, at.y >> 4, at.z >> 4};
                l.put(at, state);
                const BlockPos block{at.x, at.y, at.z};
                l.grid.apply(EditBatch{{{block, state}}});
                lights.mark(chunk, l.chunks[{chunk.x, chunk.y, chunk.z}]);
                lights.update(l.grid.view());
                lights.take_changes();
            }
    });
    l.grid.refresh();
}

void choose(bench::Context& c, bool chance) {
    LampLand& l = land();
    LightStore lights;
    l.fill(lights);
    const LightView view = lights.view();
    constexpr u32 kAsked = 4096;
    c.measure(kAsked, [&] {
        float sum = 0;
        for (u32 i = 0; i < kAsked; ++i) {
            const Place at{{i32(i * 53 % 256), i32(i * 31 % 256), i32(i * 7 % 256)}, {0.5f, 0.5f, 0.5f}};
            const Vec3 normal{0, 1, 0};
            float part = (float(i) + 0.5f) / kAsked, p = 0;
            if (chance)
                p = chance_of_emitter(view, i * 2 % kLamps, light_place(view, at), normal);
            else
                choose_emitter(view, light_place(view, at), normal, part, p);
            sum += p;
        }
        bench::keep(sum);
    });
}

} // namespace

void register_light_benches(bench::Suite& suite) {
    suite.add("trace.lights.build", "ms", "lists and trees of 10,000 lamps in 4,096 chunks, one core", build);
    suite.add("trace.lights.update", "us", "one of 10,000 lamps broken or placed, with its grid", update);
    suite.add("trace.lights.choose", "ns", "one of 10,000 from a place, by the tree",
              [](bench::Context& c) { choose(c, false); });
    suite.add("trace.lights.chance", "ns", "of a lamp to be chosen", [](bench::Context& c) { choose(c, true); });
}

} // namespace vitrail
