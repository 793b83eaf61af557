// The GLSL files of passes/, built into the program; #include "common/x.glsl" works (each file once a shader).
#pragma once

#include "base/result.h"
#include "gfx/program.h"

#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

namespace vitrail::render {

struct EmbeddedShader {
    const char* path;
    const char* text;
};
extern const EmbeddedShader kEmbeddedShaders[]; // ends with a null path

// Errors: not_found; invalid_argument, for an include of a file that is not there.
Result<std::string> shader_text(std::string_view path);
// vertex and fragment: paths below passes/.
Result<gfx::Program> load_program(const std::string& name, std::string_view vertex, std::string_view fragment,
                                  std::vector<std::string> defines = {});

} // namespace vitrail::render
