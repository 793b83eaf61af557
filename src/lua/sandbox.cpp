#include "lua/sandbox.h"

#include "lua/meter.h"

#include <cstring>
#include <fmt/format.h>
#include <map>

namespace vitrail::lua {

struct Sandbox::State {
    SandboxLimits limits;
    Meter meter;
    lua_State* state = nullptr;
    std::string output;
    std::map<std::string, QueryFunction> functions; // nodes stay in place

    ~State() {
        if (state) lua_close(state);
    }

    static int print(lua_State* state);
    static int call_host(lua_State* state);
    static int open_libraries(lua_State* state);
    static int set_global(lua_State* state);
    Result<> call(std::string_view text, const std::string& name, int results);
    Error error_of(int status, const std::string& name);
};

namespace {

// What a host function gave, as plain data: nothing here may need a destructor where Lua raises an error.
struct Answer {
    enum { failed, nothing, boolean, whole, number, text } kind = nothing;
    bool truth = false;
    i64 integer = 0;
    double real = 0;
    std::size_t size = 0;
    char bytes[kAnswerBytesMost + 1]; // of a text, or of the reason why it failed

    void set_text(const std::string& from) {
        size = std::min(from.size(), kAnswerBytesMost);
        std::memcpy(bytes, from.data(), size);
        bytes[size] = '\0';
    }
    void set(const Value& value) {
        if (const bool* b = value.boolean()) kind = boolean, truth = *b;
        if (const i64* i = std::get_if<i64>(&value.data)) kind = whole, integer = *i;
        if (const double* d = std::get_if<double>(&value.data)) kind = number, real = *d;
        if (const std::string* s = value.string()) kind = text, set_text(*s);
    }
};

// Runs a host function. Nothing here raises, so that destructors run.
void invoke(lua_State* state, const Sandbox::QueryFunction& function, Answer& answer) {
    std::vector<Value> arguments;
    const int count = lua_gettop(state);
    Result<Value> result;
    for (int i = 1; i <= count && result; ++i) {
        Result<Value> value = read_value(state, i);
        if (value)
            arguments.push_back(std::move(*value));
        else
            result = fail(value.error().code, fmt::format("argument {}: {}", i, value.error().message));
    }
    if (result) result = function(arguments);
    if (result) return answer.set(*result);
    answer.kind = Answer::failed;
    answer.set_text(result.error().message);
}

// Adds where in the chunk itself an error began, when helper functions lie between.
int add_place(lua_State* state) {
    if (lua_type(state, 1) != LUA_TSTRING || meter_of(state).exceeded) return 1;
    lua_Debug info;
    for (int level = 1; level < 64 && lua_getstack(state, level, &info); ++level) {
        if (!lua_getinfo(state, "Sl", &info) || std::strcmp(info.what, "main") != 0) continue;
        lua_pushfstring(state, "%s:%d:", info.short_src, info.currentline);
        std::size_t size = 0;
        const char* place = lua_tolstring(state, -1, &size);
        if (std::strncmp(lua_tostring(state, 1), place, size) == 0) break;
        lua_pushfstring(state, "%s (from %s:%d)", lua_tostring(state, 1), info.short_src, info.currentline);
        return 1;
    }
    lua_settop(state, 1);
    return 1;
}

} // namespace

int Sandbox::State::print(lua_State* state) {
    State& self = *static_cast<State*>(lua_touserdata(state, lua_upvalueindex(1)));
    const int count = lua_gettop(state);
    for (int i = 1; i <= count; ++i) {
        std::size_t size = 0;
        const char* text = luaL_tolstring(state, i, &size);
        charge(state, size / 64 + 1);
        const std::size_t left = self.limits.output_bytes_most - self.output.size();
        self.output.append(text, std::min(size, left));
        if (self.output.size() < self.limits.output_bytes_most) self.output += i < count ? '\t' : '\n';
        lua_pop(state, 1);
    }
    return 0;
}

int Sandbox::State::call_host(lua_State* state) {
    Answer answer;
    charge(state, 10);
    invoke(state, *static_cast<const QueryFunction*>(lua_touserdata(state, lua_upvalueindex(1))), answer);
    switch (answer.kind) {
    case Answer::failed:
        return luaL_error(state, "%s", answer.bytes);
    case Answer::nothing:
        return 0;
    case Answer::boolean:
        lua_pushboolean(state, answer.truth);
        return 1;
    case Answer::whole:
        lua_pushinteger(state, answer.integer);
        return 1;
    case Answer::number:
        lua_pushnumber(state, answer.real);
        return 1;
    case Answer::text:
        lua_pushlstring(state, answer.bytes, answer.size);
        return 1;
    }
    return 0;
}

int Sandbox::State::open_libraries(lua_State* state) {
    open_base(state);
    open_string(state);
    open_table(state);
    lua_pushvalue(state, 1);
    lua_pushcclosure(state, print, 1);
    lua_setglobal(state, "print");
    return 0;
}

// Arguments: the name, the QueryFunction.
int Sandbox::State::set_global(lua_State* state) {
    lua_pushvalue(state, 2);
    lua_pushcclosure(state, call_host, 1);
    lua_setglobal(state, static_cast<const std::string*>(lua_touserdata(state, 1))->c_str());
    return 0;
}

Result<std::unique_ptr<Sandbox>> Sandbox::create(const SandboxLimits& limits) {
    std::unique_ptr<Sandbox> sandbox(new Sandbox);
    sandbox->state_ = std::make_unique<State>();
    State& self = *sandbox->state_;
    self.limits = limits;
    self.meter.memory_most = limits.memory_bytes_most;
    self.meter.work_most = limits.instructions_most;
    self.meter.cpu_seconds_most = limits.cpu_seconds_most;
    self.state = lua_newstate(metered_allocate, &self.meter);
    if (!self.state) return fail(ErrorCode::limit, "not enough memory for a Lua state");
    lua_pushcfunction(self.state, State::open_libraries);
    lua_pushlightuserdata(self.state, &self);
    if (lua_pcall(self.state, 1, 0, 0) != LUA_OK)
        return fail(ErrorCode::limit, "not enough memory for the Lua library");
    self.meter.work = 0;
    install_hook(self.state);
    return sandbox;
}

Sandbox::~Sandbox() = default;

void Sandbox::set_function(const std::string& name, HostFunction function) {
    set_query(name, [called = std::move(function)](std::span<const Value> arguments) -> Result<Value> {
        VX_TRY(called(arguments));
        return Value{};
    });
}

void Sandbox::set_query(const std::string& name, QueryFunction function) {
    State& self = *state_;
    QueryFunction& kept = self.functions[name] = std::move(function);
    lua_pushcfunction(self.state, State::set_global);
    lua_pushlightuserdata(self.state, const_cast<std::string*>(&name));
    lua_pushlightuserdata(self.state, &kept);
    if (lua_pcall(self.state, 2, 0, 0) != LUA_OK) {
        self.meter.exceeded = "memory";
        lua_settop(self.state, 0);
    }
}

Error Sandbox::State::error_of(int status, const std::string& name) {
    if (status == LUA_ERRMEM && !meter.exceeded) meter.exceeded = "memory";
    if (meter.exceeded)
        return {ErrorCode::limit, fmt::format("{}: the {} limit of scripts is passed", name, meter.exceeded)};
    std::string message = "error without a message";
    if (lua_type(state, -1) == LUA_TSTRING) { // others are not asked for one: that would run the script again
        std::size_t size = 0;
        const char* text = lua_tolstring(state, -1, &size);
        message.assign(text, std::min<std::size_t>(size, 2048));
        for (char& c : message)
            if (static_cast<unsigned char>(c) < ' ') c = ' ';
    }
    if (!message.starts_with(name)) message = name + ": " + message;
    return {ErrorCode::invalid_argument, std::move(message)};
}

Result<> Sandbox::State::call(std::string_view text, const std::string& name, int results) {
    lua_settop(state, 0);
    if (meter.exceeded) return tl::unexpected(error_of(LUA_OK, name));
    if (text.size() > limits.source_bytes_most)
        return fail(ErrorCode::limit, fmt::format("{}: longer than {} bytes", name, limits.source_bytes_most));
    lua_pushcfunction(state, add_place);
    // Reading costs too, by length: the parser runs no instructions.
    meter.add_work(text.size() / 8);
    const std::string chunk_name = "@" + name;
    int status = luaL_loadbufferx(state, text.data(), text.size(), chunk_name.c_str(), "t");
    if (status == LUA_OK) status = lua_pcall(state, 0, results, 1);
    if (status == LUA_OK && !meter.exceeded) return {};
    Error error = error_of(status, name);
    lua_settop(state, 0);
    return tl::unexpected(std::move(error));
}

Result<> Sandbox::run(std::string_view text, const std::string& name) {
    return state_->call(text, name, 0);
}

Result<Value> Sandbox::evaluate(std::string_view text, const std::string& name) {
    VX_TRY(state_->call(text, name, 1));
    Result<Value> value = read_value(state_->state, -1);
    lua_settop(state_->state, 0);
    return value;
}

bool Sandbox::spent() const {
    return state_->meter.exceeded != nullptr;
}
u64 Sandbox::instructions_used() const {
    return state_->meter.work;
}
std::size_t Sandbox::memory_bytes_peak() const {
    return state_->meter.memory_peak;
}
const std::string& Sandbox::output() const {
    return state_->output;
}

} // namespace vitrail::lua
