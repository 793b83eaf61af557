#include "gfx/program.h"

#include <cstdio>
#include <epoxy/gl.h>
#include <fmt/format.h>

namespace vitrail::gfx {

static std::string header_of(const ProgramSource& source) {
    std::string text = "#version 450 core\n";
    for (const std::string& define : source.defines)
        text += "#define " + define + "\n";
    return text + "#line 1\n";
}

// The compiler's log with the source line that its first complaint names ("0:12(3): ..." in Mesa, "0(12) : ..." in
// NVIDIA's).
static std::string explain(std::string log, const std::string& source) {
    while (!log.empty() && (log.back() == '\n' || log.back() == '\0'))
        log.pop_back();
    unsigned line = 0;
    if (std::sscanf(log.c_str(), "0:%u", &line) != 1 && std::sscanf(log.c_str(), "0(%u)", &line) != 1) return log;
    std::size_t at = 0;
    for (unsigned i = 1; i < line && at != std::string::npos; ++i) {
        at = source.find('\n', at);
        if (at != std::string::npos) ++at;
    }
    if (at == std::string::npos) return log;
    return log + " in: " + source.substr(at, source.find('\n', at) - at);
}

static Result<u32> compile(u32 stage, const ProgramSource& source, const std::string& body) {
    const u32 shader = glCreateShader(stage);
    const std::string head = header_of(source);
    const char* parts[2] = {head.c_str(), body.c_str()};
    glShaderSource(shader, 2, parts, nullptr);
    glCompileShader(shader);
    GLint ok = 0;
    glGetShaderiv(shader, GL_COMPILE_STATUS, &ok);
    if (ok) return shader;
    char log[4096] = {};
    glGetShaderInfoLog(shader, sizeof log - 1, nullptr, log);
    glDeleteShader(shader);
    const char* stage_name = stage == GL_VERTEX_SHADER            ? "vertex"
                             : stage == GL_FRAGMENT_SHADER        ? "fragment"
                             : stage == GL_TESS_CONTROL_SHADER    ? "tessellation control"
                             : stage == GL_TESS_EVALUATION_SHADER ? "tessellation evaluation"
                                                                  : "compute";
    return fail(ErrorCode::invalid_argument,
                fmt::format("{} shader of {}: {}", stage_name, source.name, explain(log, body)));
}

Result<Program> build_program(const ProgramSource& source) {
    std::vector<u32> shaders;
    auto drop = [&] {
        for (u32 shader : shaders)
            glDeleteShader(shader);
    };
    const std::pair<u32, const std::string*> stages[] = {{GL_VERTEX_SHADER, &source.vertex},
                                                         {GL_TESS_CONTROL_SHADER, &source.control},
                                                         {GL_TESS_EVALUATION_SHADER, &source.evaluation},
                                                         {GL_FRAGMENT_SHADER, &source.fragment},
                                                         {GL_COMPUTE_SHADER, &source.compute}};
    for (const auto& [stage, body] : stages) {
        if (body->empty()) continue;
        Result<u32> shader = compile(stage, source, *body);
        if (!shader) {
            drop();
            return tl::unexpected(std::move(shader).error());
        }
        shaders.push_back(*shader);
    }
    if (shaders.empty()) return fail(ErrorCode::invalid_argument, "program " + source.name + " has no shader");
    Program program(glCreateProgram());
    for (u32 shader : shaders)
        glAttachShader(program.name(), shader);
    glLinkProgram(program.name());
    for (u32 shader : shaders)
        glDetachShader(program.name(), shader);
    drop();
    GLint ok = 0;
    glGetProgramiv(program.name(), GL_LINK_STATUS, &ok);
    if (ok) return program;
    char log[4096] = {};
    glGetProgramInfoLog(program.name(), sizeof log - 1, nullptr, log);
    return fail(ErrorCode::invalid_argument, fmt::format("linking {}: {}", source.name, log));
}

} // namespace vitrail::gfx
