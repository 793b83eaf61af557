#include "bench/harness.h"
#include "light/relight.h"
#include "world/state_table.h"

#include "base/rng.h"

#include <cmath>

using namespace vitrail;

namespace {

struct Blocks {
    std::shared_ptr<StateTable> states;
    StateId stone, leaves, lamp;
    Blocks() {
        auto registry = std::make_shared<BlockRegistry>();
        const auto add = [&](const char* name, u8 opacity, std::array<u8, 3> light) {
            BlockDef def;
            def.name = name;
            def.look.opacity = opacity;
            def.look.light = light;
            registry->add_block(def);
        };
        add("test:stone", 15, {});
        add("test:leaves", 1, {});
        add("test:lamp", 15, {15, 15, 15});
        states = std::make_shared<StateTable>(registry);
        const auto id = [&](const char* name) { return *states->intern(*parse_block_state(name)); };
        stone = id("test:stone");
        leaves = id("test:leaves");
        lamp = id("test:lamp");
    }
};

// Hills of amplitude 24 with tunnels and trees; sections from -2 to 5.
i32 ground(i32 x, i32 z) {
    return i32(
        std::lround(24 * std::sin(float(x) * 0.05f) * std::cos(float(z) * 0.06f) + 6 * std::sin(float(x + z) * 0.21f)));
}

std::shared_ptr<Chunk> hill_chunk(const Blocks& b, ChunkPos at) {
    std::vector<StateId> cells(kChunkVolume);
    for (u32 i = 0; i < kChunkVolume; ++i) {
        const BlockPos p = block_at(at, LocalPos(i));
        const i32 h = ground(p.x, p.z);
        const bool cave =
            p.y < h &&
            std::sin(float(p.x) * 0.31f) + std::sin(float(p.y) * 0.37f) + std::sin(float(p.z) * 0.29f) > 1.9f;
        const i32 tx = p.x & 7, tz = p.z & 7; // a crown every 8 blocks
        const bool crown = p.y > h + 4 && p.y < h + 8 && tx > 1 && tx < 7 && tz > 1 && tz < 7;
        cells[i] = p.y < h && !cave ? b.stone : crown ? b.leaves : StateId::air;
    }
    auto chunk = std::make_shared<Chunk>();
    chunk->blocks = BlockStorage::from_states(std::span<const StateId, kChunkVolume>(cells));
    return chunk;
}

constexpr i32 kSide = 8;

Dimension hills(const Blocks& b, std::vector<ChunkPos>& all, std::size_t& mixed) {
    DimensionInfo info;
    info.min_y = -48;
    info.max_y = 96;
    Dimension d(info, b.states);
    for (i32 x = 0; x < kSide; ++x)
        for (i32 z = 0; z < kSide; ++z) {
            for (i32 y = -3; y < 6; ++y) {
                auto chunk = hill_chunk(b, {x, y, z});
                mixed += !chunk->blocks.uniform();
                d.put({x, y, z}, chunk);
                all.push_back({x, y, z});
            }
            d.put_heights({x, z}, compute_heights(d, {x, z}));
        }
    return d;
}

void lamp_bench(bench::Context& c, bool tunnel) {
    const Blocks b;
    DimensionInfo info;
    Dimension d(info, b.states);
    std::vector<ChunkPos> all;
    for (i32 x = -2; x < 2; ++x)
        for (i32 z = -2; z < 2; ++z)
            for (i32 y = -4; y < 4; ++y) {
                auto chunk = std::make_shared<Chunk>();
                if (y < 0) chunk->blocks = BlockStorage(b.stone);
                d.put({x, y, z}, chunk);
                all.push_back({x, y, z});
            }
    relight_chunks(d, all);
    BlockPos at{1, 12, 1};
    if (tunnel) {
        at = {0, -20, 0};
        EditBatch dig;
        for (i32 x = -32; x < 32; ++x)
            for (i32 y = -20; y < -18; ++y)
                dig.edits.push_back({{x, y, 0}, StateId::air});
        ChangeSet changes = apply(d, dig);
        relight(d, changes);
    }
    c.measure(1, [&] {
        for (const StateId state : {b.lamp, StateId::air}) {
            ChangeSet changes = apply(d, EditBatch{{{at, state}}});
            relight(d, changes);
            bench::keep(changes);
        }
    });
}

} // namespace

void register_light_benches(bench::Suite& suite) {
    suite.add("light.sky", "us",
              "a chunk of hills with caves and trees, lit from nothing; uniform chunks are lit too, not counted",
              [](bench::Context& c) {
                  const Blocks b;
                  std::vector<ChunkPos> all;
                  std::size_t mixed = 0;
                  const Dimension unlit = hills(b, all, mixed);
                  Dimension d = unlit;
                  c.measure(
                      double(mixed), [&] { d = unlit; }, [&] { bench::keep(relight_chunks(d, all)); });
              });
    suite.add("light.lamp", "us", "a white lamp placed and removed in the open, 12 above the ground, edit included",
              [](bench::Context& c) { lamp_bench(c, false); });
    suite.add("light.lamp_tunnel", "us", "a white lamp placed and removed in a 1x2 tunnel, edit included",
              [](bench::Context& c) { lamp_bench(c, true); });
}
