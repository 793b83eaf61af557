// What Renderer holds; shared by renderer.cpp, render_frame.cpp and readback.cpp.
#pragma once

#include "gfx/context.h"
#include "gfx/frame_graph.h"
#include "gfx/upload_ring.h"
#include "render/culling.h"
#include "render/frame_context.h"
#include "render/pass_list.h"
#include "render/renderer.h"
#include "render/shader_library.h"

namespace vitrail::render {

struct Renderer::Impl {
    Impl(const RendererOptions& options, gfx::ContextInfo info)
        : context(std::move(info))
        , shaders(options.shader_folder)
        , sections(options.quad_bytes_start, context.software)
        , ring(1u << 20) {}

    gfx::ContextInfo context;
    bool compute = false; // see ScreenWork
    ShaderLibrary shaders;
    std::string shader_error;
    Effects effects;
    PassList passes;
    bool traced = false; // the frame shows a film
    gfx::FrameGraph graph;
    bool declared = false, declared_stencil = false,
         declared_scaled = false; // the graph is as effects and views want it

    SectionStore sections;
    TextureSet textures;
    float textures_for = 1; // share of the picture that their levels are set for; load() forgets
    gfx::UploadRing ring;
    gfx::Buffer quad_indices, models, fixed_tints;
    u32 models_held = 0, models_capacity = 0;
    std::size_t fixed_tints_held = 0;
    gfx::VertexArray terrain_array, plain_array;
    ProgramRef icon;

    gfx::Texture picture;
    gfx::Framebuffer picture_framebuffer;
    bool picture_drawn = false;

    std::array<Culler, kViewsMost> cullers;
    bool background_on = false;
    Vec3 background;
    FrameContext frame; // of the frame being drawn
    PreviousViews before;
    float before_seconds = 0;
    FrameStats stats;

    Result<> build(const Effects& wanted);
    const std::vector<RenderPass*>& active() const { return traced ? passes.traced : passes.raster; }
    Result<> declare(bool stencil, bool scaled);
    u32 own_framebuffer(u32 width, u32 height);
    TerrainInputs terrain_inputs() const;
    void prepare_view(u32 index, const scene::View& view);
    void keep_views(const scene::FrameView& frame_view);
    void reserve_models(u32 count);
};

} // namespace vitrail::render
