// The string functions of a sandbox: Lua's own, but for those whose work inside one call has no bound.
#include "lua/meter.h"
#include "lua/pattern.h"

#include <algorithm>
#include <cstring>

namespace vitrail::lua {

namespace {

constexpr u64 kStepsAnInstruction = 4; // of the pattern matcher
constexpr u64 kBytesAnInstruction = 64;

std::string_view check_view(lua_State* state, int argument) {
    std::size_t size = 0;
    const char* text = luaL_checklstring(state, argument, &size);
    return {text, size};
}

// Everything in this file must hold only plain data where Lua may raise.
PatternMatch metered_match(lua_State* state, std::string_view subject, std::string_view pattern, std::size_t start,
                           bool anchored) {
    const Meter& meter = meter_of(state);
    const u64 left = meter.work < meter.work_most ? meter.work_most - meter.work : 0;
    const PatternMatch match =
        match_pattern(subject, pattern, start, anchored, left * kStepsAnInstruction + kStepsAnInstruction);
    charge(state, match.steps / kStepsAnInstruction + 1);
    if (match.error) luaL_error(state, "%s", match.error);
    return match;
}

// The i-th capture, or the whole match where the pattern has none.
void push_capture(lua_State* state, std::string_view subject, const PatternMatch& match, int i) {
    if (i >= match.captures) {
        if (i != 0) luaL_error(state, "invalid capture index %%%d", i + 1);
        lua_pushlstring(state, subject.data() + match.begin, match.end - match.begin);
        return;
    }
    const PatternCapture& c = match.capture[i];
    if (c.size == kCapturePosition)
        lua_pushinteger(state, lua_Integer(c.start) + 1);
    else if (c.size == kCaptureOpen)
        luaL_error(state, "unfinished capture");
    else
        lua_pushlstring(state, subject.data() + c.start, std::size_t(c.size));
}

int push_captures(lua_State* state, std::string_view subject, const PatternMatch& match, bool whole_too) {
    const int count = match.captures == 0 && whole_too ? 1 : match.captures;
    luaL_checkstack(state, count, "too many captures");
    for (int i = 0; i < count; ++i)
        push_capture(state, subject, match, i);
    return count;
}

// A start argument (1-based, negative from the end) as an offset; past the end gives size + 1.
std::size_t start_offset(lua_State* state, int argument, std::size_t size) {
    const lua_Integer at = luaL_optinteger(state, argument, 1);
    if (at > 0) return std::min(std::size_t(at) - 1, size + 1);
    if (at == 0 || at < -lua_Integer(size)) return 0;
    return std::size_t(lua_Integer(size) + at);
}

bool strip_anchor(std::string_view& pattern) {
    if (!pattern.starts_with('^')) return false;
    pattern.remove_prefix(1);
    return true;
}

int find_or_match(lua_State* state, bool find) {
    const std::string_view subject = check_view(state, 1);
    std::string_view pattern = check_view(state, 2);
    const std::size_t start = start_offset(state, 3, subject.size());
    if (start > subject.size()) {
        lua_pushnil(state);
        return 1;
    }
    if (find && (lua_toboolean(state, 4) || pattern.find_first_of("^$*+?.([%-") == std::string_view::npos)) {
        charge(state, (subject.size() - start) / kBytesAnInstruction + 1);
        // memmem of glibc takes linear time, which std::string_view::find does not.
        const void* found = memmem(subject.data() + start, subject.size() - start, pattern.data(), pattern.size());
        if (!found) {
            lua_pushnil(state);
            return 1;
        }
        const auto at = lua_Integer(static_cast<const char*>(found) - subject.data());
        lua_pushinteger(state, at + 1);
        lua_pushinteger(state, at + lua_Integer(pattern.size()));
        return 2;
    }
    const bool anchored = strip_anchor(pattern);
    const PatternMatch match = metered_match(state, subject, pattern, start, anchored);
    if (!match.matched) {
        lua_pushnil(state);
        return 1;
    }
    if (!find) return push_captures(state, subject, match, true);
    lua_pushinteger(state, lua_Integer(match.begin) + 1);
    lua_pushinteger(state, lua_Integer(match.end));
    return 2 + push_captures(state, subject, match, false);
}

int safe_find(lua_State* state) {
    return find_or_match(state, true);
}
int safe_match(lua_State* state) {
    return find_or_match(state, false);
}

// Upvalues: subject, pattern, where to go on, end of the last match (so that an empty match does not repeat it).
int gmatch_next(lua_State* state) {
    std::size_t size = 0;
    const char* text = lua_tolstring(state, lua_upvalueindex(1), &size);
    const std::string_view subject(text, size);
    text = lua_tolstring(state, lua_upvalueindex(2), &size);
    const std::string_view pattern(text, size);
    auto from = std::size_t(lua_tointeger(state, lua_upvalueindex(3)));
    const lua_Integer last_end = lua_tointeger(state, lua_upvalueindex(4));
    while (from <= subject.size()) {
        const PatternMatch match = metered_match(state, subject, pattern, from, false);
        if (!match.matched) break;
        if (lua_Integer(match.end) == last_end) { // empty, right after the last one
            from = match.begin + 1;
            continue;
        }
        lua_pushinteger(state, lua_Integer(match.end));
        lua_copy(state, -1, lua_upvalueindex(3));
        lua_replace(state, lua_upvalueindex(4));
        return push_captures(state, subject, match, true);
    }
    lua_pushinteger(state, lua_Integer(subject.size()) + 1);
    lua_replace(state, lua_upvalueindex(3));
    lua_pushnil(state);
    return 1;
}

int safe_gmatch(lua_State* state) {
    const std::string_view subject = check_view(state, 1);
    check_view(state, 2);
    const std::size_t start = start_offset(state, 3, subject.size());
    lua_settop(state, 2);
    lua_pushinteger(state, lua_Integer(start));
    lua_pushinteger(state, -1);
    lua_pushcclosure(state, gmatch_next, 4);
    return 1;
}

void add_template(lua_State* state, luaL_Buffer* out, std::string_view subject, const PatternMatch& match) {
    std::size_t size = 0;
    const char* text = lua_tolstring(state, 3, &size);
    for (std::size_t i = 0; i < size; ++i) {
        if (text[i] != '%') {
            luaL_addchar(out, text[i]);
            continue;
        }
        const char c = ++i < size ? text[i] : '\0';
        if (c == '%')
            luaL_addchar(out, '%');
        else if (c == '0')
            luaL_addlstring(out, subject.data() + match.begin, match.end - match.begin);
        else if (c >= '1' && c <= '9') {
            push_capture(state, subject, match, c - '1');
            luaL_tolstring(state, -1, nullptr); // a position is a number
            lua_remove(state, -2);
            luaL_addvalue(out);
        } else
            luaL_error(state, "invalid use of '%%' in replacement string");
    }
    charge(state, size / 8 + 1);
}

// Adds what the match becomes; false where it stays.
void add_replacement(lua_State* state, luaL_Buffer* out, std::string_view subject, const PatternMatch& match,
                     int type) {
    switch (type) {
    case LUA_TFUNCTION:
        lua_pushvalue(state, 3);
        lua_call(state, push_captures(state, subject, match, true), 1);
        break;
    case LUA_TTABLE:
        push_capture(state, subject, match, 0);
        lua_gettable(state, 3);
        break;
    default:
        add_template(state, out, subject, match);
        return;
    }
    if (!lua_toboolean(state, -1)) {
        lua_pop(state, 1);
        luaL_addlstring(out, subject.data() + match.begin, match.end - match.begin);
    } else if (lua_isstring(state, -1))
        luaL_addvalue(out);
    else
        luaL_error(state, "invalid replacement value (a %s)", luaL_typename(state, -1));
}

int safe_gsub(lua_State* state) {
    const std::string_view subject = check_view(state, 1);
    std::string_view pattern = check_view(state, 2);
    const int type = lua_type(state, 3);
    luaL_argexpected(state, type == LUA_TNUMBER || type == LUA_TSTRING || type == LUA_TTABLE || type == LUA_TFUNCTION,
                     3, "string/function/table");
    const lua_Integer most = luaL_optinteger(state, 4, lua_Integer(subject.size()) + 1);
    if (type == LUA_TNUMBER) lua_tolstring(state, 3, nullptr);
    const bool anchored = strip_anchor(pattern);
    luaL_Buffer out;
    luaL_buffinit(state, &out);
    std::size_t at = 0, copied = 0;
    lua_Integer count = 0, last_end = -1;
    while (count < most && at <= subject.size()) {
        const PatternMatch match = metered_match(state, subject, pattern, at, anchored);
        if (!match.matched) break;
        if (lua_Integer(match.end) == last_end) {
            at = match.begin + 1;
        } else {
            luaL_addlstring(&out, subject.data() + copied, match.begin - copied);
            add_replacement(state, &out, subject, match, type);
            copied = at = match.end;
            last_end = lua_Integer(match.end);
            ++count;
        }
        if (anchored) break;
    }
    luaL_addlstring(&out, subject.data() + copied, subject.size() - copied);
    luaL_pushresult(&out);
    lua_pushinteger(state, count);
    return 2;
}

int safe_rep(lua_State* state) {
    const std::string_view text = check_view(state, 1);
    const lua_Integer count = luaL_checkinteger(state, 2);
    std::size_t between = 0;
    luaL_optlstring(state, 3, "", &between);
    const u64 piece = text.size() + between;
    // Known before anything is made, whatever the count.
    if (count > 0 && piece > 0 && u64(count) > meter_of(state).memory_most / piece)
        return luaL_error(state, "resulting string too large");
    if (count > 0) charge(state, u64(count) / 8 + 1); // pieces may be empty
    lua_pushvalue(state, lua_upvalueindex(1));
    lua_insert(state, 1);
    lua_call(state, lua_gettop(state) - 1, 1);
    return 1;
}

// Lua's own function, charged by the length of its first argument.
int charged_by_length(lua_State* state) {
    const std::string_view text = check_view(state, 1);
    charge(state, text.size() / 8 + 1);
    lua_pushvalue(state, lua_upvalueindex(1));
    lua_insert(state, 1);
    lua_call(state, lua_gettop(state) - 1, LUA_MULTRET);
    return lua_gettop(state);
}

} // namespace

void open_string(lua_State* state) {
    luaL_requiref(state, LUA_STRLIBNAME, luaopen_string, 1);
    for (const char* name : {"dump", "pack", "unpack", "packsize"}) {
        lua_pushnil(state);
        lua_setfield(state, -2, name);
    }
    static constexpr luaL_Reg wrapped[] = {{"rep", safe_rep},
                                           {"format", charged_by_length},
                                           {"byte", charged_by_length},
                                           {"lower", charged_by_length},
                                           {"upper", charged_by_length},
                                           {"reverse", charged_by_length}};
    for (const luaL_Reg& entry : wrapped) {
        lua_getfield(state, -1, entry.name);
        lua_pushcclosure(state, entry.func, 1);
        lua_setfield(state, -2, entry.name);
    }
    static constexpr luaL_Reg replaced[] = {
        {"find", safe_find}, {"match", safe_match}, {"gmatch", safe_gmatch}, {"gsub", safe_gsub}, {nullptr, nullptr}};
    luaL_setfuncs(state, replaced, 0);
    lua_pop(state, 1);

    // The metatable of all strings: scripts may use ("x"):upper(), not reach or change the table.
    lua_pushliteral(state, "");
    lua_getmetatable(state, -1);
    lua_pushboolean(state, 0);
    lua_setfield(state, -2, "__metatable");
    lua_pop(state, 2);
}

} // namespace vitrail::lua
