#include "lua/sandbox.h"

#include <chrono>
#include <cstdlib>
#include <ctime>
#include <fmt/format.h>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace vitrail::lua {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

std::unique_ptr<Sandbox> fresh(SandboxLimits limits = {}) {
    auto sandbox = Sandbox::create(limits);
    EXPECT_TRUE(sandbox);
    return std::move(*sandbox);
}

std::string text_of(const std::string& expression) {
    auto sandbox = fresh();
    const Result<Value> value = sandbox->evaluate("return tostring(" + expression + ")", "test");
    return value ? value->text() : "error: " + value.error().message;
}

ErrorCode code_of(const Result<>& result) {
    return result ? ErrorCode(-1) : result.error().code;
}

SandboxLimits small() {
    SandboxLimits limits;
    limits.instructions_most = 1'000'000;
    limits.memory_bytes_most = 8 << 20;
    limits.cpu_seconds_most = 5;
    return limits;
}

TEST(Sandbox, RunsPlainLua) {
    EXPECT_EQ(text_of("1 + 2"), "3");
    EXPECT_EQ(text_of("('x'):rep(3, '-')"), "x-x-x");
    EXPECT_EQ(text_of("select('#', table.unpack({1, 2, 3}))"), "3");
    EXPECT_EQ(text_of("table.concat({1, 2, 3}, ',')"), "1,2,3");
    EXPECT_EQ(text_of("math.max(3, 9, 4)"), "9");
    EXPECT_EQ(text_of("pcall(error, 'x')"), "false");
    EXPECT_EQ(text_of("select(2, pcall(error, 'x'))"), "x");
    EXPECT_EQ(text_of("select(2, xpcall(error, function(m) return m .. '!' end, 'x'))"), "x!");
    EXPECT_EQ(text_of("select(3, xpcall(function(a, b) return a, b end, print, 5, 6))"), "6");
    EXPECT_EQ(text_of("string.format('%d %5.2f %s', 3, 1.5, 'y')"), "3  1.50 y");
}

TEST(Sandbox, HostFunctionsAnswer) {
    auto sandbox = fresh();
    sandbox->set_query("give", [](std::span<const Value> arguments) -> Result<Value> {
        if (arguments.empty()) return Value{};
        if (arguments[0].table()) return fail(ErrorCode::invalid_argument, "no tables");
        return arguments[0];
    });
    const auto run = [&](const std::string& text) {
        const Result<> result = sandbox->run(text, "test");
        return result ? std::string() : result.error().message;
    };
    EXPECT_EQ(
        run("assert(give(7) == 7 and math.type(give(7)) == 'integer' and give(.5) == .5 and give('x\\0y') == 'x\\0y')"),
        "");
    EXPECT_EQ(run("assert(give(true) == true and give(false) == false and give() == nil and select('#', give()) == 0)"),
              "");
    EXPECT_EQ(run("assert(#give(('x'):rep(5000)) == 1023)"), "");
    EXPECT_EQ(run("\ngive({})"), "test:2: no tables");
}

// The limit is on what scripts take, not on what their thread did before.
TEST(Sandbox, ThreadsThatWorkedBeforeMayRunScripts) {
    SandboxLimits limits = small();
    limits.cpu_seconds_most = .15;
    const auto cpu = [] {
        timespec t{};
        clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
        return double(t.tv_sec) + double(t.tv_nsec) * 1e-9;
    };
    while (cpu() < .2) {
    }
    auto made = Sandbox::create(limits);
    ASSERT_TRUE(made);
    (*made)->set_function("host", [](std::span<const Value>) -> Result<> { return {}; });
    const Result<> run = (*made)->run("for i = 1, 20000 do end", "a.lua");
    EXPECT_TRUE(run) << run.error().message;
}

TEST(Sandbox, ErrorsSayWhere) {
    auto sandbox = fresh();
    EXPECT_EQ(sandbox->run("x = 1\nx.y.z = 2", "a.lua").error().message,
              "a.lua:2: attempt to index a number value (global 'x')");
    EXPECT_THAT(sandbox->run("x = = 1", "b.lua").error().message, StartsWith("b.lua:1: unexpected symbol"));
    ASSERT_TRUE(sandbox->run("function helper() error('no such thing') end", "h.lua"));
    EXPECT_EQ(sandbox->run("\n\nhelper()", "c.lua").error().message, "c.lua: h.lua:1: no such thing (from c.lua:3)");
    EXPECT_EQ(sandbox->run("error({})", "d.lua").error().message, "d.lua: error without a message");
    EXPECT_EQ(
        sandbox->run("error(setmetatable({}, {__tostring = function() while true do end end}))", "e.lua").error().code,
        ErrorCode::invalid_argument);
}

