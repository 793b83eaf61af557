// Opaque and cutout terrain into the G-buffer: "albedo", "light", "surface", "depth". Where passes over the screen run
// as compute, what is drawn is "shown", the number of each pixel's quad, and a compute shader makes the rest of it
// (surfaces.comp.glsl): fragments are dear there. (Lighting surfaces where they are
// drawn was slower on software OpenGL too: what is overdrawn was lit in vain.) Cracks at T-junctions: a cube quad grows
// outwards in its plane by kSeal (terrain.vert.glsl) of a pixel.
#pragma once

#include "render/passes/occlusion/occlusion.h"
#include "render/passes/pass.h"
#include "render/passes/terrain/shown.h"

#include <array>

namespace vitrail::render {

class TerrainPass : public RenderPass {
public:
    Result<> build(const BuildContext& context) override;
    void declare(DeclareContext& context) override;
    void prepare(FrameContext& frame) override;
    u64 gpu_bytes() const override { return occlusion_.gpu_bytes(); }

private:
    void draw(const gfx::FrameGraph& graph);
    void draw_solids(TerrainInputs in) const;
    void look_up(const gfx::PassContext& context) const;
    Occlusion occlusion_;
    std::array<ProgramRef, u32(DrawKind::count)> programs_; // translucent: none
    bool compute_ = false;
    ProgramRef surfaces_;
    ShownSections shown_; // of the frame being drawn
};

// The defines that terrain.vert.glsl knows, as the effects want them.
std::vector<std::string> terrain_defines(const Effects& effects);

// Draws of one view are clipped by its plane and, with several views, masked by stencil. Runs body for every view that
// has anything to draw.
void for_each_view(const FrameContext& frame, const std::function<void(u32 view, const ViewDraws& draws)>& body);

} // namespace vitrail::render
