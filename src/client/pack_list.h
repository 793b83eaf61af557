// The list of resource packs that a player orders and turns on and off: those in use, and what else lies in the folder
// of packs. Data only; opening them is packs.h.
#pragma once

#include "base/types.h"

#include <filesystem>
#include <string>
#include <vector>

namespace vitrail::client {

struct PackEntry {
    std::string path; // as the settings keep it
    std::string name; // of the file or folder, for the eye
    bool on = false;
    bool missing = false; // in use by the settings, but not there
    bool operator==(const PackEntry&) const = default;
};

// As a player reads them: the pack that covers all others first, those in use before the others, which go by name.
// chosen: paths in use, the later over the earlier. What lies in `folder` counts where it may be a pack: zip files, and
// folders with pack.mcmeta, assets or textures in them; at most kPacksListed. A folder that is not there has none.
std::vector<PackEntry> list_packs(const std::filesystem::path& folder, const std::vector<std::string>& chosen);

inline constexpr std::size_t kPacksListed = 256;

// The paths in use again, the later over the earlier.
std::vector<std::string> packs_in_use(const std::vector<PackEntry>& list);

// Turns one on or off: it goes to the end of those in use, or after them. Out of range: nothing.
void toggle_pack(std::vector<PackEntry>& list, std::size_t index);
// Moves one in use a place up (nearer to the first) or down among those in use, where there is a place.
void move_pack(std::vector<PackEntry>& list, std::size_t index, bool up);

} // namespace vitrail::client
