// The demo world (content/demo/stations.lua), built once a process in a folder that goes with it.
#pragma once

#include "pipeline/built_world.h"
#include "render/effects.h"
#include "script/content_loader.h"
#include "script/world_script.h"

#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <iterator>
#include <unistd.h>

namespace vitrail {

struct DemoWorld {
    Content content;
    BiomeTable biomes;
    std::optional<ScriptedWorld> world;
    std::filesystem::path folder; // empty until `keep`
    std::string trouble;          // why there is none

    DemoWorld() {
        const std::filesystem::path source(VITRAIL_SOURCE_DIR);
        const std::vector<std::filesystem::path> roots{source / "content/base"};
        auto loaded = load_content(roots);
        if (!loaded) {
            trouble = loaded.error().message;
            return;
        }
        content = std::move(*loaded);
        std::ifstream file(source / "content/demo/stations.lua", std::ios::binary);
        const std::string text{std::istreambuf_iterator<char>(file), {}};
        auto made = run_world_script(text, "stations.lua", std::make_shared<StateTable>(content.registry), biomes);
        if (made)
            world.emplace(std::move(*made));
        else
            trouble = made.error().message;
    }
    ~DemoWorld() {
        std::error_code ignored;
        if (!folder.empty()) std::filesystem::remove_all(folder, ignored);
    }
    // Writes it to a world folder, once.
    void keep() {
        if (!world || !folder.empty()) return;
        folder = std::filesystem::temp_directory_path() / ("vitrail-demo-" + std::to_string(getpid()));
        LevelRecord level;
        level.name = world->name;
        level.spawn.at = world->spawn;
        const auto kept = keep_built_world(folder.string(), world->dimension, biomes, level);
        if (!kept) trouble = kept.error().message;
    }
};

inline DemoWorld& demo_world() {
    static DemoWorld demo;
    return demo;
}

// The effects that show the station without its own.
inline render::Effects effects_without(const Station& station) {
    render::Effects effects = render::preset_effects(render::Preset::high);
    for (const std::string& setting : station.without) {
        const std::size_t equals = setting.find('=');
        const auto set = render::set_effect(effects, setting.substr(0, equals), setting.substr(equals + 1));
        EXPECT_TRUE(set) << station.name << ": " << set.error().message;
    }
    return effects;
}

} // namespace vitrail
