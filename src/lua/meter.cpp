#include "lua/meter.h"

#include <cstdlib>
#include <ctime>

namespace vitrail::lua {

namespace {

constexpr int kHookInstructions = 128;  // between two looks at the meter
constexpr u64 kBytesAnInstruction = 64; // handed out by the allocator: about what one instruction's time fills

double cpu_now() {
    timespec t{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return double(t.tv_sec) + double(t.tv_nsec) * 1e-9;
}

void on_count(lua_State* state, lua_Debug*) {
    Meter& meter = meter_of(state);
    if (!meter.exceeded) {
        meter.add_work(kHookInstructions);
        // The clock is read seldom: it costs more than the instructions between two hooks.
        if (++meter.hooks % 16 == 0 && cpu_now() - meter.cpu_start > meter.cpu_seconds_most)
            meter.exceeded = "CPU time";
    }
    if (meter.exceeded) raise_exceeded(state);
}

} // namespace

void Meter::add_work(u64 amount) {
    if (cpu_start < 0) cpu_start = cpu_now();
    work += amount;
    if (work > work_most && !exceeded) exceeded = "instruction";
}

void* metered_allocate(void* user, void* block, std::size_t old_size, std::size_t new_size) {
    Meter& meter = *static_cast<Meter*>(user);
    if (!block) old_size = 0; // Lua passes a kind of object there
    if (new_size == 0) {
        meter.memory -= old_size;
        std::free(block);
        return nullptr;
    }
    if (new_size > old_size) { // Lua relies on shrinking to succeed
        const std::size_t more = new_size - old_size;
        if (meter.exceeded) return nullptr;
        if (more > meter.memory_most - meter.memory) {
            // Lua answers with a full collection and asks again: a script at the limit would do that all the time.
            meter.work += meter.memory / 16;
            return nullptr;
        }
        // Making and dropping long strings is work that few instructions show.
        meter.bytes_handed_out += new_size;
        meter.work += meter.bytes_handed_out / kBytesAnInstruction;
        meter.bytes_handed_out %= kBytesAnInstruction;
        if (meter.work > meter.work_most) {
            meter.exceeded = "instruction";
            return nullptr;
        }
    }
    void* moved = std::realloc(block, new_size);
    if (!moved) return new_size <= old_size ? block : nullptr;
    meter.memory += new_size - old_size;
    if (meter.memory > meter.memory_peak) meter.memory_peak = meter.memory;
    return moved;
}

Meter& meter_of(lua_State* state) {
    void* user = nullptr;
    lua_getallocf(state, &user);
    return *static_cast<Meter*>(user);
}

void charge(lua_State* state, u64 amount) {
    Meter& meter = meter_of(state);
    meter.add_work(amount);
    if (meter.exceeded) raise_exceeded(state);
}

void raise_exceeded(lua_State* state) {
    // From here on every instruction ends here, so that no handler gets far.
    lua_sethook(state, on_count, LUA_MASKCOUNT, 1);
    // A light value: there may be no memory left for a message. The sandbox words it from the meter.
    lua_pushlightuserdata(state, &meter_of(state));
    lua_error(state);
    std::abort(); // lua_error does not return
}

void install_hook(lua_State* state) {
    lua_sethook(state, on_count, LUA_MASKCOUNT, kHookInstructions);
}

} // namespace vitrail::lua
