// The table functions of a sandbox: Lua's own, behind checks that bound what one call can do. Tables with a metatable
// are refused, since __len and __index could make a C loop of any length.
#include "lua/meter.h"

#include <algorithm>

namespace vitrail::lua {

namespace {

constexpr lua_Integer kUnpackMost = 1 << 16;
constexpr lua_Integer kSortMost = 1 << 16; // a hostile order makes Lua's sort quadratic

lua_Integer plain_table(lua_State* state, int argument) {
    luaL_checktype(state, argument, LUA_TTABLE);
    luaL_argcheck(state, !lua_getmetatable(state, argument), argument, "a table without a metatable expected");
    return lua_Integer(lua_rawlen(state, argument));
}

// Calls the function kept as the first upvalue with all arguments.
int call_original(lua_State* state) {
    lua_pushvalue(state, lua_upvalueindex(1));
    lua_insert(state, 1);
    lua_call(state, lua_gettop(state) - 1, LUA_MULTRET);
    return lua_gettop(state);
}

void charge_range(lua_State* state, lua_Integer from, lua_Integer to) {
    if (to >= from) charge(state, u64(to) - u64(from) + 1);
}

int safe_concat(lua_State* state) {
    const lua_Integer size = plain_table(state, 1);
    const lua_Integer from = luaL_optinteger(state, 3, 1), to = luaL_optinteger(state, 4, size);
    charge_range(state, from, to);
    return call_original(state);
}

int safe_insert(lua_State* state) {
    const lua_Integer size = plain_table(state, 1);
    if (lua_gettop(state) >= 3) charge_range(state, std::max<lua_Integer>(luaL_checkinteger(state, 2), 1), size + 1);
    return call_original(state);
}

int safe_remove(lua_State* state) {
    const lua_Integer size = plain_table(state, 1);
    if (lua_gettop(state) >= 2) charge_range(state, std::max<lua_Integer>(luaL_checkinteger(state, 2), 1), size + 1);
    return call_original(state);
}

int safe_move(lua_State* state) {
    plain_table(state, 1);
    if (!lua_isnoneornil(state, 5)) plain_table(state, 5);
    charge_range(state, luaL_checkinteger(state, 2), luaL_checkinteger(state, 3));
    return call_original(state);
}

int safe_unpack(lua_State* state) {
    const lua_Integer size = plain_table(state, 1);
    const lua_Integer from = luaL_optinteger(state, 2, 1), to = luaL_optinteger(state, 3, size);
    if (to >= from && u64(to) - u64(from) >= u64(kUnpackMost)) return luaL_error(state, "too many results to unpack");
    charge_range(state, from, to);
    return call_original(state);
}

int safe_sort(lua_State* state) {
    const lua_Integer size = plain_table(state, 1);
    luaL_argcheck(state, size <= kSortMost, 1, "too many elements to sort");
    charge(state, u64(size) * 16);
    return call_original(state);
}

} // namespace

void open_table(lua_State* state) {
    luaL_requiref(state, LUA_TABLIBNAME, luaopen_table, 1);
    static constexpr luaL_Reg replaced[] = {{"concat", safe_concat}, {"insert", safe_insert}, {"remove", safe_remove},
                                            {"move", safe_move},     {"unpack", safe_unpack}, {"sort", safe_sort}};
    for (const luaL_Reg& entry : replaced) {
        lua_getfield(state, -1, entry.name);
        lua_pushcclosure(state, entry.func, 1);
        lua_setfield(state, -2, entry.name);
    }
    lua_pop(state, 1);
}

} // namespace vitrail::lua
