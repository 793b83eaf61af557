// Content: the Lua files that say what blocks, textures and biomes there are, run once on the server and compiled to a
// BlockRegistry. The functions they may call are described for authors in docs/content.md.
#pragma once

#include "base/result.h"
#include "world/block_registry.h"

#include <filesystem>
#include <memory>
#include <span>
#include <string>

namespace vitrail {

inline constexpr u64 kBlockStatesMost = 4096; // of one block: the product of its property values
inline constexpr std::size_t kBlocksMost = 32768;
inline constexpr std::size_t kContentTexturesMost = 16384;

struct ContentFile {
    std::string name; // as messages call it
    std::string text;
};

// Reads ROOT/*.lua of every root, roots in order and files by name, all in one sandbox; a later definition of a name
// wins. A root's textures/ lies over those of earlier roots. Errors: not_found (a root), io, invalid_argument with
// file, line, name and what was expected; limit.
Result<std::shared_ptr<BlockRegistry>> load_content(std::span<const std::filesystem::path> roots);

inline constexpr u64 kContentInstructionsMost = 200'000'000; // of all files together; the base game needs about 1 in 50

// The same from texts in memory.
Result<std::shared_ptr<BlockRegistry>> load_content_texts(std::span<const ContentFile> files,
                                                          u64 instructions_most = kContentInstructionsMost);

} // namespace vitrail