TEST(Sandbox, NothingReachesOutside) {
    auto sandbox = fresh();
    for (const char* name :
         {"load",        "loadfile",    "loadstring",    "dofile",          "require",   "module", "collectgarbage",
          "io",          "os",          "debug",         "package",         "coroutine", "utf8",   "warn",
          "string.dump", "string.pack", "string.unpack", "math.randomseed", "jit",       "bit32"}) {
        const Result<Value> value = sandbox->evaluate(fmt::format("return {}", name), "test");
        ASSERT_TRUE(value) << name;
        EXPECT_TRUE(value->is_nil()) << name;
    }
    // The globals are these and no others: whoever adds one looks here first.
    const Result<Value> names =
        sandbox->evaluate("local n = {} for k in pairs(_G) do n[#n + 1] = k end return table.concat(n, ' ')", "t");
    EXPECT_EQ(names->text(),
              "_G _VERSION assert error getmetatable ipairs math next pairs pcall print rawequal rawget rawlen rawset "
              "select setmetatable string table tonumber tostring type xpcall");
}

TEST(Sandbox, KnownEscapes) {
    auto sandbox = fresh();
    // Precompiled chunks are the classic way to memory.
    EXPECT_EQ(code_of(sandbox->run("\x1bLua", "bytecode")), ErrorCode::invalid_argument);
    EXPECT_EQ(code_of(sandbox->run(std::string("\x1bLua\x54\x00\x19\x93\r\n\x1a\n", 12), "bytecode")),
              ErrorCode::invalid_argument);
    // The metatable of strings is shared: changing it would change every later script.
    EXPECT_EQ(sandbox->evaluate("return tostring(getmetatable(''))", "t")->text(), "false");
    EXPECT_FALSE(sandbox->run("getmetatable('').__index = nil", "t"));
    EXPECT_FALSE(sandbox->run("setmetatable('', {})", "t"));
    // Finalizers run where no hook counts.
    EXPECT_THAT(sandbox->run("setmetatable({}, {__gc = function() while true do end end})", "t").error().message,
                HasSubstr("__gc"));
    EXPECT_TRUE(
        sandbox->run("local m = {} local t = setmetatable({}, m) m.__gc = function() while true do end end t = nil "
                     "for i = 1, 1e5 do local x = {} end",
                     "late finalizer is never armed"));
    EXPECT_FALSE(sandbox->run("local t = setmetatable({}, {__metatable = 1}) setmetatable(t, {})", "t"));
    // Through _G, _ENV, and what helpers return.
    EXPECT_FALSE(sandbox->run("_G.os.exit()", "t"));
    EXPECT_FALSE(sandbox->run("_ENV.io.open('/etc/passwd')", "t"));
    EXPECT_FALSE(sandbox->run("local f = string.gmatch('a', 'a') ; f.x = 1", "t"));
    EXPECT_FALSE(sandbox->run("pairs({}).__index = 1", "t"));
    EXPECT_TRUE(sandbox->run("assert(not pcall(string.rep, 'x', 1 << 40))", "t"));
    EXPECT_FALSE(sandbox->run("string.rep('x', math.maxinteger)", "t"));
    EXPECT_FALSE(sandbox->run("string.rep('', math.maxinteger, 'xx')", "t"));
    EXPECT_FALSE(sandbox->run("string.format('%1000d', 1)", "t"));
    EXPECT_FALSE(sandbox->run("return ('x'):rep(100, nil, nil):find(('('):rep(100))", "t"));
    EXPECT_FALSE(sandbox->spent());
}

