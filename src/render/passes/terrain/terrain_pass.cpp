#include "render/passes/terrain/terrain_pass.h"

#include <epoxy/gl.h>

namespace vitrail::render {

std::vector<std::string> terrain_defines(const Effects& effects) {
    std::vector<std::string> defines;
    if (effects.surface.smooth) defines.push_back("SMOOTH");
    if (effects.surface.normal_maps) defines.push_back("NORMAL_MAPS");
    if (effects.surface.sway) defines.push_back("SWAY");
    return defines;
}

Result<> TerrainPass::build(const BuildContext& context) {
    struct Kind {
        DrawKind kind;
        std::vector<std::string> defines;
    };
    const Kind kinds[] = {
        {DrawKind::opaque_cubes, {"MODEL 0"}},
        {DrawKind::opaque_models, {"MODEL 1"}},
        {DrawKind::cutout_cubes, {"MODEL 0", "CUTOUT"}},
        {DrawKind::cutout_models, {"MODEL 1", "CUTOUT"}},
    };
    for (const Kind& kind : kinds) {
        std::vector<std::string> defines = terrain_defines(context.effects);
        defines.insert(defines.end(), kind.defines.begin(), kind.defines.end());
        const char* fragment = "terrain/terrain.frag.glsl";
        if (context.compute) defines.push_back("SHOWN"), fragment = "terrain/shown.frag.glsl";
        VX_TRY_ASSIGN(programs_[u32(kind.kind)],
                      context.shaders.program("terrain/terrain.vert.glsl", fragment, defines));
    }
    compute_ = context.compute;
    if (compute_) {
        std::vector<std::string> defines = terrain_defines(context.effects);
        defines.push_back("MODEL 2");
        VX_TRY_ASSIGN(surfaces_, context.shaders.compute_program("terrain/surfaces.comp.glsl", std::move(defines)));
    }
    return occlusion_.build(context);
}

void TerrainPass::declare(DeclareContext& c) {
    // Stencil masks the views of portals; without any, 4 bytes a pixel are saved.
    c.graph.add_target({.name = "depth", .format = u32(c.stencil ? GL_DEPTH32F_STENCIL8 : GL_DEPTH_COMPONENT32F)});
    c.graph.add_target({.name = "albedo", .format = GL_RGBA8});
    c.graph.add_target({.name = "light", .format = GL_RGBA8});
    c.graph.add_target({.name = "surface", .format = GL_RGBA8UI});
    const std::vector<std::string> looks{"albedo", "light", "surface"};
    std::vector<std::string> writes = looks;
    if (compute_) {
        c.graph.add_target({.name = "shown", .format = GL_R32UI});
        writes = {"shown"};
    }
    writes.push_back("depth");
    c.graph.add_pass({"terrain", {}, writes, [this](const gfx::PassContext& p) { draw(p.graph); }, ""});
    if (c.effects.culling.occlusion) {
        const auto if_split = [this](auto body) {
            return [this, body](const gfx::PassContext&) {
                if (!frame_->views.empty() && frame_->views[0].occlusion) body();
            };
        };
        c.graph.add_pass(
            {"occlusion", {}, writes, if_split([this] { occlusion_.test(*frame_, frame_->views[0]); }), ""});
        c.graph.add_pass({"terrain late",
                          {},
                          writes,
                          if_split([this] {
                              for_each_view(*frame_, [&](u32 view, const ViewDraws& draws) {
                                  if (view == 0) draw_solids(draws.late);
                              });
                          }),
                          ""});
    }
    if (!compute_) return;
    c.graph.add_pass({"surfaces", {"shown", "depth"}, looks, [this](const gfx::PassContext& p) { look_up(p); }, ""});
}

void TerrainPass::prepare(FrameContext& frame) {
    for (ViewDraws& view : frame.views)
        view.occlusion = false;
    if (compute_) shown_ = number_shown(frame);
    if (frame.effects->culling.occlusion && !frame.views.empty()) occlusion_.prepare(frame, frame.views[0]);
}

void TerrainPass::draw_solids(TerrainInputs in) const {
    if (compute_) in.light_atlas = {}; // light is looked up later
    bind_terrain(in);
    draw_kind(*programs_[u32(DrawKind::opaque_cubes)], in, DrawKind::opaque_cubes, true);
    // Models decide by quad which look away (kTwoSided); cutout cubes show their far side through their holes.
    for (DrawKind kind : {DrawKind::opaque_models, DrawKind::cutout_cubes, DrawKind::cutout_models})
        draw_kind(*programs_[u32(kind)], in, kind, false);
}

void for_each_view(const FrameContext& frame, const std::function<void(u32, const ViewDraws&)>& body) {
    for (u32 i = 0; i < frame.views.size(); ++i) {
        if (frame.views[i].list.records.empty()) continue;
        if (frame.stencil) {
            glEnable(GL_STENCIL_TEST);
            glStencilFunc(GL_EQUAL, GLint(i), 0xff);
            glStencilOp(GL_KEEP, GL_KEEP, GL_KEEP);
        }
        const Vec4 p = frame.frame->views[i].clip_plane;
        const bool clips = p.x != 0 || p.y != 0 || p.z != 0;
        if (clips) glEnable(GL_CLIP_DISTANCE0);
        body(i, frame.views[i]);
        if (clips) glDisable(GL_CLIP_DISTANCE0);
    }
    glDisable(GL_STENCIL_TEST);
}

void TerrainPass::draw(const gfx::FrameGraph& graph) {
    glDepthMask(GL_TRUE);
    glDisable(GL_BLEND);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_GREATER);
    const float far = 0;
    const u32 framebuffer = graph.framebuffer("terrain");
    if (frame_->stencil)
        glClearNamedFramebufferfi(framebuffer, GL_DEPTH_STENCIL, 0, far, 0);
    else
        glClearNamedFramebufferfv(framebuffer, GL_DEPTH, 0, &far);
    // Colors need no clearing: only pixels with a depth are ever read.
    for_each_view(*frame_,
                  [&](u32, const ViewDraws& draws) { draw_solids(draws.occlusion ? draws.first : draws.inputs); });
}

