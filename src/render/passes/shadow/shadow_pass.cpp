#include "render/passes/shadow/shadow_pass.h"

#include "render/passes/terrain/terrain_pass.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <epoxy/gl.h>
#include <fmt/format.h>

namespace vitrail::render {

namespace {

// Degrees that the light may turn before a map is drawn anew. A step moves the shadow of a tree's top by less than a
// tenth of its outline's width.
constexpr float kWindEvery = 1.0f / 30; // seconds between the shadows of swaying plants
constexpr float kStep[kCascadesMost] = {0.10f, 0.14f, 0.20f, 0.30f};
constexpr float kJump = 1.0f; // beyond, no map may be left behind
// Frames that a map rests after it was drawn, where only sections changed: while land streams in, it always has.
constexpr u32 kRest[kCascadesMost] = {0, 1, 4, 8};
constexpr float kFade = 0.12f;       // of the distance: over the last of it shadows go over into the sky's light levels
constexpr float kTextureTexels = 32; // a block (texture_set.cpp)

// Uniform locations of terrain.vert.glsl and shadow.frag.glsl.
constexpr i32 kMap = 2, kLevel = 6, kToward = 7;

// The uniform block `Shadows` of shadow_map.glsl, std140.
struct ShadowUniforms {
    struct {
        Vec4 u, v, z, size;
    } cascades[kCascadesMost];
    Vec4 info;
};
static_assert(sizeof(ShadowUniforms) == 17 * 16);

// The light turned by more than this many degrees.
bool turned(Vec3 from, Vec3 to, float degrees) {
    const Vec3 c = cross(from, to); // exact for small angles, where a cosine is not
    return dot(from, to) < 0 || dot(c, c) > std::pow(std::sin(degrees * 0.017453293f), 2.0f);
}

// Faces that can look to the light, as build_draw_list takes them.
u32 facing_light(Vec3 toward) {
    u32 mask = 1u << 6;
    const float at[3] = {toward.x, toward.y, toward.z};
    for (u32 axis = 0; axis < 3; ++axis) {
        if (at[axis] < 0) mask |= 1u << (axis * 2);
        if (at[axis] > 0) mask |= 2u << (axis * 2);
    }
    return mask;
}

} // namespace

std::vector<std::string> shadow_defines(const Effects& effects) {
    const Effects::Shadows& s = effects.shadows;
    if (!s.on) return {};
    std::vector<std::string> defines{
        "SHADOWS", fmt::format("SHADOW_CASCADES {}", s.cascades), fmt::format("SHADOW_SIZE {}.0", s.size),
        fmt::format("SHADOW_SAMPLES {}", s.samples), fmt::format("SHADOW_SEARCH {}", std::clamp(s.samples / 2, 4, 16))};
    if (s.colored) defines.push_back(fmt::format("SHADOW_COLOR {}", std::clamp(s.samples / 2, 1, 8)));
    return defines;
}

Result<> ShadowPass::build(const BuildContext& context) {
    const Effects& effects = context.effects;
    if (!effects.shadows.on) return {};
    struct Kind {
        DrawKind kind;
        std::vector<std::string> defines;
    };
    const Kind kinds[] = {
        {DrawKind::opaque_cubes, {"MODEL 0"}},           {DrawKind::opaque_models, {"MODEL 1"}},
        {DrawKind::cutout_cubes, {"MODEL 0", "CUTOUT"}}, {DrawKind::cutout_models, {"MODEL 1", "CUTOUT"}},
        {DrawKind::translucent, {"MODEL 2", "COLORED"}},
    };
    for (const Kind& kind : kinds)
        for (bool sway : {false, true}) {
            std::vector<std::string> defines = kind.defines;
            defines.push_back("SHADOW");
            if (sway && effects.surface.sway) defines.push_back("SWAY");
            VX_TRY_ASSIGN((sway ? programs_ : still_programs_)[u32(kind.kind)],
                          context.shaders.program("terrain/terrain.vert.glsl", "shadow/shadow.frag.glsl", defines));
        }
    if (!compared_) {
        compared_ = gfx::make_sampler(GL_LINEAR, GL_LINEAR, GL_CLAMP_TO_EDGE);
        glSamplerParameteri(compared_.name(), GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
        glSamplerParameteri(compared_.name(), GL_TEXTURE_COMPARE_FUNC, GL_LEQUAL);
        plain_ = gfx::make_sampler(GL_NEAREST, GL_NEAREST, GL_CLAMP_TO_EDGE);
    }
    forget(); // a shader may have changed
    return {};
}

void ShadowPass::declare(DeclareContext& c) {
    shadows_ = c.effects.shadows;
    on_ = shadows_.on, sway_ = c.effects.surface.sway;
    width_ = height_ = 0; // textures are made anew
    if (!on_) return;
    size_ = u32(shadows_.size), count_ = u32(shadows_.cascades);
    ends_ = cascade_ends(count_, shadows_.distance);
    std::vector<std::string> writes{"shadow_depth"};
    c.graph.add_target(
        {.name = "shadow_depth", .format = GL_DEPTH_COMPONENT32F, .width = size_, .height = size_, .layers = count_});
    if (shadows_.colored) {
        c.graph.add_target(
            {.name = "shadow_color", .format = GL_RGBA16, .width = size_, .height = size_, .layers = count_});
        writes.push_back("shadow_color");
    }
    c.graph.add_pass({"shadow", {}, writes, [this](const gfx::PassContext& p) { draw(p); }, ""});
}

void ShadowPass::forget() {
    for (Cascade& c : cascades_)
        c.valid = false;
}

// Which maps are drawn in this frame.
void ShadowPass::choose(const FrameContext& frame) {
    const scene::FrameView& of = *frame.frame;
    if (of.width != width_ || of.height != height_) {
        width_ = of.width, height_ = of.height;
        forget(); // the graph made its textures anew
        for (Cascade& c : cascades_)
            c.depth.reset(), c.color.reset();
    }
    const auto& eye = of.views[0].eye;
    const Vec4 l = frame.uniforms.light_direction;
    const Vec3 toward{l.x, l.y, l.z};
    const Vec4 light = frame.uniforms.sun_light;
    const bool dark = std::max({light.x, light.y, light.z}) < 1e-5f;
    const auto& changes = frame.sections->changes();
    u32 waiting = kCascadesMost, longest = 0;
    for (u32 i = 0; i < count_; ++i) {
        Cascade& c = cascades_[i];
        c.draw = false;
        ++c.age;
        if (dark) continue;
        for (std::size_t k = 0; k < changes.size() && c.valid && !c.dirty; ++k)
            c.dirty = changes[k].dimension == c.place.dimension && (k > 4096 || may_cast(c.place, changes[k].at));
        if (!c.valid || !covers(c.place, eye, ends_[i]) || turned(c.toward, toward, kJump) || (c.dirty && i == 0)) {
            c.draw = true;
        } else if ((turned(c.toward, toward, kStep[i]) || (c.dirty && c.age > kRest[i])) && c.age > longest) {
            waiting = i, longest = c.age;
        }
    }
    if (dark) // whatever changes now is not looked at
        for (u32 i = 0; i < count_ && !changes.empty(); ++i)
            cascades_[i].valid = false;
    if (waiting < count_) cascades_[waiting].draw = true;
}

void ShadowPass::fill(FrameContext& frame, u32 index) {
    Cascade& c = cascades_[index];
    const auto& eye = frame.frame->views[0].eye;
    const Vec4 l = frame.uniforms.light_direction;
    c.toward = {l.x, l.y, l.z};
    c.place = place_shadow_map(c.valid ? c.place : ShadowMapPlace{}, eye, c.toward, ends_[index], size_);
    casters_.clear();
    const auto& places = frame.sections->places();
    for (std::size_t k = 0; k < places.size(); ++k) {
        const SectionPlace& p = places[k];
        if (p.quad_count == 0 || p.dimension != eye.dimension || !may_cast(c.place, p.at)) continue;
        Section* s = frame.sections->all()[k];
        const BlockPos o = origin_of(p.at);
        if (s->sky_lit)
            casters_.push_back({s, {o.x - c.place.anchor.x, o.y - c.place.anchor.y, o.z - c.place.anchor.z}, 0});
    }
    build_draw_list(casters_, false, c.list, facing_light(c.toward));
    c.colored = shadows_.colored && !c.list.commands[u32(DrawKind::translucent)].empty();
    c.sways = index == 0 && sway_ && !c.list.commands[u32(DrawKind::cutout_models)].empty();
    c.valid = true, c.dirty = false;
}

void ShadowPass::prepare(FrameContext& frame) {
    if (!on_) return;
    choose(frame);
    for (u32 i = 0; i < count_; ++i) {
        Cascade& c = cascades_[i];
        if (c.draw)
            fill(frame, i);
        else if (c.valid && c.sways && std::abs(frame.frame->seconds - wind_seconds_) >= kWindEvery)
            c.draw = true; // the same list under another wind
        if (!c.draw) continue;
        if (c.sways) wind_seconds_ = frame.frame->seconds;
        c.age = 0;
        c.inputs = upload_draws(frame, c.list, 0);
        for (const auto& commands : c.list.commands)
            frame.stats->shadow_draws += u32(commands.size());
        frame.stats->shadow_quads += c.list.quads;
    }
    upload(frame);
}

void ShadowPass::upload(FrameContext& frame) const {
    ShadowUniforms u{};
    for (u32 i = 0; i < count_; ++i) {
        const Cascade& c = cascades_[i];
        if (!c.valid) continue;
        const ShadowRows rows = rows_from_eye(c.place, frame.frame->views[0].eye.at);
        u.cascades[i] = {rows.u,
                         rows.v,
                         rows.z,
                         {float(c.place.texel), float(c.place.depth_range()), ends_[i], c.colored ? 1.0f : 0.0f}};
    }
    const float end = ends_[count_ - 1];
    const bool steady = frame.effects->antialias != i32(Antialias::taa);
    u.info = {end, 1 / (kFade * end), steady ? 0.0f : 5.588238f * float(frame.number % 64),
              kSunTangent * shadows_.softness};
    const auto slice = frame.ring->allocate(sizeof u, 256);
    std::memcpy(slice.data, &u, sizeof u);
    glBindBufferRange(GL_UNIFORM_BUFFER, 1, slice.buffer, GLintptr(slice.offset), sizeof u);
}

void ShadowPass::draw_cascade(const gfx::FrameGraph& graph, u32 index) {
    Cascade& c = cascades_[index];
    const u32 depth = graph.target("shadow_depth").name();
    if (!c.depth) {
        c.depth = gfx::make_framebuffer({}, nullptr);
        glNamedFramebufferTextureLayer(c.depth.name(), GL_DEPTH_ATTACHMENT, depth, 0, GLint(index));
        if (shadows_.colored) {
            c.color = gfx::make_framebuffer({}, nullptr);
            glNamedFramebufferTextureLayer(c.color.name(), GL_DEPTH_ATTACHMENT, depth, 0, GLint(index));
            glNamedFramebufferTextureLayer(c.color.name(), GL_COLOR_ATTACHMENT0, graph.target("shadow_color").name(), 0,
                                           GLint(index));
            glNamedFramebufferDrawBuffer(c.color.name(), GL_COLOR_ATTACHMENT0);
        }
    }
    const auto map = rows_from_anchor(c.place, size_);
    const float level = std::max(std::floor(std::log2(kTextureTexels * float(c.place.texel)) + 0.5f), 0.0f);
    const auto& programs = c.sways ? programs_ : still_programs_;
    auto draw_one = [&](DrawKind kind) {
        const TerrainInputs::Range range = c.inputs.ranges[u32(kind)];
        if (range.count == 0) return;
        const u32 program = programs[u32(kind)]->name();
        glUseProgram(program);
        glProgramUniform4fv(program, kMap, 4, &map[0].x);
        if (kind != DrawKind::opaque_cubes && kind != DrawKind::opaque_models)
            glProgramUniform1f(program, kLevel, level);
        // Cracks at T-junctions are a 256th of a texel.
        glProgramUniform4f(program, kToward, c.toward.x, c.toward.y, c.toward.z, 0.1f * float(c.place.texel));
        glMultiDrawElementsIndirect(GL_TRIANGLES, GL_UNSIGNED_SHORT, reinterpret_cast<const void*>(range.offset),
                                    GLsizei(range.count), 0);
    };
    glBindFramebuffer(GL_FRAMEBUFFER, c.depth.name());
    glDepthMask(GL_TRUE);
    const float far = 1;
    glClearBufferfv(GL_DEPTH, 0, &far);
    if (!c.list.records.empty()) {
        bind_terrain(c.inputs);
        for (DrawKind kind :
             {DrawKind::opaque_cubes, DrawKind::opaque_models, DrawKind::cutout_cubes, DrawKind::cutout_models})
            draw_one(kind);
    }
    if (!c.colored) return; // and nobody reads its color
    glBindFramebuffer(GL_FRAMEBUFFER, c.color.name());
    const float clear[4] = {1, 1, 1, 1};
    glClearBufferfv(GL_COLOR, 0, clear);
    glDepthMask(GL_FALSE);
    glEnable(GL_BLEND);
    glBlendFunc(GL_ZERO, GL_SRC_COLOR);
    glBlendEquationSeparate(GL_FUNC_ADD, GL_MIN);
    draw_one(DrawKind::translucent);
    glDisable(GL_BLEND);
    glBlendEquation(GL_FUNC_ADD);
    glBlendFunc(GL_ONE, GL_ZERO);
}

void ShadowPass::draw(const gfx::PassContext& p) {
    glDisable(GL_BLEND);
    glDisable(GL_CULL_FACE); // build_draw_list has left out what looks away
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_LESS);
    glEnable(GL_DEPTH_CLAMP); // what stands before the map's depth casts too
    for (u32 i = 0; i < count_; ++i)
        if (cascades_[i].draw) draw_cascade(p.graph, i);
    glDisable(GL_DEPTH_CLAMP);
    const u32 depth = p.graph.target("shadow_depth").name();
    glBindTextureUnit(u32(Unit::shadow), depth);
    glBindSampler(u32(Unit::shadow), compared_.name());
    glBindTextureUnit(u32(Unit::shadow_depth), depth);
    glBindSampler(u32(Unit::shadow_depth), plain_.name());
    if (!shadows_.colored) return;
    glBindTextureUnit(u32(Unit::shadow_color), p.graph.target("shadow_color").name());
    glBindSampler(u32(Unit::shadow_color), plain_.name());
}

} // namespace vitrail::render
