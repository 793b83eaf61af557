// Helpers that read keys of a Lua table into plain fields, each with its own check, for script/terrain_reader.cpp.
#pragma once

#include "base/result.h"
#include "lua/value.h"

#include <functional>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace vitrail::terrain_values {

using Read = std::function<Result<>(const lua::Value&)>;
struct Key {
    const char* name;
    Read read;
    bool needed = false;
};

inline constexpr std::size_t kExpressionSizeMost = 2000; // bytes, as in terrain/compile/expression.h
inline constexpr std::size_t kListMost = 64;             // blocks of a list

// Every key of the table must be among `keys`; those that are needed must be there. Errors: invalid_argument, "key:
// what".
Result<> read_keys(const lua::Value& table, std::span<const Key> keys);
inline Result<> read_keys(const lua::Value& table, std::initializer_list<Key> keys) {
    return read_keys(table, std::span<const Key>(keys.begin(), keys.size()));
}
// Calls `read` for each value of a list of 1 to `most`. Errors: "[index]: what".
Result<> read_list(const lua::Value& list, std::size_t most, const Read& read);
// Puts `row` and a colon before an error's message.
Result<> named(const std::string& row, Result<> done);

// a-z 0-9 _ . -, at most 64 bytes
Read word(std::string& out);
Read word_of(std::string& out, std::span<const char* const> words);
// namespace:path
Read name(std::string& out, const char* what);
Read flag(bool& out);
Read number(float& out, double least, double most);
Read whole(int& out, int least, int most);
// A text in the language of terrain/compile/expression.h, or a number.
Read expression(std::string& out);
// One to eight of + - .
Read wants(std::string& out);
// A state's text; the result names its namespace and sorts its properties.
Read block(std::string& out);
Read blocks(std::vector<std::string>& out, std::size_t most); // a list
// One block or a list; "ground", "rock", "loose" and "water" stand for sets.
Read block_set(std::vector<std::string>& out);
bool is_block_word(std::string_view text);
Read words(std::vector<std::string>& out);                                  // one or a list
Read numbers(std::map<std::string, float>& out, double least, double most); // word = number
Read named_blocks(std::map<std::string, std::string>& out);                 // word = block

} // namespace vitrail::terrain_values
