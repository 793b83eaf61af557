#include "script/terrain_values.h"

#include "script/block_reader.h"
#include "world/block_state.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace vitrail::terrain_values {

using lua::Value;

namespace {

constexpr std::size_t kWordMost = 64, kKeysMost = 64, kAttributesMost = 8;

tl::unexpected<Error> bad(std::string message) {
    return fail(ErrorCode::invalid_argument, std::move(message));
}

tl::unexpected<Error> expected(const std::string& what, const Value& got) {
    const std::string text = got.text();
    if (text.empty() || text.size() > 64) return bad(fmt::format("expected {}, got {}", what, got.type_name()));
    return bad(fmt::format("expected {}, got {}", what, got.string() ? "\"" + text + "\"" : text));
}

bool is_word(std::string_view text) {
    return !text.empty() && text.size() <= kWordMost && std::all_of(text.begin(), text.end(), [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_' || c == '.' || c == '-';
    });
}

Result<> read_block_text(const Value& value, std::string& out) {
    if (!value.string()) return expected("a block such as \"minecraft:stone\"", value);
    auto state = parse_block_state(*value.string());
    if (!state) return tl::unexpected(std::move(state).error());
    out = state->to_string();
    return {};
}

// A table whose keys are words.
Result<> read_map(const Value& value, const std::function<Result<>(const std::string&, const Value&)>& read) {
    if (!value.table()) return expected("a table", value);
    if (value.table()->entries.size() > kKeysMost)
        return fail(ErrorCode::limit, fmt::format("more than {} keys", kKeysMost));
    for (const auto& [key, content] : value.table()->entries) {
        if (!key.string() || !is_word(*key.string())) return expected("a word as key", key);
        VX_TRY(named(*key.string(), read(*key.string(), content)));
    }
    return {};
}

} // namespace

Result<> named(const std::string& row, Result<> done) {
    if (!done) done.error().message = row + ": " + done.error().message;
    return done;
}

Result<> read_keys(const Value& value, std::span<const Key> keys) {
    if (!value.table()) return expected("a table", value);
    for (const auto& [key, content] : value.table()->entries) {
        const std::string text = key.string() ? *key.string() : "";
        const auto found = std::find_if(keys.begin(), keys.end(), [&](const Key& k) { return text == k.name; });
        if (found == keys.end()) {
            std::vector<const char*> known;
            for (const Key& k : keys)
                known.push_back(k.name);
            return bad(fmt::format("unknown key {}; there are {}", key.text().empty() ? "?" : key.text().substr(0, 64),
                                   fmt::join(known, " ")));
        }
        VX_TRY(named(text, found->read(content)));
    }
    for (const Key& key : keys)
        if (key.needed && !value.table()->find(key.name)) return bad(fmt::format("there is no {}", key.name));
    return {};
}

Result<> read_list(const Value& list, std::size_t most, const Read& read) {
    if (!list.table() || !list.table()->is_list()) return expected("a list", list);
    if (list.table()->entries.size() > most)
        return fail(ErrorCode::limit,
                    fmt::format("{} entries, at most {} are allowed", list.table()->entries.size(), most));
    for (const auto& [key, value] : list.table()->entries)
        VX_TRY(named("[" + key.text() + "]", read(value)));
    return {};
}

Read word(std::string& out) {
    return [&out](const Value& value) -> Result<> {
        if (!value.string() || !is_word(*value.string())) return expected("a word of a-z 0-9 _ . -", value);
        out = *value.string();
        return {};
    };
}

Read word_of(std::string& out, std::span<const char* const> words) {
    return [&out, words](const Value& value) -> Result<> {
        if (!value.string() || std::find(words.begin(), words.end(), *value.string()) == words.end())
            return expected(fmt::format("one of {}", fmt::join(words, " ")), value);
        out = *value.string();
        return {};
    };
}

Read name(std::string& out, const char* what) {
    return [&out, what](const Value& value) -> Result<> {
        VX_TRY_ASSIGN(out, read_name(value, what));
        return {};
    };
}

