// Tables of options: every switch and number of a struct described once, so that settings files, the command line and
// menus read and write them alike.
//
//     struct Taste { i32 size = 3; bool sweet = true; };
//     const OptionOf<Taste> kTable[] = {
//         {"size", "Size", "How much.", [](Taste& t) -> OptionMember { return &t.size; }, 1, 9},
//         {"sweet", "Sweet", "Or not.", [](Taste& t) -> OptionMember { return &t.sweet; }}};
//     VX_TRY(set_option(kTable[0], taste, "4"));
//     option_text(kTable[0], taste) // "4"
//
// A row may be of a class that adds to OptionOf.
#pragma once

#include "base/result.h"
#include "base/types.h"

#include <span>
#include <string>
#include <string_view>
#include <variant>

namespace vitrail {

using OptionMember = std::variant<bool*, i32*, float*>; // none is null

// What one may be set to.
struct OptionRange {
    float least = 0, most = 1;                 // of numbers; whole ones must be exact as float
    std::span<const char* const> choices = {}; // names of an i32's values 0, 1, ...; empty: a plain number
};

template <class Values>
struct OptionOf {
    const char* key;   // "shadows.size"
    const char* label; // of the menu
    const char* help;  // one sentence
    OptionMember (*member)(Values&);
    float least = 0, most = 1;
    std::span<const char* const> choices = {};
    OptionRange range() const { return {least, most, choices}; }
};

// "true or false", "a whole number from 1 to 9", "one of off, flat, lit".
std::string allowed_text(const OptionRange& range, OptionMember member);
// "true" or "on" or "1", "false" or "off" or "0"; numbers as C++ writes them, nothing around; choices by name. Errors:
// invalid_argument (the line names key and what is allowed), and nothing is changed.
Result<> set_member(std::string_view key, const OptionRange& range, OptionMember to, std::string_view text);
std::string member_text(const OptionRange& range, OptionMember member); // as set_member reads it, to the same bits
// Into its range; what is no number becomes what `otherwise`, of the same kind, holds.
void hold_member(const OptionRange& range, OptionMember member, OptionMember otherwise);
// "| `key` | label: help | what is allowed |", a row of a Markdown table.
std::string option_row(const char* key, const char* label, const char* help, const std::string& allowed);

// The row of that key; null where there is none.
template <class Row>
const Row* find_option(std::span<const Row> table, std::string_view key) {
    for (const Row& row : table)
        if (key == row.key) return &row;
    return nullptr;
}

template <class Row, class Values>
Result<> set_option(const Row& row, Values& values, std::string_view text) {
    return set_member(row.key, row.range(), row.member(values), text);
}

template <class Row, class Values>
std::string option_text(const Row& row, const Values& values) {
    Values copy = values;
    return member_text(row.range(), row.member(copy));
}

// Every value into its range.
template <class Row, class Values>
void hold_options(std::span<const Row> table, Values& values, Values otherwise) {
    for (const Row& row : table)
        hold_member(row.range(), row.member(values), row.member(otherwise));
}

template <class Values>
std::string option_row(const OptionOf<Values>& row) {
    Values any;
    return option_row(row.key, row.label, row.help, allowed_text(row.range(), row.member(any)));
}

} // namespace vitrail
