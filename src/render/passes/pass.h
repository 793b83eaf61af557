// What a pass of the raster renderer is. One folder a pass, its shaders beside it; pass_list.cpp holds the order. A
// frame:
//
//     begin(frame)     every pass, before the frame's uniforms are made: may move the view (jitter)
//     prepare(frame)   every pass, before drawing: culls and uploads what it draws, fills its part of the uniforms
//     graph.execute()  what the passes declared, in order
//
// A pass whose effect is off declares nothing. Effects or window changed: build and declare anew; a shader file
// changed: build anew.
#pragma once

#include "gfx/context.h"
#include "gfx/frame_graph.h"
#include "render/effects.h"
#include "render/frame_context.h"
#include "render/shader_library.h"

namespace vitrail::render {

struct BuildContext {
    ShaderLibrary& shaders;
    const Effects& effects;
    const gfx::ContextInfo& context;
    bool compute = false; // passes over the screen run as compute shaders, not as fragments (ScreenProgram)
};

struct DeclareContext {
    gfx::FrameGraph& graph;
    const Effects& effects;
    bool stencil = false; // several views: depth carries the view's number as stencil
    bool scaled = false;  // drawn at less than the screen's size
    // The target that holds the picture in linear HDR after the passes declared so far; a pass that makes a new one
    // (antialiasing in time) names it here.
    std::string color = "color";
    // The picture as the screen shows it, after the passes declared so far: "screen", or, from tone mapping to fxaa, a
    // target.
    std::string display = "screen";
};

class RenderPass {
public:
    virtual ~RenderPass() = default;
    // Programs and textures of its own. On an error what was built before stays in use. Errors: those of the shaders.
    virtual Result<> build(const BuildContext& context) = 0;
    // Adds targets and passes to the graph. Their run functions use `frame_`.
    virtual void declare(DeclareContext& context) = 0;
    virtual void begin(FrameContext& frame) { frame_ = &frame; }
    virtual void prepare(FrameContext&) {}
    // Forgets what it keeps from frame to frame (the camera jumped, another world).
    virtual void forget() {}
    virtual u64 gpu_bytes() const { return 0; } // beyond the graph's targets

protected:
    FrameContext* frame_ = nullptr; // of the frame being drawn
};

} // namespace vitrail::render
