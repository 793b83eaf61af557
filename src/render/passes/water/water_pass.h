// Translucent terrain (water, glass, ice, crystals), drawn forward over the lit picture, back to front, by one blend of
// two sources: what a surface adds, and by color what it lets through.
//
// Refraction and order: water shows what lies under it displaced by its waves, which a blend cannot move. It adds the
// difference between the solid picture ("scene") where the waves show it and where it is, so that what is drawn between
// stays; where something lies between water and ground (target "layers" knows the farthest) it moves nothing. Drawing
// each layer into a copy of its own would bend panes under water too, at the price of a copy a layer.
//
// Waves bend the geometry near the eye (kSwellReach) by tessellation, where water.swell is on.
#pragma once

#include "render/passes/pass.h"

namespace vitrail::render {

inline constexpr float kSwellReach = 32; // blocks; water.tese.glsl

class WaterPass : public RenderPass {
public:
    Result<> build(const BuildContext& context) override;
    void declare(DeclareContext& context) override;

private:
    void declare_layers(DeclareContext& context);
    void find_layers(const gfx::PassContext& context);
    void draw(const gfx::Program& whole, const gfx::Program* cut, const TerrainInputs& in, const ViewDraws& draws);
    ProgramRef program_, swell_program_, layers_program_, swell_layers_program_;
    bool atomic_ = false; // layers are found by atomics, not by blending
    ProgramRef clear_;    // where they are
};

// How many of the view's translucent commands, the last ones, may show a surface within kSwellReach of the eye.
u32 commands_with_swell(const DrawList& list);

} // namespace vitrail::render