// Each of these would hang or fill memory in a plain state. Alone and wrapped so that a script tries to catch the
// error.
TEST(Sandbox, EndlessScriptsEnd) {
    const char* scripts[] = {
        "while true do end",
        "local function f() return f() end f()",
        "for i = 1, math.huge do local x = {} end",
        "local t = {} for i = 1, math.huge do t[i] = i end",
        "local t = {} for i = 1, math.huge do t[i] = 'x' .. i end",
        "local s = 'x' while true do s = s .. s end",
        "while true do local x = ('x'):rep(1000000) end",
        "while true do local x = ('x'):rep(0, '') ; x = (''):rep(1e15) end",
        "while true do string.rep('', 1e9) end",
        "('a'):rep(100000):find(('.-'):rep(50) .. 'b')",
        "('a'):rep(30):match(('a*'):rep(30) .. 'b')",
        "('a'):rep(5000):gsub('(.-)(.-)(.-)(.-)b', '')",
        "for m in ('a'):rep(3000):gmatch('.-.-.-b') do end",
        "('('):rep(100000):find('%b()')  while true do ('('):rep(10000):gsub('%b()', '') end",
        "while true do ('x'):rep(1e6):find('y', 1, true) end",
        "local t = {} for i = 1, 20000 do t[i] = i end while true do table.insert(t, 1, 0) table.remove(t, 1) end",
        "local t = {} for i = 1, 60000 do t[i] = -i end while true do table.sort(t, function(a, b) return true end) "
        "end",
        "while true do pcall(table.sort, {3, 2, 1, 5, 6, 7}, function(a, b) return true end) end",
        "table.move({}, 1, math.maxinteger - 1, 2)",
        "while true do table.concat({}, '', 1, 0) ; table.unpack({}, 1, 60000) end",
        "setmetatable({}, {__index = function(t, k) return t[k + 1] end})[1] = nil ; local t = setmetatable({}, "
        "{__index = function(t, k) "
        "return t[k + 1] end}) while true do pcall(function() return t[1] end) end",
        "local a, b = ('x'):rep(3e6) .. 'a', ('x'):rep(3e6) .. 'b' while true do local x = a < b end",
        "local a, b = ('x'):rep(3e6) .. 'a', ('x'):rep(3e6) .. 'a' while true do local x = a == b end",
        "while true do xpcall(error, function(m) while true do end end) end",
        "xpcall(function() while true do end end, function() while true do end end)",
        "local function h() while true do end end xpcall(function() xpcall(function() while true do end end, h) end, "
        "h)",
        "pcall(function() local x <close> = setmetatable({}, {__close = function() while true do end end}) while true "
        "do end end)",
        "local t = {} for i = 1, 200000 do t[i] = 1 end for i = 1, 1e9 do for k in pairs(t) do break end end",
        "while true do tostring(setmetatable({}, {__tostring = function() return ('x'):rep(1e6) end})) end",
        "while true do print(('x'):rep(1e6)) end",
        "local f = function() return 1 end while true do f = f end",
        "goto a ::a:: goto a",
        "while true do select(-1, table.unpack({}, 1, 60000)) end",
        "while true do tonumber(('1'):rep(1e6)) end",
        "local t = {} for i = 1, 100000 do t[i] = {t} end while true do local s = {} for i = 1, 200000 do s[i] = {} "
        "end end",
        "while true do host({1, 2, 3}) end",
    };
    for (const char* script : scripts) {
        for (const char* form : {"{}", "pcall(function() {} end)", "while true do pcall(pcall, function() {} end) end",
                                 "while true do xpcall(function() {} end, function() while true do end end) end"}) {
            auto sandbox = fresh(small());
            sandbox->set_function("host", [](std::span<const Value>) -> Result<> { return {}; });
            const auto start = std::chrono::steady_clock::now();
            const Result<> result = sandbox->run(fmt::format(fmt::runtime(form), script), "t");
            const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
            if (std::string_view(form) != "{}") {
                EXPECT_EQ(code_of(result), ErrorCode::limit) << form << "\n" << script;
            }
            EXPECT_FALSE(result) << script;
            EXPECT_LT(sandbox->memory_bytes_peak(), (8u << 20) + 1);
            // Not a speed test: the limit on CPU time is 5 s, and none may need much more.
            EXPECT_LT(seconds, 60) << script;
            if (std::getenv("VITRAIL_VERBOSE") && seconds > 0.2)
                fmt::print("{:.2f} s: {} [{}]\n", seconds, script, result.error().message);
        }
    }
}

TEST(Sandbox, LimitsAreSticky) {
    auto sandbox = fresh(small());
    EXPECT_EQ(code_of(sandbox->run("while true do end", "a")), ErrorCode::limit);
    EXPECT_TRUE(sandbox->spent());
    EXPECT_EQ(code_of(sandbox->run("x = 1", "b")), ErrorCode::limit);
    sandbox = fresh(small());
    const Result<> memory = sandbox->run("local t = {} for i = 1, 1e9 do t[i] = {} end", "m.lua");
    EXPECT_THAT(memory.error().message, HasSubstr("m.lua: the memory limit"));
    EXPECT_EQ(code_of(sandbox->run("x = 1", "b")), ErrorCode::limit);
    sandbox = fresh(small());
    EXPECT_EQ(
        code_of(sandbox->run(
            "local ok = pcall(function() local t = {} for i = 1, 1e9 do t[i] = {} end end) survived = true", "a")),
        ErrorCode::limit);
}

