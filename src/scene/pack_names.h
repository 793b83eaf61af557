// Names that block pictures and blocks had in other versions of Minecraft, and where our own content names them
// otherwise.
#pragma once

#include "base/types.h"

#include <string>
#include <string_view>
#include <vector>

namespace vitrail::scene {

// Files that may hold a block picture, best first, without ".png", below textures/: for "oak_log" of a pack of old
// names "blocks/log_oak", else "block/oak_log". `name` is a modern name or ours, without a folder.
std::vector<std::string> picture_files(std::string_view name, bool old_names);

// Our content's texture names that show the same as this picture of a pack ("grass" -> "short_grass"), the name itself
// first.
std::vector<std::string> content_names(std::string_view picture);

// Names of blockstates files that may speak of a block, best first: "short_grass", then "grass".
std::vector<std::string> block_names(std::string_view block);

// Pictures that are no face of a block but a sheet that models cut their parts from: they cannot stand in for content's
// picture of that name on content's own shape.
bool is_sheet(std::string_view name);

} // namespace vitrail::scene
