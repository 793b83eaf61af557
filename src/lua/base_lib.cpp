// The base functions of a sandbox, and math.
#include "lua/meter.h"

#include <algorithm>
#include <cstring>

namespace vitrail::lua {

namespace {

// ---- errors: pcall and xpcall let a passed limit through ----

// Whether a protected call ended by a limit: a refused allocation counts as one, since the script could go on forever
// else.
void rethrow_limits(lua_State* state, int status) {
    Meter& meter = meter_of(state);
    if (status == LUA_ERRMEM && !meter.exceeded) meter.exceeded = "memory";
    if (meter.exceeded) raise_exceeded(state);
}

int safe_pcall(lua_State* state) {
    luaL_checkany(state, 1);
    const int status = lua_pcall(state, lua_gettop(state) - 1, LUA_MULTRET, 0);
    rethrow_limits(state, status);
    luaL_checkstack(state, 1, nullptr);
    lua_pushboolean(state, status == LUA_OK);
    lua_insert(state, 1);
    return lua_gettop(state);
}

// Lua calls a message handler before it unwinds: within a count hook, that is with hooks turned off. A script's handler
// must therefore never see the error of a passed limit, or it could run for ever.
int guarded_handler(lua_State* state) {
    if (meter_of(state).exceeded) return 1;
    lua_pushvalue(state, lua_upvalueindex(1));
    lua_insert(state, 1);
    lua_call(state, 1, 1);
    return 1;
}

int safe_xpcall(lua_State* state) {
    luaL_checktype(state, 2, LUA_TFUNCTION);
    lua_pushvalue(state, 1);
    lua_pushvalue(state, 2);
    lua_pushcclosure(state, guarded_handler, 1);
    lua_replace(state, 1); // the handler below the function
    lua_replace(state, 2);
    const int status = lua_pcall(state, lua_gettop(state) - 2, LUA_MULTRET, 1);
    rethrow_limits(state, status);
    lua_pushboolean(state, status == LUA_OK);
    lua_replace(state, 1); // where the handler was
    return lua_gettop(state);
}

// ---- metatables: no finalizers, they run where no hook counts ----

int safe_setmetatable(lua_State* state) {
    luaL_checktype(state, 1, LUA_TTABLE);
    const int type = lua_type(state, 2);
    luaL_argexpected(state, type == LUA_TNIL || type == LUA_TTABLE, 2, "nil or table");
    if (luaL_getmetafield(state, 1, "__metatable") != LUA_TNIL)
        return luaL_error(state, "cannot change a protected metatable");
    if (type == LUA_TTABLE) {
        lua_pushliteral(state, "__gc");
        if (lua_rawget(state, 2) != LUA_TNIL) return luaL_error(state, "finalizers (__gc) are not allowed");
    }
    lua_settop(state, 2);
    lua_setmetatable(state, 1);
    return 1;
}

// ---- pairs in order ----

int key_rank(lua_State* state, int index) {
    switch (lua_type(state, index)) {
    case LUA_TNUMBER:
        return 0;
    case LUA_TSTRING:
        return 1;
    default:
        return 2;
    }
}

// A string key is kept alive by the list it was read into.
struct SortKey {
    int rank;
    lua_Number number;
    const char* text;
    std::size_t size;
    lua_Integer place;
};

bool comes_before(const SortKey& a, const SortKey& b) {
    if (a.rank != b.rank) return a.rank < b.rank;
    if (a.rank == 0 && a.number != b.number) return a.number < b.number;
    if (a.rank == 1) {
        const int order = std::memcmp(a.text, b.text, std::min(a.size, b.size));
        if (order != 0) return order < 0;
        if (a.size != b.size) return a.size < b.size;
    }
    return a.place < b.place;
}

// Upvalues: the table, its keys in order, the place.
int next_in_order(lua_State* state) {
    for (;;) {
        const lua_Integer place = lua_tointeger(state, lua_upvalueindex(3)) + 1;
        lua_pushinteger(state, place);
        lua_replace(state, lua_upvalueindex(3));
        lua_settop(state, 0);
        if (lua_rawgeti(state, lua_upvalueindex(2), place) == LUA_TNIL) return 1;
        lua_pushvalue(state, 1);
        if (lua_rawget(state, lua_upvalueindex(1)) != LUA_TNIL) return 2; // else removed since
    }
}

int ordered_pairs(lua_State* state) {
    luaL_checktype(state, 1, LUA_TTABLE);
    if (luaL_getmetafield(state, 1, "__pairs") != LUA_TNIL) {
        lua_pushvalue(state, 1);
        lua_call(state, 1, 3);
        return 3;
    }
    lua_settop(state, 1);
    lua_newtable(state); // 2: keys as they come
    lua_Integer count = 0;
    bool sorted = true; // the array part comes in order already
    for (lua_pushnil(state); lua_next(state, 1);) {
        lua_pop(state, 1);
        lua_pushvalue(state, -1);
        lua_rawseti(state, 2, ++count);
        sorted = sorted && lua_isinteger(state, -1) && lua_tointeger(state, -1) == count;
    }
    charge(state, u64(count) * 2);
    if (!sorted) {
        auto* keys = static_cast<SortKey*>(lua_newuserdatauv(state, std::size_t(count) * sizeof(SortKey), 0)); // 3
        for (lua_Integer i = 1; i <= count; ++i) {
            lua_rawgeti(state, 2, i);
            SortKey& key = keys[i - 1];
            key = {key_rank(state, -1), 0, nullptr, 0, i};
            if (key.rank == 0) key.number = lua_tonumber(state, -1);
            if (key.rank == 1) key.text = lua_tolstring(state, -1, &key.size);
            lua_pop(state, 1);
        }
        std::sort(keys, keys + count, comes_before);
        lua_createtable(state, int(std::min<lua_Integer>(count, 1 << 24)), 0); // 4
        for (lua_Integer i = 1; i <= count; ++i) {
            lua_rawgeti(state, 2, keys[i - 1].place);
            lua_rawseti(state, 4, i);
        }
        lua_replace(state, 2);
        lua_settop(state, 2);
        charge(state, u64(count) * 8);
    }
    lua_pushinteger(state, 0);
    lua_pushcclosure(state, next_in_order, 3);
    return 1;
}

int safe_tonumber(lua_State* state) {
    if (lua_type(state, 1) == LUA_TSTRING && lua_rawlen(state, 1) > 4096) {
        lua_pushnil(state); // no number is as long
        return 1;
    }
    lua_pushvalue(state, lua_upvalueindex(1));
    lua_insert(state, 1);
    lua_call(state, lua_gettop(state) - 1, 1);
    return 1;
}

} // namespace

void open_base(lua_State* state) {
    luaL_requiref(state, LUA_GNAME, luaopen_base, 1);
    for (const char* name :
         {"load", "loadfile", "loadstring", "dofile", "require", "module", "collectgarbage", "warn", "print"}) {
        lua_pushnil(state);
        lua_setfield(state, -2, name);
    }
    static constexpr luaL_Reg replaced[] = {{"pcall", safe_pcall},
                                            {"xpcall", safe_xpcall},
                                            {"setmetatable", safe_setmetatable},
                                            {"pairs", ordered_pairs},
                                            {nullptr, nullptr}};
    luaL_setfuncs(state, replaced, 0);
    lua_getfield(state, -1, "tonumber");
    lua_pushcclosure(state, safe_tonumber, 1);
    lua_setfield(state, -2, "tonumber");
    lua_pop(state, 1);

    luaL_requiref(state, LUA_MATHLIBNAME, luaopen_math, 1);
    lua_getfield(state, -1, "randomseed");
    lua_pushinteger(state, 0x5eed);
    lua_call(state, 1, 0);
    lua_pushnil(state); // without an argument it would ask the clock
    lua_setfield(state, -2, "randomseed");
    lua_pop(state, 1);
    // requiref leaves the modules in the registry only, which no script reaches.
}

} // namespace vitrail::lua