TEST(Sandbox, LimitsAreExact) {
    SandboxLimits limits;
    limits.instructions_most = 100'000;
    auto sandbox = fresh(limits);
    EXPECT_TRUE(sandbox->run("for i = 1, 10000 do end", "a"));
    EXPECT_FALSE(sandbox->run("for i = 1, 1000000 do end", "a"));
    limits = {};
    limits.memory_bytes_most = 1000;
    EXPECT_EQ(Sandbox::create(limits).error().code, ErrorCode::limit);
    limits.memory_bytes_most = 200'000;
    sandbox = fresh(limits);
    EXPECT_TRUE(sandbox->run("x = ('x'):rep(1000)", "a"));
    EXPECT_FALSE(sandbox->run("x = ('x'):rep(150000) .. 'y'", "a"));
    limits = {};
    limits.source_bytes_most = 10;
    EXPECT_EQ(code_of(fresh(limits)->run("x = 1 -- comment", "a")), ErrorCode::limit);
    // Any memory limit whatever ends in a Result.
    for (std::size_t most = 0; most < 60'000; most += 777) {
        limits = {};
        limits.memory_bytes_most = most;
        auto made = Sandbox::create(limits);
        if (!made) continue;
        (*made)->set_function("host", [](std::span<const Value>) -> Result<> { return {}; });
        (void)(*made)->run("local t = {} for i = 1, 1000 do t[i] = 'x' .. i host(t) end error(table.concat(t))", "a");
    }
}

TEST(Sandbox, RunsAreTheSameEverywhere) {
    const char* script =
        "local t = {zeta = 1, alpha = 2, [3] = 'c', [1] = 'a', [true] = 'b', [2.5] = 'd', mid = 3} local out = {} "
        "for k, v in pairs(t) do out[#out + 1] = tostring(k) .. '=' .. tostring(v) end "
        "return table.concat(out, ' ') .. ' ' .. math.random(1000) .. ' ' .. math.random(1000)";
    const std::string first = fresh()->evaluate(script, "t")->text();
    EXPECT_THAT(first, StartsWith("1=a 2.5=d 3=c alpha=2 mid=3 zeta=1 true=b "));
    for (int i = 0; i < 5; ++i)
        EXPECT_EQ(fresh()->evaluate(script, "t")->text(), first);
    EXPECT_EQ(fresh()
                  ->evaluate("local t = {a = 1, b = 2, c = 3} local n = 0 for k in pairs(t) do t[k] = nil t.c = nil n "
                             "= n + 1 end return n",
                             "t")
                  ->text(),
              "2");
    EXPECT_EQ(fresh()
                  ->evaluate("local n = 0 for k, v in pairs(setmetatable({}, {__pairs = function() return next, {5} "
                             "end})) do n = n + v end "
                             "return n",
                             "t")
                  ->text(),
              "5");
}

TEST(Sandbox, HostFunctionsGetPlainValues) {
    auto sandbox = fresh();
    Value seen;
    sandbox->set_function("give", [&](std::span<const Value> arguments) -> Result<> {
        if (arguments.size() != 1) return fail(ErrorCode::invalid_argument, "give takes one argument");
        seen = arguments[0];
        return {};
    });
    ASSERT_TRUE(sandbox->run("give({name = 'x', 4, 5, deep = {yes = true, n = 1.5}})", "t"));
    ASSERT_TRUE(seen.table());
    EXPECT_FALSE(seen.table()->is_list());
    EXPECT_EQ(seen.table()->entries.size(), 4u);
    EXPECT_EQ(*seen.table()->find("name")->string(), "x");
    EXPECT_EQ(seen.table()->find("deep")->table()->find("yes")->text(), "true");
    EXPECT_EQ(seen.table()->find("deep")->table()->find("n")->number(), 1.5);
    EXPECT_EQ(sandbox->run("\ngive()", "t.lua").error().message, "t.lua:2: give takes one argument");
    EXPECT_THAT(sandbox->run("give(print)", "t.lua").error().message, HasSubstr("argument 1: a function is not data"));
    EXPECT_THAT(sandbox->run("give({[{}] = 1})", "t.lua").error().message, HasSubstr("cannot be a key"));
    EXPECT_THAT(sandbox->run("local t = {} t.t = t give(t)", "t.lua").error().message, HasSubstr("nest deeper"));
    EXPECT_THAT(sandbox->run("local t = {} for i = 1, 300000 do t[i] = i end give(t)", "t.lua").error().message,
                HasSubstr("entries"));
    EXPECT_TRUE(sandbox->run("assert(not pcall(give))", "t"));
    ASSERT_TRUE(sandbox->run("print('hello', 3)", "t"));
    EXPECT_EQ(sandbox->output(), "hello\t3\n");
}

} // namespace
} // namespace vitrail::lua
