// Renderer::render: one frame, from the frame view to the framebuffer.
#include "render/renderer_impl.h"

#include "base/clock.h"
#include "base/log.h"
#include "scene/resolution.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <epoxy/gl.h>
#include <fmt/format.h>

namespace vitrail::render {

constexpr u32 kTranslucentQuadsSortedAFrame = 30000;

Result<> Renderer::Impl::declare(bool stencil, bool scaled) {
    const bool timing = !graph.times_ms().empty();
    graph.clear();
    graph.add_external("screen");
    DeclareContext declaring{graph, effects, stencil, scaled};
    for (RenderPass* pass : active())
        pass->declare(declaring);
    VX_TRY(graph.compile());
    if (timing) graph.set_timing(true);
    declared = true, declared_stencil = stencil, declared_scaled = scaled;
    return {};
}

u32 Renderer::Impl::own_framebuffer(u32 width, u32 height) {
    if (picture.width != width || picture.height != height) {
        picture = gfx::make_texture_2d(GL_RGBA8, width, height);
        const gfx::Texture* colors[] = {&picture};
        picture_framebuffer = gfx::make_framebuffer(colors, nullptr);
    }
    picture_drawn = true;
    return picture_framebuffer.name();
}

TerrainInputs Renderer::Impl::terrain_inputs() const {
    TerrainInputs in;
    in.vertex_array = terrain_array.name();
    in.quads = sections.quad_buffer(), in.tints = sections.tints().buffer();
    in.fixed_tints = fixed_tints.name(), in.models = models.name();
    in.albedo = textures.albedo().name(), in.material = textures.material().name();
    const gfx::Texture& atlas = sections.light().texture();
    in.light = atlas.name();
    in.light_atlas = {1.0f / float(atlas.width), 1.0f / float(atlas.height), 1.0f / float(atlas.depth),
                      float(LightAtlas::kRow)};
    return in;
}

void Renderer::Impl::prepare_view(u32 index, const scene::View& view) {
    ViewDraws& d = frame.views[index];
    const scene::FrameView& of = *frame.frame;
    // Through a portal lines of sight begin at its frame, not at the eye, which may well stand in rock.
    const Vec4 clip = view.clip_plane;
    const bool through_portal = clip.x != 0 || clip.y != 0 || clip.z != 0;
    const CullCounts counts =
        cullers[index].find_visible(sections, view, float(of.width) / float(of.height), of.view_distance,
                                    effects.culling.caves && !through_portal, d.visible);
    stats.sections_in_frustum += counts.in_frustum, stats.sections_in_sight += counts.in_sight;
    // Nearest sections first, as many as the budget allows; the rest keep their old order for a frame.
    u32 sorted = 0;
    for (const VisibleSection& v : d.visible) {
        if (v.section->translucent.size() < 2) continue;
        auto cell = [](i32 o) { return i8(std::clamp(-o, -1, 16)); };
        sorted += sections.sort_translucent(*v.section, {cell(v.offset.x), cell(v.offset.y), cell(v.offset.z)});
        if (sorted > kTranslucentQuadsSortedAFrame) break;
    }
    build_draw_list(d.visible, effects.surface.smooth, d.list);
    d.inputs = upload_draws(frame, d.list, index);
    d.inputs.mirrored = view.mirrored;
    for (const auto& commands : d.list.commands)
        stats.draws += u32(commands.size());
    stats.sections_visible += u32(d.list.records.size());
    stats.quads += d.list.quads;
}

// What the next frame may take from this one.
void Renderer::Impl::keep_views(const scene::FrameView& of) {
    before.views = of.views;
    before.width = of.width, before.height = of.height;
    before_seconds = of.seconds;
}

// The eye stayed near: what the last frame saw can be used.
static bool same_place(const scene::FrameView& now, const PreviousViews& before) {
    if (before.views.size() != now.views.size() || before.width != now.width || before.height != now.height)
        return false;
    for (std::size_t i = 0; i < now.views.size(); ++i) {
        const scene::View &a = now.views[i], &b = before.views[i];
        if (a.eye.dimension != b.eye.dimension || a.scale != b.scale || a.mirrored != b.mirrored) return false;
        const Vec3 step = view_from(b.eye.at, a.eye.at).v;
        if (dot(step, step) > 16 * 16) return false;
    }
    return true;
}

Result<> Renderer::render(const scene::FrameView& wanted, u32 framebuffer) {
    Impl& impl = *impl_;
    if (wanted.views.empty()) return fail(ErrorCode::invalid_argument, "a frame without a view");
    if (wanted.width == 0 || wanted.height == 0 || wanted.width > 16384 || wanted.height > 16384)
        return fail(ErrorCode::invalid_argument,
                    fmt::format("a picture of {}x{} cannot be drawn", wanted.width, wanted.height));
    const u64 start = now_ns();
    if (impl.shaders.changed()) {
        const Result<> built = impl.build(impl.effects);
        impl.shader_error = built ? "" : built.error().message;
        if (!built) log_warning(impl.shader_error);
    }
    // What is drawn may be smaller than what is shown; passes know of the former, but for the last.
    const float share = std::clamp(std::min(wanted.resolution, impl.effects.resolution.scale), 0.1f, 1.0f);
    const auto [width, height] = scene::drawn_size(wanted.width, wanted.height, share);
    const bool scaled = width != wanted.width || height != wanted.height;
    scene::FrameView smaller;
    if (scaled) smaller = wanted, smaller.width = width, smaller.height = height;
    const scene::FrameView& view = scaled ? smaller : wanted;
    if (share != impl.textures_for) {
        // Half of the levels that fewer pixels cost: all of them would flicker.
        impl.textures.set_level_bias(0.5f * std::log2(share));
        impl.textures_for = share;
    }
    const bool stencil = view.views.size() > 1 && !impl.traced;
    if (!impl.declared || stencil != impl.declared_stencil || scaled != impl.declared_scaled)
        VX_TRY(impl.declare(stencil, scaled));
    VX_TRY(impl.graph.resize(width, height, wanted.width, wanted.height));

    FrameContext& frame = impl.frame;
    FrameStats& stats = impl.stats;
    stats.draws = stats.sections_visible = stats.sections_in_frustum = stats.sections_in_sight = 0;
    stats.quads = 0;
    stats.shadow_draws = 0, stats.shadow_quads = 0;
    frame.frame = &view;
    frame.effects = &impl.effects;
    frame.context = &impl.context;
    frame.jitter = {};
    frame.continues = same_place(wanted, impl.before);
    frame.seconds_since = frame.continues ? std::clamp(view.seconds - impl.before_seconds, 0.0f, 1.0f) : 0.0f;
    frame.exact = impl.background_on;
    frame.stencil = stencil;
    frame.sections = &impl.sections;
    frame.textures = &impl.textures;
    frame.ring = &impl.ring;
    frame.plain_array = impl.plain_array.name();
    frame.target_framebuffer =
        framebuffer == kOwnPicture ? impl.own_framebuffer(wanted.width, wanted.height) : framebuffer;
    frame.target_texture = framebuffer == kOwnPicture ? &impl.picture : nullptr;
    frame.stats = &stats;
    for (RenderPass* pass : impl.active())
        pass->begin(frame);

    impl.ring.begin_frame();
    frame.uniforms = make_frame_uniforms(view, frame.jitter, frame.continues ? impl.before : PreviousViews{},
                                         impl.background_on, impl.background);
    impl.textures.animate(view.seconds);
    frame.terrain = impl.terrain_inputs();
    // A film needs no sections: its rays found what is seen.
    frame.views.resize(impl.traced ? 0 : std::min<std::size_t>(view.views.size(), kViewsMost));
    for (u32 i = 0; i < frame.views.size(); ++i)
        impl.prepare_view(i, view.views[i]);
    const u64 culled = now_ns();

    glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
    glDisable(GL_SCISSOR_TEST);
    glDisable(GL_FRAMEBUFFER_SRGB);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glBlendEquation(GL_FUNC_ADD);
    glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
    for (u32 unit = 0; unit < 16; ++unit)
        glBindSampler(unit, 0); // a user interface may have left one
    for (RenderPass* pass : impl.active())
        pass->prepare(frame);
    const auto slice = impl.ring.allocate(sizeof frame.uniforms, 256);
    std::memcpy(slice.data, &frame.uniforms, sizeof frame.uniforms);
    glBindBufferRange(GL_UNIFORM_BUFFER, 0, slice.buffer, GLintptr(slice.offset), sizeof frame.uniforms);
    impl.graph.execute();
    impl.ring.end_frame();
    impl.sections.forget_changes();
    impl.keep_views(wanted);
    ++frame.number;

    stats.width = width, stats.height = height;
    stats.sections = u32(impl.sections.all().size());
    stats.triangles = stats.quads * 2;
    stats.quads_held = impl.sections.quads_held();
    stats.gpu_bytes = impl.sections.gpu_bytes() + impl.textures.gpu_bytes() + impl.ring.bytes() +
                      impl.graph.target_bytes() + impl.models.bytes + impl.quad_indices.bytes + impl.picture.bytes();
    for (const auto& pass : impl.passes.all)
        stats.gpu_bytes += pass->gpu_bytes();
    stats.cpu_bytes = impl.sections.cpu_bytes();
    stats.passes_ms = impl.graph.times_ms();
    stats.cull_ms = double(culled - start) * 1e-6;
    stats.total_ms = double(now_ns() - start) * 1e-6;
    stats.submit_ms = stats.total_ms - stats.cull_ms;
    frame.frame = nullptr;
    return {};
}

} // namespace vitrail::render
