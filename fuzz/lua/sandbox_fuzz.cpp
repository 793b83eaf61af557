// Random text as a script, as a pattern, and as what a pattern is looked for in: never a crash, never without end.
#include "lua/pattern.h"
#include "lua/sandbox.h"

#include <cstdlib>

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
    using namespace vitrail;
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    lua::SandboxLimits limits;
    limits.instructions_most = 200'000;
    limits.memory_bytes_most = 4 << 20;
    limits.cpu_seconds_most = 2;
    auto sandbox = lua::Sandbox::create(limits);
    if (!sandbox) std::abort();
    (*sandbox)->set_function("host", [](std::span<const lua::Value>) -> Result<> { return {}; });
    const Result<> result = (*sandbox)->run(text, "fuzz");
    if (!result && result.error().message.empty()) std::abort();
    if ((*sandbox)->memory_bytes_peak() > limits.memory_bytes_most) std::abort();

    const std::size_t half = size / 2;
    const lua::PatternMatch match = lua::match_pattern(text.substr(half), text.substr(0, half), 0, false, 10'000);
    if (match.matched && (match.begin > match.end || match.end > size - half)) std::abort();
    return 0;
}
