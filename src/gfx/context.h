// What the current OpenGL context offers, and its error reports.
#pragma once

#include "base/result.h"
#include "base/types.h"

#include <string>

namespace vitrail::gfx {

struct ContextInfo {
    std::string vendor, renderer, version;
    u32 major = 0, minor = 0;
    bool software = false; // llvmpipe, softpipe, swrast: the CPU draws
    u32 texture_size_max = 0, texture_3d_size_max = 0, texture_layers_max = 0;
    float anisotropy_max = 1; // 1: not supported
};

// Errors: unsupported, where no context is current or it is older than 4.5 core.
Result<ContextInfo> context_info();

// Sends the driver's messages of high and medium severity to the log; counts errors.
void install_debug_callback();
u64 debug_error_count(); // of this process since the start
// First error since the last call as a name, empty where there was none (for tests).
std::string take_gl_error();

} // namespace vitrail::gfx
