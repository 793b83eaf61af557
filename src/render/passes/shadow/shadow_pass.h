// Shadows of sun and moon: up to four cascades in layers of one depth array ("shadow_depth"), and what stained glass,
// ice and water let through in another ("shadow_color"). shadow.glsl asks them.
//
// A map is drawn again only where the eye left its middle (shadow_cascades.h), the light turned by a step too small to
// be seen, something within changed, or plants sway in it (the nearest alone). What can wait does, one map a frame.
//
// Softness 1 takes the sun for twice as wide as it is (0.27 degrees each side of its center): as wide as people draw
// it.
#pragma once

#include "render/passes/pass.h"
#include "render/passes/shadow/shadow_cascades.h"

#include <array>

namespace vitrail::render {

// The tangent of half the angle from which light comes, at softness 1.
inline constexpr float kSunTangent = 0.00471f * 2;

// What shaders that include shadow.glsl or shadow_map.glsl are built with; none where shadows are off.
std::vector<std::string> shadow_defines(const Effects& effects);

class ShadowPass : public RenderPass {
public:
    Result<> build(const BuildContext& context) override;
    void declare(DeclareContext& context) override;
    void prepare(FrameContext& frame) override;
    void forget() override;

private:
    struct Cascade {
        ShadowMapPlace place;
        Vec3 toward;          // the frame's direction of light when it was drawn
        bool valid = false;   // drawn, and the textures are still the same
        bool dirty = false;   // a section within changed
        bool colored = false; // holds anything translucent
        bool sways = false;   // holds plants in the wind
        u32 age = 0;          // frames since it was drawn
        gfx::Framebuffer depth, color;
        DrawList list; // kept for its memory
        TerrainInputs inputs;
        bool draw = false; // this frame
    };
    void choose(const FrameContext& frame);
    void fill(FrameContext& frame, u32 index);
    void upload(FrameContext& frame) const;
    void draw(const gfx::PassContext& context);
    void draw_cascade(const gfx::FrameGraph& graph, u32 index);

    std::array<ProgramRef, u32(DrawKind::count)> programs_, still_programs_; // with sway and without
    gfx::Sampler compared_, plain_;
    Effects::Shadows shadows_;
    bool on_ = false, sway_ = false;
    float wind_seconds_ = 0; // FrameView::seconds of the nearest map's wind
    u32 size_ = 0, count_ = 0;
    std::array<float, kCascadesMost> ends_{};
    std::array<Cascade, kCascadesMost> cascades_;
    u32 width_ = 0, height_ = 0; // the frame's, when the textures were made
    std::vector<VisibleSection> casters_;
};

} // namespace vitrail::render
