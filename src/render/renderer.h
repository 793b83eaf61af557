// Renderer: draws FrameViews with OpenGL 4.5. It holds the sections' meshes, light and tints on the GPU; what is done
// with them is a list of passes (pass_list.cpp), a folder each (passes/). Use it on the thread that owns the context.
//
//     VX_TRY_ASSIGN(auto renderer, Renderer::create({.effects = preset_effects(Preset::high)}));
//     VX_TRY(renderer->load_textures(registry));
//     renderer->sync_models(models);                      // after BlockModels::ensure, cheap when nothing is new
//     renderer->set_section(at, dimension, mesh);         // as meshes arrive; then light and tints of the same section
//     renderer->set_section_light(at, dimension, brick);
//     VX_TRY(renderer->render(frame));                    // into the renderer's own picture
//     VX_TRY_ASSIGN(Image image, renderer->read_pixels());
#pragma once

#include "base/result.h"
#include "gfx/handles.h"
#include "render/effects.h"
#include "render/frame_stats.h"
#include "render/image.h"
#include "render/meshing/light_brick.h"
#include "render/meshing/quad.h"
#include "scene/block_model.h"
#include "scene/frame_view.h"
#include "world/block_registry.h"
#include "world/state_table.h"

#include <memory>
#include <span>
#include <string>
#include <vector>

namespace vitrail::scene {
class PackLooks;
}

namespace vitrail::render {

// How passes over the whole screen run; both ways draw the same picture. automatic: compute but on software OpenGL.
enum class ScreenWork { automatic, fragments, compute };

struct RendererOptions {
    Effects effects = preset_effects(Preset::high);
    u64 quad_bytes_start = 8u << 20; // the quad buffer doubles from here
    ScreenWork screen = ScreenWork::automatic;
    std::string shader_folder = {}; // shaders are read from here and again when they change; empty: those built in
};

// Where a picture goes: 0 is the window; kOwnPicture the renderer's own target, read by read_pixels.
inline constexpr u32 kOwnPicture = ~0u;

// A target's texels as floats (unsigned integers as they are), for tests: rows from the top, `channels` values a texel;
// the last layer of an array first.
struct TargetPixels {
    u32 width = 0, height = 0, channels = 0;
    std::vector<float> values;
    const float* at(u32 x, u32 y) const { return &values[(std::size_t(y) * width + x) * channels]; }
};

// Draws the sections of every dimension it was given; view 0 of a frame decides what is seen.
class Renderer {
public:
    // Needs a current context. Errors: unsupported (no OpenGL 4.5), invalid_argument (a shader does not build; its
    // log).
    static Result<std::unique_ptr<Renderer>> create(const RendererOptions& options = {});
    ~Renderer();
    Renderer(const Renderer&) = delete;
    Renderer& operator=(const Renderer&) = delete;

    // Reads NAME.png (albedo), NAME_n, NAME_r, NAME_e of every texture below the registry's content roots into arrays
    // of 32x32 layers; an image taller than wide is an animation. Pictures of packs (of this registry; null: none) take
    // their place or follow them, and layers grow to their size. What is missing gets the plain pattern and is counted.
    // Errors: limit (more layers than the driver has). Unreadable files count as missing.
    Result<> load_textures(const BlockRegistry& registry, const scene::PackLooks* packs = nullptr);
    u32 missing_textures() const;
    const std::vector<std::string>& missing_texture_names() const;

    // Uploads model quads and fixed tints added since the last call.
    void sync_models(const scene::BlockModels& models);
    // Before sync_models with another table; sections of the old one must not be drawn any more.
    void forget_models();

    // Replaces what the section draws; an empty mesh still counts for cave culling (its connections).
    void set_section(ChunkPos at, DimensionId dimension, const SectionMesh& mesh);
    // Before the first call a section is drawn under full sky light. Call for sections that draw something.
    void set_section_light(ChunkPos at, DimensionId dimension, const LightBrick& brick);
    void set_section_tints(ChunkPos at, DimensionId dimension, const TintGrid& tints);
    void remove_section(ChunkPos at, DimensionId dimension);
    void clear_sections();
    bool has_section(ChunkPos at, DimensionId dimension) const;

    // Draws the frame at frame.width x frame.height. Errors: invalid_argument (no views, a size of 0 or above 16384),
    // limit (out of graphics memory).
    Result<> render(const scene::FrameView& frame, u32 framebuffer = kOwnPicture);
    // The last picture drawn with kOwnPicture, RGB. Errors: not_found before the first.
    Result<Image> read_pixels();
    // A target of the frame graph after the last frame: "depth", "color", "albedo", ... Errors: not_found.
    Result<TargetPixels> read_target(const std::string& name);
    // The number of the view that each pixel of the last frame belongs to, rows from the top (tests, picking).
    Result<std::vector<u8>> read_view_numbers();

    // A state's picture for the hotbar, RGBA with premultiplied alpha, size x size, seen from above at a corner.
    Result<gfx::Texture> render_block_icon(const StateTable& states, const scene::BlockModels& models, StateId state,
                                           u32 size);
    Result<Image> read_texture(const gfx::Texture& texture); // RGBA

    // Takes effect with the next frame; held inside their ranges. Errors: invalid_argument (a shader does not build;
    // the effects stay as they were).
    Result<> set_effects(const Effects& effects);
    const Effects& effects() const;
    // What temporal effects keep (exposure, history) is forgotten: the next frame stands for itself.
    void forget_frames();
    // Why the shaders of `shader_folder` as they are now do not build; empty where they do.
    const std::string& shader_error() const;
    // Frames show this OpenGL texture instead of drawing sections: linear light as rgb, blocks along the ray as alpha (0:
    // sky), first row on top, of any size; it must live until the last frame of it. 0: sections again.
    void show_film(u32 texture);
    void set_timing(bool on); // fills FrameStats::passes_ms; nothing waits for the answers
    // For tests: draws this (linear RGB) instead of the sky, without fog, exposure and tone curve.
    void set_background(bool on, Vec3 color = {});
    const FrameStats& stats() const;

private:
    Renderer();
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

} // namespace vitrail::render