Read flag(bool& out) {
    return [&out](const Value& value) -> Result<> {
        if (!value.boolean()) return expected("true or false", value);
        out = *value.boolean();
        return {};
    };
}

Read number(float& out, double least, double most) {
    return [&out, least, most](const Value& value) -> Result<> {
        const double v = value.number();
        if (!value.is_number() || !(v >= least && v <= most)) // a NaN is neither
            return expected(fmt::format("a number from {} to {}", least, most), value);
        out = float(v);
        return {};
    };
}

Read whole(int& out, int least, int most) {
    return [&out, least, most](const Value& value) -> Result<> {
        const double v = value.number();
        if (!value.is_number() || !(v >= least && v <= most) || v != std::floor(v))
            return expected(fmt::format("a whole number from {} to {}", least, most), value);
        out = int(v);
        return {};
    };
}

Read expression(std::string& out) {
    return [&out](const Value& value) -> Result<> {
        if (value.is_number() && std::abs(value.number()) <= 1e6) { // no exponent: the language knows none
            out = fmt::format("{:.9f}", value.number());
            out.erase(out.find_last_not_of('0') + 1);
            if (out.back() == '.') out.pop_back();
            return {};
        }
        const std::string* text = value.string();
        const auto plain = [](char c) { return (c >= ' ' && c <= '~') || c == '\n' || c == '\t'; };
        if (!text || text->empty() || !std::all_of(text->begin(), text->end(), plain))
            return expected("an expression such as \"130 + 8 * F(.01)\"", value);
        if (text->size() > kExpressionSizeMost)
            return fail(ErrorCode::limit, fmt::format("an expression of more than {} bytes", kExpressionSizeMost));
        out = *text;
        return {};
    };
}

Read wants(std::string& out) {
    return [&out](const Value& value) -> Result<> {
        const std::string* text = value.string();
        if (!text || text->empty() || text->size() > kAttributesMost ||
            text->find_first_not_of("+-.") != std::string::npos)
            return expected("a sign an attribute, + - or ., such as \"-.++--\"", value);
        out = *text;
        return {};
    };
}

Read block(std::string& out) {
    return [&out](const Value& value) { return read_block_text(value, out); };
}

Read blocks(std::vector<std::string>& out, std::size_t most) {
    return [&out, most](const Value& value) -> Result<> {
        out.clear();
        return read_list(value, most, [&out](const Value& one) { return read_block_text(one, out.emplace_back()); });
    };
}

bool is_block_word(std::string_view text) {
    return text == "ground" || text == "rock" || text == "loose" || text == "water";
}

Read block_set(std::vector<std::string>& out) {
    return [&out](const Value& value) -> Result<> {
        out.clear();
        const auto one = [&out](const Value& v) -> Result<> {
            if (v.string() && is_block_word(*v.string())) {
                out.push_back(*v.string());
                return {};
            }
            return read_block_text(v, out.emplace_back());
        };
        if (!value.table()) return one(value);
        if (value.table()->entries.empty()) return expected("a block or a list of some", value);
        return read_list(value, kListMost, one);
    };
}

Read words(std::vector<std::string>& out) {
    return [&out](const Value& value) -> Result<> {
        out.clear();
        const auto one = [&out](const Value& v) { return word(out.emplace_back())(v); };
        return value.table() ? read_list(value, kListMost, one) : one(value);
    };
}

Read numbers(std::map<std::string, float>& out, double least, double most) {
    return [&out, least, most](const Value& value) {
        return read_map(value,
                        [&](const std::string& key, const Value& v) { return number(out[key], least, most)(v); });
    };
}

Read named_blocks(std::map<std::string, std::string>& out) {
    return [&out](const Value& value) {
        return read_map(value, [&](const std::string& key, const Value& v) { return read_block_text(v, out[key]); });
    };
}

} // namespace vitrail::terrain_values
