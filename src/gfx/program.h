// Shader programs from source text. Sources begin without #version: the builder adds `#version 450 core` and the
// defines.
#pragma once

#include "base/result.h"
#include "gfx/handles.h"

#include <string>
#include <string_view>
#include <vector>

namespace vitrail::gfx {

struct ProgramSource {
    std::string name;                 // for messages: the pass
    std::string vertex, fragment;     // GLSL 4.50 without #version
    std::string compute;              // instead of all others
    std::vector<std::string> defines; // "NAME" or "NAME VALUE"
    std::string control{}, evaluation{}; // tessellation between vertex and fragment, both or none
};

// Errors: invalid_argument with the driver's log, the lines it names and the program's name.
Result<Program> build_program(const ProgramSource& source);

} // namespace vitrail::gfx
