// The base game's terrain, for tests that want the real one.
#pragma once

#include "script/content_loader.h"
#include "terrain/description.h"

#include <filesystem>
#include <stdexcept>

namespace vitrail {

// content/base of the source tree, read once. Throws where it does not load.
inline const TerrainDescription& base_terrain() {
    static const std::shared_ptr<const TerrainDescription> terrain = [] {
        const std::filesystem::path roots[] = {std::filesystem::path(VITRAIL_SOURCE_DIR) / "content" / "base"};
        auto content = load_content(roots);
        if (!content) throw std::runtime_error(content.error().message);
        if (!content->terrain) throw std::runtime_error("content/base says nothing about terrain");
        return content->terrain;
    }();
    return *terrain;
}

} // namespace vitrail
