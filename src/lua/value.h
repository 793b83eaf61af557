// Value: a Lua value as plain C++ data. Scripts hand over tables; what reads them works on this copy and needs no Lua.
#pragma once

#include "base/result.h"
#include "base/types.h"

#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

struct lua_State;

namespace vitrail::lua {

struct Value {
    struct Entry;
    struct Table {
        std::vector<Entry> entries; // numbers first in rising order, then strings in byte order, then booleans
        // The values 1..n, where the keys are exactly those.
        bool is_list() const;
        const Value* find(std::string_view key) const;
    };
    std::variant<std::monostate, bool, i64, double, std::string, Table> data;

    bool is_nil() const { return data.index() == 0; }
    const bool* boolean() const { return std::get_if<bool>(&data); }
    const std::string* string() const { return std::get_if<std::string>(&data); }
    const Table* table() const { return std::get_if<Table>(&data); }
    bool is_number() const { return std::holds_alternative<i64>(data) || std::holds_alternative<double>(data); }
    double number() const; // 0 where it is none
    // As content writes property values: strings as they are, booleans true and false, whole numbers in digits; empty
    // else.
    std::string text() const;
    const char* type_name() const; // for messages: "a table", "a number", ...
};

struct Value::Entry {
    Value first, second; // key, value
};

inline constexpr int kValueDepthMost = 16;
inline constexpr std::size_t kValueEntriesMost = 1u << 18; // in all tables of one value

// Copies the value at a stack index. Never raises a Lua error. Metatables are not asked.
// Errors: limit (depth, entries), invalid_argument (functions, userdata, tables as keys).
Result<Value> read_value(lua_State* state, int index);

} // namespace vitrail::lua
