// Random text as a world script: never a crash, never without end, and what it makes holds only known blocks.
#include "script/content_loader.h"
#include "script/world_script.h"

#include <cstdlib>

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
    using namespace vitrail;
    static const auto registry = [] {
        const ContentFile file{"blocks.lua", R"(
            define_block("minecraft:stone", { texture = "stone" })
            define_block("minecraft:dirt", { texture = "dirt" })
            define_block("minecraft:water", { shape = "liquid", layer = "translucent", properties = { level = { 0, 1, 8 } } })
            define_block("minecraft:oak_fence", { shape = "fence", properties = { north = { false, true }, east = { false, true },
              south = { false, true }, west = { false, true } } })
            define_block("minecraft:oak_stairs", { shape = "stairs", properties = { facing = { "north", "east", "south", "west" },
              half = { "bottom", "top" }, shape = { "straight", "inner_left", "inner_right", "outer_left", "outer_right" } } })
            define_biome("minecraft:plains", {}))"};
        auto content = load_content_texts({&file, 1});
        if (!content) std::abort();
        return content->registry;
    }();
    WorldScriptLimits limits;
    limits.instructions_most = 200'000;
    limits.memory_bytes_most = 4 << 20;
    limits.cpu_seconds_most = 2;
    limits.canvas.chunks_most = 500;
    limits.canvas.mixed_chunks_most = 50;
    limits.canvas.cells_most = 2'000'000;
    BiomeTable biomes;
    const auto states = std::make_shared<StateTable>(registry);
    const auto world =
        run_world_script({reinterpret_cast<const char*>(data), size}, "fuzz.lua", states, biomes, limits);
    if (!world) {
        if (world.error().message.empty() || world.error().message.find('\n') != std::string::npos) std::abort();
        return 0;
    }
    if (world->dimension.chunks().size() > limits.canvas.chunks_most || world->stations.size() > kStationsMost)
        std::abort();
    for (const auto& [at, chunk] : world->dimension.chunks())
        for (const StateId id : chunk->blocks.palette())
            if (!states->contains(id) || states->flags(id) & kUnknownState) std::abort();
    return 0;
}
