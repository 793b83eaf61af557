#include "render/shader_library.h"

#include <fmt/format.h>
#include <set>

namespace vitrail::render {

static Result<> append(std::string_view path, std::string& out, std::set<std::string, std::less<>>& seen) {
    if (!seen.emplace(path).second) return {};
    const char* text = nullptr;
    for (const EmbeddedShader* s = kEmbeddedShaders; s->path; ++s)
        if (path == s->path) text = s->text;
    if (!text) return fail(ErrorCode::not_found, fmt::format("no shader {}", path));
    std::string_view rest = text;
    constexpr std::string_view kInclude = "#include \"";
    while (!rest.empty()) {
        const std::size_t end = rest.find('\n');
        const std::string_view line = rest.substr(0, end);
        rest = end == std::string_view::npos ? std::string_view{} : rest.substr(end + 1);
        if (line.starts_with(kInclude)) {
            const std::size_t close = line.find('"', kInclude.size());
            if (close == std::string_view::npos)
                return fail(ErrorCode::invalid_argument, fmt::format("{}: {}", path, line));
            VX_TRY(append(line.substr(kInclude.size(), close - kInclude.size()), out, seen));
        } else {
            out.append(line);
            out.push_back('\n');
        }
    }
    return {};
}

Result<std::string> shader_text(std::string_view path) {
    std::string out;
    std::set<std::string, std::less<>> seen;
    VX_TRY(append(path, out, seen));
    return out;
}

Result<gfx::Program> load_program(const std::string& name, std::string_view vertex, std::string_view fragment,
                                  std::vector<std::string> defines) {
    gfx::ProgramSource source;
    source.name = name;
    VX_TRY_ASSIGN(source.vertex, shader_text(vertex));
    VX_TRY_ASSIGN(source.fragment, shader_text(fragment));
    source.defines = std::move(defines);
    return gfx::build_program(source);
}

} // namespace vitrail::render
