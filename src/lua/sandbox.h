// Sandbox: a Lua 5.4 state that can do nothing but compute, within limits, and call what the host gives it.
//
//     auto sandbox = lua::Sandbox::create();
//     (*sandbox)->set_function("define_block", [&](std::span<const lua::Value> arguments) -> Result<> { ... });
//     VX_TRY((*sandbox)->run(text, "content/base/stone.lua"));
//
// What is there: the plain base functions, math, table and string. What is not: load, loadfile, dofile, require,
// collectgarbage, io, os, debug, package, coroutine, utf8, string.dump/pack/unpack; precompiled chunks; finalizers
// (__gc). What differs: `pairs` goes through keys in order (numbers, then strings), math.random starts from a fixed
// seed, and table functions take only tables without a metatable, so that a run is the same on every machine and none
// can loop in C.
//
// Limits, all of them sticky: once one is passed, nothing runs in this sandbox again, and pcall does not catch it.
//   memory        by the allocator
//   instructions  by a hook; library functions charge for the work they do inside one call (pattern steps, elements
//   moved,
//                 bytes made), and so does the allocator for bytes handed out
//   CPU time      a backstop for what is neither, such as comparing very long strings
#pragma once

#include "base/result.h"
#include "base/types.h"
#include "lua/value.h"

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>

namespace vitrail::lua {

inline constexpr std::size_t kAnswerBytesMost = 1023; // of a text that a host function gives back

struct SandboxLimits {
    std::size_t memory_bytes_most = std::size_t(64) << 20;
    u64 instructions_most = 50'000'000;
    double cpu_seconds_most = 20;
    std::size_t source_bytes_most = std::size_t(4) << 20; // of one chunk
    std::size_t output_bytes_most = 64 << 10;             // of print
};

class Sandbox {
public:
    // Errors: limit, where the memory does not even hold the library.
    static Result<std::unique_ptr<Sandbox>> create(const SandboxLimits& limits = {});
    ~Sandbox();
    Sandbox(const Sandbox&) = delete;
    Sandbox& operator=(const Sandbox&) = delete;

    // Its error becomes a Lua error at the place of the call. The arguments live as long as the call.
    using HostFunction = std::function<Result<>(std::span<const Value> arguments)>;
    void set_function(const std::string& name, HostFunction function);
    // One that answers: nothing, a boolean, a number or a text of at most kAnswerBytesMost bytes.
    using QueryFunction = std::function<Result<Value>(std::span<const Value> arguments)>;
    void set_query(const std::string& name, QueryFunction function);

    // Runs a text chunk; `name` is what messages call it. Errors: invalid_argument with `name:line: message` for a
    // script's own mistakes, limit once a limit is passed.
    Result<> run(std::string_view text, const std::string& name);
    // Runs a chunk and gives its first return value.
    Result<Value> evaluate(std::string_view text, const std::string& name);

    bool spent() const;
    u64 instructions_used() const;
    std::size_t memory_bytes_peak() const;
    const std::string& output() const; // what print wrote

private:
    Sandbox() = default;
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace vitrail::lua
