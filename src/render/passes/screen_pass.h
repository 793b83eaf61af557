// Passes that shade the whole screen: lighting, sky, antialiasing, tone map.
#pragma once

#include "gfx/frame_graph.h"
#include "gfx/handles.h"
#include "render/shader_library.h"

#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

namespace vitrail::render {

struct BuildContext;

// Which pixels of the attached depth are shaded.
enum class ScreenArea { all, surfaces, background };
// add: to what is there; by_share: mixed in, the same share everywhere.
enum class ScreenBlend { none, add, by_share };

// One triangle over what is attached. textures: of units 0, 1, ...; 0 leaves a unit empty. share: for by_share, 0..1.
void draw_screen(const gfx::Program& program, u32 vertex_array, ScreenArea area, std::initializer_list<u32> textures,
                 ScreenBlend blend = ScreenBlend::none, float share = 1);

struct ScreenShader {
    std::string_view path; // below passes/, includes common/screen.glsl
    std::vector<std::string> defines = {};
    std::vector<u32> formats; // of the one or two targets that it writes
    ScreenArea area =
        ScreenArea::all; // where not all: "depth" is read at unit 3 (by threads) and must be attached (for fragments)
    ScreenBlend blend = ScreenBlend::none;
    bool derivatives = false; // takes differences between neighbors: always fragments
};

// A shader that includes common/screen.glsl, built to run as fragments of one triangle (software OpenGL, whose depth
// test and tiles are quicker) or as a compute shader (GPUs: those for data centers shade fragments up to 30 times
// slower). Both give the same picture.
class ScreenProgram {
public:
    ScreenProgram() = default;
    // Errors: those of the shaders.
    static Result<ScreenProgram> build(const BuildContext& context, ScreenShader shader);
    // In a pass of the graph that writes `writes` and nothing else. reads: targets of units 0, 1, ...; empty ones leave
    // a unit empty. share: for by_share.
    void run(const gfx::PassContext& pass, u32 vertex_array, std::initializer_list<std::string> writes,
             std::initializer_list<std::string> reads, float share = 1) const;
    // The same into a texture of the pass's size that is no target of the graph. Only where passes run as compute.
    void run_into(const gfx::PassContext& pass, const gfx::Texture& texture,
                  std::initializer_list<std::string> reads) const;
    u32 name() const { return program_->name(); } // for uniforms

private:
    void bind(const gfx::PassContext& pass, std::initializer_list<std::string> reads) const;
    void dispatch(const gfx::PassContext& pass, float share) const;
    ProgramRef program_;
    bool compute_ = false;
    ScreenArea area_ = ScreenArea::all;
    ScreenBlend blend_ = ScreenBlend::none;
};

} // namespace vitrail::render
