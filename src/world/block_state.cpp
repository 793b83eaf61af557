#include "world/block_state.h"

#include <algorithm>
#include <fmt/format.h>

namespace vitrail {

std::string_view BlockState::get(std::string_view property, std::string_view otherwise) const {
    for (const auto& [key, value] : properties)
        if (key == property) return value;
    return otherwise;
}

void BlockState::set(std::string_view property, std::string_view value) {
    auto at = std::lower_bound(properties.begin(), properties.end(), property,
                               [](const auto& entry, std::string_view key) { return entry.first < key; });
    if (at != properties.end() && at->first == property)
        at->second = value;
    else
        properties.emplace(at, property, value);
}

std::string BlockState::to_string() const {
    std::string out = name;
    for (std::size_t i = 0; i < properties.size(); ++i) {
        out += i == 0 ? '[' : ',';
        out += properties[i].first;
        out += '=';
        out += properties[i].second;
    }
    if (!properties.empty()) out += ']';
    return out;
}

static bool is_word(std::string_view text, bool is_name) {
    if (text.empty()) return false;
    return std::all_of(text.begin(), text.end(), [&](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '.' ||
               c == '-' || (is_name && (c == '/' || c == ':'));
    });
}

Result<BlockState> parse_block_state(std::string_view text) {
    auto bad = [&](const char* why) {
        return fail(ErrorCode::invalid_argument, fmt::format("block state '{}': {}", text.substr(0, 80), why));
    };
    if (text.size() > 1024) return bad("longer than 1024 bytes");
    BlockState state;
    const std::size_t open = text.find('[');
    std::string_view name = text.substr(0, open);
    if (!is_word(name, true)) return bad("the name holds a character that names never have, or is empty");
    state.name = name.find(':') == std::string_view::npos ? fmt::format("minecraft:{}", name) : std::string(name);
    if (open == std::string_view::npos) return state;
    if (text.back() != ']') return bad("no closing bracket");
    std::string_view list = text.substr(open + 1, text.size() - open - 2);
    while (!list.empty()) {
        const std::size_t comma = list.find(',');
        const std::string_view entry = list.substr(0, comma);
        const std::size_t equals = entry.find('=');
        if (equals == std::string_view::npos) return bad("a property has no '='");
        const std::string_view key = entry.substr(0, equals), value = entry.substr(equals + 1);
        if (!is_word(key, false) || !is_word(value, false)) return bad("a property holds a character that none has");
        if (!state.get(key).empty()) return bad("a property stands twice");
        state.set(key, value);
        if (comma == std::string_view::npos) break;
        list.remove_prefix(comma + 1);
        if (list.empty()) return bad("a comma before the closing bracket");
    }
    return state;
}

} // namespace vitrail
