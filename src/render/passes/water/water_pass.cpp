#include "render/passes/water/water_pass.h"

#include "render/passes/shadow/shadow_pass.h"
#include "render/passes/terrain/terrain_pass.h"

#include <algorithm>
#include <epoxy/gl.h>
#include <fmt/format.h>

namespace vitrail::render {

constexpr u32 kLayersUnit = 14, kWayOutUnit = 15;

Result<> WaterPass::build(const BuildContext& context) {
    const Effects& effects = context.effects;
    std::vector<std::string> defines = terrain_defines(effects);
    defines.insert(defines.end(), {"MODEL 2", "LIQUID", fmt::format("WAVE_HEIGHT {:.5f}", effects.water.wave_height)});
    ShaderLibrary& shaders = context.shaders;
    constexpr const char *kVertex = "terrain/terrain.vert.glsl", *kControl = "water/water.tesc.glsl",
                         *kEvaluation = "water/water.tese.glsl", *kLayers = "water/layers.frag.glsl";
    const bool swell = effects.water.waves && effects.water.swell && effects.water.wave_height > 0;
    atomic_ = context.compute && effects.water.refraction;
    if (atomic_) {
        defines.push_back("ATOMIC");
        VX_TRY_ASSIGN(clear_, shaders.compute_program("water/layers_clear.comp.glsl"));
    }
    swell_program_.reset(), layers_program_.reset(), swell_layers_program_.reset();
    if (effects.water.refraction) {
        VX_TRY_ASSIGN(layers_program_, shaders.program(kVertex, kLayers, defines));
        if (swell) {
            VX_TRY_ASSIGN(swell_layers_program_,
                          shaders.tessellated_program(kVertex, kControl, kEvaluation, kLayers, defines));
        }
    }
    const auto shadows = shadow_defines(effects);
    defines.insert(defines.end(), shadows.begin(), shadows.end());
    if (effects.water.waves) defines.push_back("WAVES");
    if (effects.water.caustics) defines.push_back("CAUSTICS");
    if (!effects.water.refraction) defines.push_back("WAVES_SIMPLE");
    if (effects.water.refraction) defines.push_back("SCENE");
    if (effects.reflections.on) {
        defines.push_back("MIRRORS");
        defines.push_back(fmt::format("MARCH_STEPS {}", effects.reflections.steps));
    }
    constexpr const char* kFragment = "water/water.frag.glsl";
    VX_TRY_ASSIGN(program_, shaders.program(kVertex, kFragment, defines));
    if (swell) {
        VX_TRY_ASSIGN(swell_program_, shaders.tessellated_program(kVertex, kControl, kEvaluation, kFragment, defines));
    }
    return {};
}

u32 commands_with_swell(const DrawList& list) {
    const auto& commands = list.commands[u32(DrawKind::translucent)];
    u32 count = 0;
    for (u32 i = 0; i < commands.size(); ++i) { // far sections first: from the first near one on
        const SectionRecord& r = list.records[commands[i].base_instance];
        const auto gap = [](i32 o) { return float(std::max({o - 1, -16 - o, 0})); }; // the eye is inside its block
        if (gap(r.x) * gap(r.x) + gap(r.z) * gap(r.z) < kSwellReach * kSwellReach) {
            count = u32(commands.size()) - i;
            break;
        }
    }
    return count;
}

void WaterPass::draw(const gfx::Program& whole, const gfx::Program* cut, const TerrainInputs& in,
                     const ViewDraws& draws) {
    const u32 near = cut ? commands_with_swell(draws.list) : 0;
    TerrainInputs part = in;
    TerrainInputs::Range& range = part.ranges[u32(DrawKind::translucent)];
    range.count -= near;
    draw_kind(whole, part, DrawKind::translucent, false);
    if (near == 0) return;
    range.offset += u64(range.count) * sizeof(DrawCommand), range.count = near;
    glPatchParameteri(GL_PATCH_VERTICES, 6);
    draw_kind(*cut, part, DrawKind::translucent, false, GL_PATCHES);
}

void WaterPass::find_layers(const gfx::PassContext& p) {
    if (atomic_) {
        u32 unit = 0;
        for (const char* name : {"farthest", "way out"})
            glBindImageTexture(unit++, p.graph.target(name).name(), 0, GL_FALSE, 0, GL_READ_WRITE, GL_R32UI);
        glUseProgram(clear_->name());
        glDispatchCompute((p.width + 7) / 8, (p.height + 7) / 8, 1);
        glMemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
        glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
        glDisable(GL_BLEND);
    } else {
        const float none[4] = {1, 0, 0, 0};
        glClearNamedFramebufferfv(p.graph.framebuffer("layers"), GL_COLOR, 0, none);
        glEnable(GL_BLEND);
        glBlendEquation(GL_MIN);
    }
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_GREATER);
    glDepthMask(GL_FALSE);
    for_each_view(*frame_, [&](u32, const ViewDraws& draws) {
        bind_terrain(draws.inputs);
        draw(*layers_program_, swell_layers_program_.get(), draws.inputs, draws);
    });
    glBlendEquation(GL_FUNC_ADD);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    if (atomic_) glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
}

void WaterPass::declare_layers(DeclareContext& c) {
    std::vector<std::string> writes{"layers"};
    if (atomic_) writes = {"farthest", "way out"};
    for (const std::string& name : writes)
        c.graph.add_target({.name = name, .format = u32(atomic_ ? GL_R32UI : GL_RG32F)});
    c.graph.add_pass({"layers", {}, writes, [this](const gfx::PassContext& p) { find_layers(p); }, "depth"});
}

void WaterPass::declare(DeclareContext& c) {
    const bool refraction = c.effects.water.refraction;
    std::vector<std::string> reads;
    if (refraction) {
        declare_layers(c);
        reads = {atomic_ ? "farthest" : "layers", "scene"};
    }
    c.graph.add_pass({"translucent",
                      reads,
                      {c.color},
                      [this, refraction](const gfx::PassContext& p) {
                          glTextureBarrier(); // depth is sampled while it is attached
                          glEnable(GL_BLEND);
                          glBlendFunc(GL_ONE, GL_SRC1_COLOR);
                          glEnable(GL_DEPTH_TEST);
                          glDepthFunc(GL_GREATER);
                          glDepthMask(GL_FALSE);
                          for_each_view(*frame_, [&](u32, const ViewDraws& draws) {
                              bind_terrain(draws.inputs);
                              glBindTextureUnit(u32(Unit::depth), p.graph.target("depth").name());
                              if (refraction) {
                                  glBindTextureUnit(u32(Unit::color), p.graph.target("scene").name());
                                  glBindTextureUnit(kLayersUnit,
                                                    p.graph.target(atomic_ ? "farthest" : "layers").name());
                                  if (atomic_) glBindTextureUnit(kWayOutUnit, p.graph.target("way out").name());
                              }
                              draw(*program_, swell_program_.get(), draws.inputs, draws);
                          });
                          // Mesa refuses several targets while two sources are set, even with blending off.
                          glBlendFunc(GL_ONE, GL_ZERO);
                      },
                      "depth"});
}

} // namespace vitrail::render
