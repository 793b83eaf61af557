// The base game's content and a generator of it, for tests of what lies between generator, store and server.
#pragma once

#include "script/content_loader.h"
#include "terrain/generator.h"

#include <filesystem>
#include <stdexcept>

namespace vitrail {

inline const Content& base_content() {
    static const Content content = [] {
        const std::filesystem::path roots[] = {std::filesystem::path(VITRAIL_SOURCE_DIR) / "content/base"};
        auto loaded = load_content(roots);
        if (!loaded) throw std::runtime_error(loaded.error().message);
        if (!loaded->terrain) throw std::runtime_error("content/base describes no terrain");
        return *loaded;
    }();
    return content;
}

inline std::shared_ptr<const TerrainGenerator> base_generator(u64 seed) {
    auto generator = TerrainGenerator::create(*base_content().terrain, seed);
    if (!generator) throw std::runtime_error(generator.error().message);
    return *generator;
}

} // namespace vitrail
