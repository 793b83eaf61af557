// Renderer: draws FrameViews with OpenGL 4.5. It holds the sections' meshes, light and tints on the GPU; the passes are
// free functions, a folder each (passes/). Use it on the thread that owns the context.
//
//     VX_TRY_ASSIGN(auto renderer, Renderer::create({.quality = Quality::high}));
//     VX_TRY(renderer->load_textures(registry));
//     renderer->sync_models(models);                      // after BlockModels::ensure, cheap when nothing is new
//     renderer->set_section(at, dimension, mesh);         // as meshes arrive; then light and tints of the same section
//     renderer->set_section_light(at, dimension, brick);
//     VX_TRY(renderer->render(frame));                    // into the renderer's own picture
//     VX_TRY_ASSIGN(Image image, renderer->read_pixels());
#pragma once

#include "base/result.h"
#include "gfx/handles.h"
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
#include <utility>
#include <vector>

namespace vitrail::render {

// low: for software OpenGL. high: normal maps, filtered minification, water that sees its depth, finer sky.
enum class Quality : u8 { low, high };

struct RendererOptions {
    Quality quality = Quality::high;
    u64 quad_bytes_start = 8u << 20; // the quad buffer doubles from here
};

// Where a picture goes: 0 is the window; kOwnPicture the renderer's own target, read by read_pixels.
inline constexpr u32 kOwnPicture = ~0u;

struct FrameStats {
    u32 sections = 0;             // held
    u32 sections_visible = 0;     // after frustum and cave culling, with anything to draw
    u32 draws = 0;                // commands in multi-draws
    u64 quads = 0, triangles = 0; // drawn
    u64 quads_held = 0;
    u64 gpu_bytes = 0;                               // buffers, textures and targets, without the driver's padding
    u64 cpu_bytes = 0;                               // what the renderer keeps of sections
    double cull_ms = 0, submit_ms = 0, total_ms = 0; // CPU time of the last render(); software OpenGL draws inside
    std::vector<std::pair<std::string, double>> passes_ms; // GPU time a pass, where `set_timing(true)`
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
    // of 32x32 layers; an image taller than wide is an animation. What is missing gets the plain pattern and is
    // counted. Errors: limit (more layers than the driver has). Unreadable files count as missing.
    Result<> load_textures(const BlockRegistry& registry);
    u32 missing_textures() const;
    const std::vector<std::string>& missing_texture_names() const;

    // Uploads model quads and fixed tints added since the last call.
    void sync_models(const scene::BlockModels& models);

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
    // The number of the view that each pixel of the last frame belongs to, rows from the top (tests, picking).
    Result<std::vector<u8>> read_view_numbers();

    // A state's picture for the hotbar, RGBA with premultiplied alpha, size x size, seen from above at a corner.
    Result<gfx::Texture> render_block_icon(const StateTable& states, const scene::BlockModels& models, StateId state,
                                           u32 size);
    Result<Image> read_texture(const gfx::Texture& texture); // RGBA

    void set_quality(Quality quality);
    Quality quality() const;
    void set_cave_culling(bool on); // on from the start
    void set_timing(bool on);       // fills FrameStats::passes_ms; waits for the GPU after each pass
    // For tests: draws this (linear RGB) instead of the sky, without fog.
    void set_background(bool on, Vec3 color = {});
    const FrameStats& stats() const;

private:
    Renderer();
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

} // namespace vitrail::render
