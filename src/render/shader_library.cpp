#include "render/shader_library.h"

#include "base/clock.h"
#include "base/types.h"

#include <algorithm>
#include <fmt/format.h>
#include <fstream>
#include <iterator>
#include <optional>
#include <set>

namespace vitrail::render {

namespace fs = std::filesystem;

static std::optional<std::string> read_one(const std::string& folder, std::string_view path) {
    if (folder.empty()) {
        for (const EmbeddedShader* s = kEmbeddedShaders; s->path; ++s)
            if (path == s->path) return s->text;
        return std::nullopt;
    }
    std::ifstream file(fs::path(folder) / path);
    if (!file) return std::nullopt;
    return std::string(std::istreambuf_iterator<char>(file), {});
}

static Result<> append(const std::string& folder, std::string_view path, std::string& out,
                       std::set<std::string, std::less<>>& seen) {
    if (!seen.emplace(path).second) return {};
    const std::optional<std::string> text = read_one(folder, path);
    if (!text) return fail(ErrorCode::not_found, fmt::format("no shader {}", path));
    std::string_view rest = *text;
    constexpr std::string_view kInclude = "#include \"";
    while (!rest.empty()) {
        const std::size_t end = rest.find('\n');
        const std::string_view line = rest.substr(0, end);
        rest = end == std::string_view::npos ? std::string_view{} : rest.substr(end + 1);
        if (line.starts_with(kInclude)) {
            const std::size_t close = line.find('"', kInclude.size());
            if (close == std::string_view::npos)
                return fail(ErrorCode::invalid_argument, fmt::format("{}: {}", path, line));
            VX_TRY(append(folder, line.substr(kInclude.size(), close - kInclude.size()), out, seen));
        } else {
            out.append(line);
            out.push_back('\n');
        }
    }
    return {};
}

ShaderLibrary::ShaderLibrary(std::string folder)
    : folder_(std::move(folder)) {
    if (!folder_.empty()) seen_ = newest();
}

Result<std::string> ShaderLibrary::text(std::string_view path) const {
    std::string out;
    std::set<std::string, std::less<>> seen;
    VX_TRY(append(folder_, path, out, seen));
    return out;
}

Result<ProgramRef> ShaderLibrary::build(const std::string& key, gfx::ProgramSource source) {
    VX_TRY_ASSIGN(gfx::Program program, gfx::build_program(source));
    auto made = std::make_shared<const gfx::Program>(std::move(program));
    programs_[key] = made;
    return made;
}

Result<ProgramRef> ShaderLibrary::program(std::string_view vertex, std::string_view fragment,
                                          std::vector<std::string> defines) {
    const std::string key = fmt::format("{}|{}|{}", vertex, fragment, fmt::join(defines, "|"));
    if (const auto kept = programs_.find(key); kept != programs_.end()) return kept->second;
    gfx::ProgramSource source;
    source.name = fragment;
    VX_TRY_ASSIGN(source.vertex, text(vertex));
    VX_TRY_ASSIGN(source.fragment, text(fragment));
    source.defines = std::move(defines);
    return build(key, std::move(source));
}

Result<ProgramRef> ShaderLibrary::tessellated_program(std::string_view vertex, std::string_view control,
                                                      std::string_view evaluation, std::string_view fragment,
                                                      std::vector<std::string> defines) {
    const std::string key =
        fmt::format("{}|{}|{}|{}|{}", vertex, control, evaluation, fragment, fmt::join(defines, "|"));
    if (const auto kept = programs_.find(key); kept != programs_.end()) return kept->second;
    gfx::ProgramSource source;
    source.name = fragment;
    VX_TRY_ASSIGN(source.vertex, text(vertex));
    VX_TRY_ASSIGN(source.control, text(control));
    VX_TRY_ASSIGN(source.evaluation, text(evaluation));
    VX_TRY_ASSIGN(source.fragment, text(fragment));
    source.defines = std::move(defines);
    return build(key, std::move(source));
}

Result<ProgramRef> ShaderLibrary::compute_program(std::string_view compute, std::vector<std::string> defines) {
    const std::string key = fmt::format("{}|{}", compute, fmt::join(defines, "|"));
    if (const auto kept = programs_.find(key); kept != programs_.end()) return kept->second;
    gfx::ProgramSource source;
    source.name = compute;
    VX_TRY_ASSIGN(source.compute, text(compute));
    source.defines = std::move(defines);
    return build(key, std::move(source));
}

fs::file_time_type ShaderLibrary::newest() const {
    auto newest = fs::file_time_type::min(); // the clock's zero lies in the future
    std::error_code error;
    for (fs::recursive_directory_iterator at(folder_, error), end; !error && at != end; at.increment(error)) {
        if (at->path().extension() != ".glsl") continue;
        std::error_code ignored;
        newest = std::max(newest, at->last_write_time(ignored));
    }
    return newest;
}

bool ShaderLibrary::changed() {
    if (folder_.empty()) return false;
    const u64 now = now_ns();
    if (now - looked_ns_ < 500'000'000) return false;
    looked_ns_ = now;
    const fs::file_time_type time = newest();
    if (time == seen_) return false;
    seen_ = time;
    programs_.clear();
    return true;
}

} // namespace vitrail::render
