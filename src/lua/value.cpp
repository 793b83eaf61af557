#include "lua/value.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <lua5.4/lua.hpp>

namespace vitrail::lua {

bool Value::Table::is_list() const {
    for (std::size_t i = 0; i < entries.size(); ++i) {
        const i64* key = std::get_if<i64>(&entries[i].first.data);
        if (!key || *key != i64(i) + 1) return false;
    }
    return true;
}

const Value* Value::Table::find(std::string_view key) const {
    for (const Entry& entry : entries)
        if (const std::string* name = entry.first.string(); name && *name == key) return &entry.second;
    return nullptr;
}

double Value::number() const {
    if (const i64* whole = std::get_if<i64>(&data)) return double(*whole);
    if (const double* real = std::get_if<double>(&data)) return *real;
    return 0;
}

std::string Value::text() const {
    if (const std::string* s = string()) return *s;
    if (const bool* b = boolean()) return *b ? "true" : "false";
    if (const i64* whole = std::get_if<i64>(&data)) return std::to_string(*whole);
    if (const double* real = std::get_if<double>(&data); real && std::abs(*real) < 1e9 && *real == std::floor(*real))
        return std::to_string(i32(*real));
    return {};
}

const char* Value::type_name() const {
    static constexpr const char* names[] = {"nothing", "a boolean", "a number", "a number", "a string", "a table"};
    return names[data.index()];
}

namespace {

bool comes_before(const Value& a, const Value& b) {
    const auto rank = [](const Value& v) { return v.is_number() ? 0 : v.string() ? 1 : 2; };
    if (rank(a) != rank(b)) return rank(a) < rank(b);
    if (a.is_number()) {
        const i64 *i = std::get_if<i64>(&a.data), *j = std::get_if<i64>(&b.data);
        return i && j ? *i < *j : a.number() < b.number();
    }
    if (a.string()) return *a.string() < *b.string();
    return a.boolean() && b.boolean() && *a.boolean() < *b.boolean();
}

// Only lua_next and plain reads, none of which can raise: a jump would skip the destructors here.
Result<Value> read(lua_State* state, int index, int depth, std::size_t& entries) {
    switch (lua_type(state, index)) {
    case LUA_TNONE:
    case LUA_TNIL:
        return Value{};
    case LUA_TBOOLEAN:
        return Value{lua_toboolean(state, index) != 0};
    case LUA_TNUMBER:
        if (lua_isinteger(state, index)) return Value{i64(lua_tointegerx(state, index, nullptr))};
        return Value{double(lua_tonumberx(state, index, nullptr))};
    case LUA_TSTRING: {
        std::size_t size = 0;
        const char* text = lua_tolstring(state, index, &size);
        return Value{std::string(text, size)};
    }
    case LUA_TTABLE:
        break;
    default:
        return fail(ErrorCode::invalid_argument,
                    fmt::format("a {} is not data", lua_typename(state, lua_type(state, index))));
    }
    if (depth >= kValueDepthMost)
        return fail(ErrorCode::limit, fmt::format("tables nest deeper than {}", kValueDepthMost));
    if (!lua_checkstack(state, 4)) return fail(ErrorCode::limit, "the Lua stack is full");
    const int table = lua_absindex(state, index);
    Value::Table out;
    lua_pushnil(state);
    while (lua_next(state, table)) {
        const int key_type = lua_type(state, -2);
        if (++entries > kValueEntriesMost) {
            lua_pop(state, 2);
            return fail(ErrorCode::limit, fmt::format("a value of more than {} entries", kValueEntriesMost));
        }
        if (key_type != LUA_TSTRING && key_type != LUA_TNUMBER && key_type != LUA_TBOOLEAN) {
            lua_pop(state, 2);
            return fail(ErrorCode::invalid_argument,
                        fmt::format("a {} cannot be a key of data", lua_typename(state, key_type)));
        }
        Result<Value> key = read(state, -2, depth + 1, entries);
        Result<Value> value = read(state, -1, depth + 1, entries);
        lua_pop(state, 1);
        if (!key || !value) {
            lua_pop(state, 1);
            return tl::unexpected(!key ? std::move(key).error() : std::move(value).error());
        }
        out.entries.push_back({std::move(*key), std::move(*value)});
    }
    std::sort(out.entries.begin(), out.entries.end(),
              [](const Value::Entry& a, const Value::Entry& b) { return comes_before(a.first, b.first); });
    return Value{std::move(out)};
}

} // namespace

Result<Value> read_value(lua_State* state, int index) {
    std::size_t entries = 0;
    return read(state, index, 0, entries);
}

} // namespace vitrail::lua
