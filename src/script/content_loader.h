// Content: the Lua files that say what blocks, textures and biomes there are and what the land is made of, run once on the
// server and compiled to a BlockRegistry and a TerrainDescription. The functions they may call are described for authors in
// docs/content.md and docs/terrain.md.
#pragma once

#include "base/result.h"
#include "terrain/description.h"
#include "world/block_registry.h"

#include <filesystem>
#include <memory>
#include <span>
#include <string>

namespace vitrail {

inline constexpr u64 kBlockStatesMost = 4096; // of one block: the product of its property values
inline constexpr std::size_t kContentBlocksMost = 32768;
inline constexpr std::size_t kContentTexturesMost = 16384;

struct Content {
    std::shared_ptr<BlockRegistry> registry;
    std::shared_ptr<const TerrainDescription> terrain; // null: no script said anything about terrain
};

struct ContentFile {
    std::string name; // as messages call it
    std::string text;
};

// Reads ROOT/*.lua of every root, roots in order and files by name, all in one sandbox; a later definition of a name
// wins. A root's textures/ lies over those of earlier roots. Errors: not_found (a root), io, invalid_argument with
// file, line, name and what was expected; limit.
Result<Content> load_content(std::span<const std::filesystem::path> roots);

inline constexpr u64 kContentInstructionsMost = 200'000'000; // of all files together; the base game needs about 1 in 50

// The same from texts in memory.
Result<Content> load_content_texts(std::span<const ContentFile> files, u64 instructions_most = kContentInstructionsMost);

} // namespace vitrail
