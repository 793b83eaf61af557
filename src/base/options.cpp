#include "base/options.h"

#include <algorithm>
#include <charconv>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <optional>

namespace vitrail {

namespace {

template <class T>
std::optional<T> number(std::string_view text, const OptionRange& range) {
    T value{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
    // Not a number fails both.
    if (!(float(value) >= range.least && float(value) <= range.most)) return std::nullopt;
    return value;
}

std::optional<bool> yes_or_no(std::string_view text) {
    if (text == "true" || text == "on" || text == "1") return true;
    if (text == "false" || text == "off" || text == "0") return false;
    return std::nullopt;
}

std::optional<i32> choice(std::string_view text, const OptionRange& range) {
    for (u32 i = 0; i < range.choices.size(); ++i)
        if (text == range.choices[i]) return i32(i);
    return std::nullopt;
}

template <class T>
bool put(T* to, std::optional<T> value) {
    if (value) *to = *value;
    return value.has_value();
}

} // namespace

std::string allowed_text(const OptionRange& range, OptionMember member) {
    if (std::holds_alternative<bool*>(member)) return "true or false";
    const bool whole = std::holds_alternative<i32*>(member);
    if (whole && !range.choices.empty()) return fmt::format("one of {}", fmt::join(range.choices, ", "));
    return fmt::format("a {}number from {} to {}", whole ? "whole " : "", range.least, range.most);
}

Result<> set_member(std::string_view key, const OptionRange& range, OptionMember to, std::string_view text) {
    bool fits = false;
    if (bool* const* b = std::get_if<bool*>(&to)) fits = put(*b, yes_or_no(text));
    if (i32* const* i = std::get_if<i32*>(&to))
        fits = put(*i, range.choices.empty() ? number<i32>(text, range) : choice(text, range));
    if (float* const* f = std::get_if<float*>(&to)) fits = put(*f, number<float>(text, range));
    if (fits) return {};
    return fail(ErrorCode::invalid_argument, fmt::format("{} is {}, not '{}'", key, allowed_text(range, to), text));
}

std::string member_text(const OptionRange& range, OptionMember member) {
    if (i32* const* i = std::get_if<i32*>(&member); i && !range.choices.empty())
        return range.choices[std::size_t(std::clamp<i32>(**i, 0, i32(range.choices.size()) - 1))];
    return std::visit([](const auto* value) { return fmt::format("{}", *value); }, member);
}

void hold_member(const OptionRange& range, OptionMember member, OptionMember otherwise) {
    if (i32* const* i = std::get_if<i32*>(&member)) **i = std::clamp(**i, i32(range.least), i32(range.most));
    if (float* const* f = std::get_if<float*>(&member))
        **f = **f == **f ? std::clamp(**f, range.least, range.most) : *std::get<float*>(otherwise);
}

std::string option_row(const char* key, const char* label, const char* help, const std::string& allowed) {
    return fmt::format("| `{}` | {}: {} | {} |", key, label, help, allowed);
}

} // namespace vitrail
