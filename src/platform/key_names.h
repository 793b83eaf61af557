// Names of keys, as settings keep them and menus show them: "w", "left shift", "f5", "[".
#pragma once

#include "platform/input.h"

#include <optional>
#include <string_view>

namespace vitrail::platform {

std::string_view key_name(Key key); // empty for keys without one
std::optional<Key> key_from(std::string_view name);

} // namespace vitrail::platform
