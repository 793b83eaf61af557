// Variants as authors write them (all that match apply, those with fewest conditions first) turned into whole looks of
// which the last match decides, as StateTable wants them.
#pragma once

#include "base/result.h"
#include "lua/value.h"
#include "world/block_def.h"

#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace vitrail {

struct WrittenVariant {
    std::string key; // as written, for messages
    std::vector<std::pair<std::string, std::string>> when;
    const lua::Value::Table* fields = nullptr;
};

// Parses "a=b,c=d" against the block's properties. Errors: invalid_argument.
Result<std::vector<std::pair<std::string, std::string>>> parse_conditions(const std::string& key,
                                                                          const std::vector<PropertyDef>& properties);

// `look_with` gives the look with these variants' fields laid over in this order.
Result<std::vector<BlockVariant>>
resolve_variants(const std::vector<PropertyDef>& properties, std::vector<WrittenVariant> written,
                 const std::function<Result<BlockLook>(const std::vector<const WrittenVariant*>&)>& look_with);

} // namespace vitrail
