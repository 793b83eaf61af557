// Our pattern functions against Lua's own, on random patterns and subjects.
#include "lua/pattern.h"

#include "base/rng.h"
#include "lua/sandbox.h"

#include <gtest/gtest.h>
#include <lua5.4/lua.hpp>

namespace vitrail::lua {
namespace {

std::string random_text(Rng& rng, const char* letters, u32 most) {
    std::string out;
    const u32 count = u32(std::string_view(letters).size());
    for (u32 n = rng.below(most + 1); n > 0; --n)
        out += letters[rng.below(count)];
    return out;
}

std::string random_pattern(Rng& rng) {
    static const char* pieces[] = {"a",     "b",  ".", "%a", "%d", "[ab]", "[^a]",  "[a-c]", "*",  "+",  "-",
                                   "?",     "(",  ")", "()", "%1", "%b()", "%f[a]", "$",     "^",  "%s", "%W",
                                   "[%w_]", "%%", "]", "[",  "%",  "[]]",  "[^]a]", "[a-]",  "%2", "x"};
    std::string out;
    for (u32 n = rng.below(7); n > 0; --n)
        out += pieces[rng.below(std::size(pieces))];
    return out;
}

// The results of one call, as text; errors become "error".
std::string plain_call(lua_State* state, const std::string& code) {
    lua_settop(state, 0);
    if (luaL_loadstring(state, code.c_str()) != LUA_OK || lua_pcall(state, 0, 1, 0) != LUA_OK) return "error";
    std::size_t size = 0;
    const char* text = luaL_tolstring(state, -1, &size);
    return {text, size};
}

std::string quoted(const std::string& text) {
    std::string out = "\"";
    for (const char c : text)
        out += c == '"' || c == '\\' ? std::string("\\") + c : std::string(1, c);
    return out + "\"";
}

TEST(Pattern, SameAsLua) {
    lua_State* plain = luaL_newstate();
    luaL_openlibs(plain);
    SandboxLimits limits;
    limits.instructions_most = 1'000'000'000;
    auto sandbox = std::move(*Sandbox::create(limits));
    const char* join =
        "local function j(...) local o = {} for i = 1, select('#', ...) do o[i] = tostring((select(i, ...))) end "
        "return table.concat(o, '|') end ";
    Rng rng(11);
    int matched = 0, errors = 0;
    for (int i = 0; i < 30000; ++i) {
        const std::string subject = random_text(rng, "aabbc (1)_x.", 14), pattern = random_pattern(rng);
        const std::string s = quoted(subject), p = quoted(pattern);
        const int at = int(rng.below(12)) - 5;
        std::string call;
        switch (rng.below(6)) {
        case 0:
            call = "string.find(" + s + "," + p + "," + std::to_string(at) + ")";
            break;
        case 1:
            call = "string.match(" + s + "," + p + "," + std::to_string(at) + ")";
            break;
        case 2:
            call = "string.gsub(" + s + "," + p + "," + quoted(random_text(rng, "ab%%01", 4)) + ")";
            break;
        case 3:
            call = "string.gsub(" + s + "," + p + ", function(...) return j(...) .. ';' end, " +
                   std::to_string(rng.below(4)) + ")";
            break;
        case 4:
            call = "string.gsub(" + s + "," + p + ", {a = 1, b = false, aa = 'AA', [1] = 'one'})";
            break;
        default:
            call = "(function() local o = '' for a, b in string.gmatch(" + s + "," + p + "," + std::to_string(at) +
                   ") do o = o .. '<' .. j(a, b) .. '>' end return o end)()";
        }
        const std::string code = join + std::string("return j(") + call + ")";
        const std::string want = plain_call(plain, code);
        const Result<Value> got = sandbox->evaluate(code, "t");
        ASSERT_EQ(got ? got->text() : "error", want) << call << (got ? "" : got.error().message);
        matched += want != "nil" && want != "error";
        errors += want == "error";
    }
    EXPECT_GT(matched, 5000);
    EXPECT_GT(errors, 1000);
    lua_close(plain);
}

TEST(Pattern, StepsAreBounded) {
    const std::string subject(200, 'a');
    std::string pattern;
    for (int i = 0; i < 20; ++i)
        pattern += "a-";
    const PatternMatch match = match_pattern(subject, pattern + "b", 0, false, 100'000);
    EXPECT_TRUE(match.out_of_steps);
    EXPECT_LE(match.steps, 100'001u);
    EXPECT_FALSE(match_pattern(std::string(1000, '('), "%b()", 0, false, 1'000'000).out_of_steps);
    EXPECT_NE(match_pattern("x", std::string(300, '(') + "x", 0, true, 1000).error, nullptr);
}

} // namespace
} // namespace vitrail::lua
