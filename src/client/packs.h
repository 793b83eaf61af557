// Resource packs from a list of paths: opened, read and told of in the log.
#pragma once

#include "scene/pack_looks.h"

#include <string>
#include <vector>

namespace vitrail::client {

// The later of `paths` covers the earlier. Null where there are none. What is wrong inside a pack is a warning. Errors:
// a pack that cannot be opened (not_found, io, damaged, limit).
Result<std::shared_ptr<const scene::PackLooks>> open_packs(const std::vector<std::string>& paths,
                                                           const BlockRegistry& registry);

} // namespace vitrail::client
