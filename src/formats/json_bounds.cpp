#include "formats/json_bounds.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace vitrail {

Result<nlohmann::json> parse_json(ByteView text) {
    if (text.size() > kMaxJsonBytes)
        return fail(ErrorCode::limit, fmt::format("{} bytes of JSON are too many", text.size()));
    u32 depth = 0;
    bool quoted = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const u8 c = text[i];
        if (quoted) {
            if (c == '\\')
                ++i;
            else if (c == '"')
                quoted = false;
        } else if (c == '"') {
            quoted = true;
        } else if (c == '[' || c == '{') {
            if (++depth > kMaxJsonDepth)
                return fail(ErrorCode::limit, fmt::format("JSON nested deeper than {}", kMaxJsonDepth));
        } else if ((c == ']' || c == '}') && depth > 0) {
            --depth;
        }
    }
    // The parser of the library is a loop, not a recursion, and the count above may err only where there are comments.
    try {
        return nlohmann::json::parse(text.begin(), text.end(), nullptr, true, true);
    } catch (const nlohmann::json::exception& error) {
        std::string why = error.what();
        if (const std::size_t end = why.find("] "); end != std::string::npos) why = why.substr(end + 2);
        return fail(ErrorCode::damaged, fmt::format("no JSON: {}", why.substr(0, 160)));
    }
}

} // namespace vitrail
