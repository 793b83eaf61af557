// BlockState: a block's name and its properties, e.g. minecraft:oak_log[axis=y]. This text, properties sorted by name, is
// the identity of a state; numbers are only a world's own shorthand for it (docs/decisions/0001-state-identity.md).
#pragma once

#include "base/result.h"

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace vitrail {

struct BlockState {
    std::string name;                                             // namespace:path
    std::vector<std::pair<std::string, std::string>> properties; // sorted by name, names unique

    // The value of a property, or `otherwise`.
    std::string_view get(std::string_view property, std::string_view otherwise = {}) const;
    void set(std::string_view property, std::string_view value);
    std::string to_string() const;
    friend bool operator==(const BlockState&, const BlockState&) = default;
};

// Parses `name` or `name[a=b,c=d]`; a name without namespace gets `minecraft:`. Names and values hold a-z 0-9 _ . - / and
// upper-case letters and ':' in names; at most 1024 bytes in all.
// Errors: invalid_argument.
Result<BlockState> parse_block_state(std::string_view text);

} // namespace vitrail