void TerrainPass::look_up(const gfx::PassContext& p) const {
    if (shown_.buffer == 0) return;
    const TerrainInputs& in = frame_->terrain;
    const u32 storage[4] = {in.quads, in.tints, in.fixed_tints, in.models};
    for (u32 i = 0; i < 4; ++i)
        glBindBufferBase(GL_SHADER_STORAGE_BUFFER, i, storage[i]);
    glBindBufferRange(GL_SHADER_STORAGE_BUFFER, 4, shown_.buffer, GLintptr(shown_.offset), GLsizeiptr(shown_.bytes));
    const u32 textures[5] = {in.albedo, in.light, in.material, p.graph.target("depth").name(),
                             p.graph.target("shown").name()};
    glBindTextures(0, 5, textures);
    u32 unit = 0;
    for (const char* name : {"albedo", "light", "surface"}) {
        const gfx::Texture& into = p.graph.target(name);
        glBindImageTexture(unit++, into.name(), 0, GL_FALSE, 0, GL_WRITE_ONLY, into.format);
    }
    glProgramUniform1ui(surfaces_->name(), 0, shown_.shift);
    glProgramUniform4f(surfaces_->name(), 1, in.light_atlas.x, in.light_atlas.y, in.light_atlas.z, in.light_atlas.w);
    glUseProgram(surfaces_->name());
    glDispatchCompute((p.width + 7) / 8, (p.height + 7) / 8, 1);
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT | GL_FRAMEBUFFER_BARRIER_BIT |
                    GL_TEXTURE_UPDATE_BARRIER_BIT);
}

} // namespace vitrail::render
