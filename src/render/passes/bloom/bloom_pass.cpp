#include "render/passes/bloom/bloom_pass.h"

#include "render/passes/screen_pass.h"

#include <epoxy/gl.h>
#include <fmt/format.h>

namespace vitrail::render {

// Share of a level's light that is taken from the wider one below.
constexpr float kWider = 0.62f;

Result<> BloomPass::build(const BuildContext& context) {
    if (!context.effects.bloom.on) return {};
    VX_TRY_ASSIGN(first_, context.shaders.program("common/screen.vert.glsl", "bloom/down.frag.glsl", {"FIRST"}));
    VX_TRY_ASSIGN(down_, context.shaders.program("common/screen.vert.glsl", "bloom/down.frag.glsl"));
    VX_TRY_ASSIGN(up_, context.shaders.program("common/screen.vert.glsl", "bloom/up.frag.glsl"));
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
                          [this, from, level](const gfx::PassContext& p) {
                              draw_screen(level == 1 ? *first_ : *down_, frame_->plain_array, ScreenArea::all,
                                          {p.graph.target(from).name()});
                          },
                          ""});
    }
    for (u32 level = levels - 1; level >= 1; --level) {
        const std::string from = name(level + 1);
        c.graph.add_pass({fmt::format("bloom up {}", level),
                          {from},
                          {name(level)},
                          [this, from](const gfx::PassContext& p) {
                              draw_screen(*up_, frame_->plain_array, ScreenArea::all, {p.graph.target(from).name()},
                                          ScreenBlend::by_share, kWider);
                          },
                          ""});
    }
}

} // namespace vitrail::render
