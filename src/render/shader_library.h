// The GLSL files of passes/, built into the program, or read from a folder and watched, so that an edit shows while the
// program runs. #include "common/x.glsl" works (each file once a shader). Programs are kept by files and defines: asking
// again for the same costs nothing.
#pragma once

#include "base/result.h"
#include "gfx/program.h"

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace vitrail::render {

struct EmbeddedShader {
    const char* path;
    const char* text;
};
extern const EmbeddedShader kEmbeddedShaders[]; // ends with a null path

using ProgramRef = std::shared_ptr<const gfx::Program>;

class ShaderLibrary {
public:
    // folder: where the files below passes/ lie; empty: the texts built in.
    explicit ShaderLibrary(std::string folder = {});

    // With its includes. Errors: not_found; invalid_argument, for an include of a file that is not there.
    Result<std::string> text(std::string_view path) const;
    // vertex, fragment, compute: paths below passes/; defines: "NAME" or "NAME VALUE". Errors: also those of build_program.
    Result<ProgramRef> program(std::string_view vertex, std::string_view fragment,
                               std::vector<std::string> defines = {});
    // With tessellation between them: patches in, triangles out.
    Result<ProgramRef> tessellated_program(std::string_view vertex, std::string_view control,
                                           std::string_view evaluation, std::string_view fragment,
                                           std::vector<std::string> defines = {});
    Result<ProgramRef> compute_program(std::string_view compute, std::vector<std::string> defines = {});

    // Whether a file of the folder changed since the last call; then the programs kept are forgotten. Looks at the disk
    // at most twice a second; always false for the texts built in.
    bool changed();
    const std::string& folder() const { return folder_; }

private:
    Result<ProgramRef> build(const std::string& key, gfx::ProgramSource source);
    std::filesystem::file_time_type newest() const;
    std::string folder_;
    std::map<std::string, ProgramRef> programs_;
    std::filesystem::file_time_type seen_{};
    unsigned long long looked_ns_ = 0;
};

} // namespace vitrail::render
