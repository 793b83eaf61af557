#include "render/passes/bloom/bloom_pass.h"

#include <epoxy/gl.h>
#include <fmt/format.h>

namespace vitrail::render {

// Share of a level's light that is taken from the wider one below.
constexpr float kWider = 0.62f;

Result<> BloomPass::build(const BuildContext& context) {
    if (!context.effects.bloom.on) return {};
    ScreenShader down{.path = "bloom/down.screen.glsl", .formats = {GL_RGBA16F}};
    VX_TRY_ASSIGN(down_, ScreenProgram::build(context, down));
    down.defines = {"FIRST"};
    VX_TRY_ASSIGN(first_, ScreenProgram::build(context, down));
    VX_TRY_ASSIGN(
        up_, ScreenProgram::build(
                 context, {.path = "bloom/up.screen.glsl", .formats = {GL_RGBA16F}, .blend = ScreenBlend::by_share}));
    return {};
}

void BloomPass::declare(DeclareContext& c) {
    if (!c.effects.bloom.on) return;
    const u32 levels = u32(c.effects.bloom.levels);
    const auto name = [](u32 level) { return fmt::format("bloom{}", level); };
    for (u32 level = 1; level <= levels; ++level) {
        c.graph.add_target({.name = name(level), .format = GL_RGBA16F, .divisor = 1u << level, .linear = true});
        const std::string from = level == 1 ? c.color : name(level - 1);
        c.graph.add_pass({fmt::format("bloom down {}", level),
                          {from},
                          {name(level)},
                          [this, from, to = name(level), level](const gfx::PassContext& p) {
                              (level == 1 ? first_ : down_).run(p, frame_->plain_array, {to}, {from});
                          },
                          ""});
    }
    for (u32 level = levels - 1; level >= 1; --level) {
        const std::string from = name(level + 1);
        c.graph.add_pass({fmt::format("bloom up {}", level),
                          {from},
                          {name(level)},
                          [this, from, to = name(level)](const gfx::PassContext& p) {
                              up_.run(p, frame_->plain_array, {to}, {from}, kWider);
                          },
                          ""});
    }
}

} // namespace vitrail::render
