// Meter: what a sandbox has spent. Library functions find it through the Lua state and charge for the work of one call.
#pragma once

#include "base/types.h"

#include <cstddef>
#include <lua5.4/lua.hpp>

namespace vitrail::lua {

struct Meter {
    // Limits
    std::size_t memory_most = 0;
    u64 work_most = 0; // instructions
    double cpu_seconds_most = 0;
    // Spent
    std::size_t memory = 0, memory_peak = 0;
    u64 work = 0;
    u64 bytes_handed_out = 0; // not yet charged
    u64 hooks = 0;
    double cpu_start = -1; // of the thread's clock at the first work; negative: none yet
    const char* exceeded = nullptr; // the limit that was passed; from then on nothing runs

    void add_work(u64 amount);
};

// Lua's allocator over a Meter (its user data).
void* metered_allocate(void* meter, void* block, std::size_t old_size, std::size_t new_size);

Meter& meter_of(lua_State* state);
// Counts `amount` instructions' worth of work; raises the sticky error where that is too much.
void charge(lua_State* state, u64 amount);
// Raises the sticky error.
[[noreturn]] void raise_exceeded(lua_State* state);
// Starts counting instructions in this state.
void install_hook(lua_State* state);

// Opens the library (sandbox.h says what is in it); called protected.
void open_base(lua_State* state);
void open_string(lua_State* state);
void open_table(lua_State* state);

} // namespace vitrail::lua
