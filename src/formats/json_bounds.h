// JSON from outside: size and depth are held before anything is built of it.
#pragma once

#include "base/bytes.h"
#include "base/result.h"

#include <nlohmann/json_fwd.hpp>

namespace vitrail {

inline constexpr std::size_t kMaxJsonBytes = 1u << 20;
inline constexpr u32 kMaxJsonDepth = 32;

// Comments and a byte order mark are let pass, as Minecraft does. Errors: damaged (with the place), limit.
Result<nlohmann::json> parse_json(ByteView text);

} // namespace vitrail
