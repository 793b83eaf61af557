// Small worlds for the store's tests.
#pragma once

#include "base/rng.h"
#include "store/world_records.h"

#include <gtest/gtest.h>

namespace vitrail::testing {

inline std::shared_ptr<const BlockRegistry> empty_registry() {
    static const auto registry = std::make_shared<const BlockRegistry>();
    return registry;
}

inline StateId state_named(StateTable& states, const std::string& text) {
    return *states.intern(*parse_block_state(text));
}

// A chunk of some states below `state_count`, the same for the same seed.
inline ChunkPtr random_chunk(u64 seed, u32 state_count = 2) {
    Rng rng(seed);
    auto chunk = std::make_shared<Chunk>();
    chunk->revision = seed + 1;
    const u32 sets = rng.below(300);
    for (u32 i = 0; i < sets; ++i)
        chunk->blocks.set(LocalPos(rng.below(4096)), StateId(rng.below(state_count)));
    chunk->blocks.compact();
    if (rng.below(2)) {
        auto light = std::make_shared<LightVolume>(Light(15, 0, 0, 0));
        for (u32 i = 0; i < sets; ++i)
            light->set(LocalPos(rng.below(4096)), Light(u16(rng.next())));
        chunk->light = light;
    }
    if (rng.below(4) == 0) chunk->block_entities.push_back({LocalPos(rng.below(4096)), Bytes(rng.below(50), u8(seed))});
    return chunk;
}

inline bool same_chunk(const Chunk& a, const Chunk& b) {
    const bool light = (!a.light && !b.light) || (a.light && b.light && *a.light == *b.light);
    return light && a.blocks == b.blocks && a.biomes == b.biomes && a.block_entities == b.block_entities &&
           a.ticks == b.ticks && a.entities == b.entities && a.revision == b.revision;
}

inline std::unique_ptr<WorldRecords> open_world(const std::string& folder, OpenOptions options = {.create = true}) {
    auto world = WorldRecords::open(folder, empty_registry(), options);
    EXPECT_TRUE(world) << world.error().message;
    return world ? std::move(*world) : nullptr;
}

} // namespace vitrail::testing
