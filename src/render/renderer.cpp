#include "render/renderer.h"

#include "base/clock.h"
#include "gfx/context.h"
#include "gfx/frame_graph.h"
#include "gfx/upload_ring.h"
#include "render/culling.h"
#include "render/draw_list.h"
#include "render/frame_uniforms.h"
#include "render/noise_texture.h"
#include "render/passes/icon/icon_pass.h"
#include "render/passes/outline/outline_pass.h"
#include "render/passes/screen_pass.h"
#include "render/passes/terrain/terrain_pass.h"
#include "render/section_store.h"
#include "render/shader_library.h"
#include "render/texture_set.h"

#include <algorithm>
#include <cstring>
#include <epoxy/gl.h>
#include <fmt/format.h>

namespace vitrail::render {

namespace {

constexpr u32 kTranslucentQuadsSortedAFrame = 30000;

// Everything of one quality that has to be built.
struct Programs {
    TerrainPrograms terrain;
    gfx::Program lighting, sky_day, sky_night, tonemap;
};

Result<Programs> make_programs(Quality quality) {
    const bool high = quality == Quality::high;
    const std::vector<std::string> plain = high ? std::vector<std::string>{"HIGH"} : std::vector<std::string>{};
    std::vector<std::string> night = plain;
    night.push_back("NIGHT");
    Programs p;
    VX_TRY_ASSIGN(p.terrain, make_terrain_programs(high));
    const char* screen = "common/screen.vert.glsl";
    VX_TRY_ASSIGN(p.lighting, load_program("lighting", screen, "lighting/lighting.frag.glsl", plain));
    VX_TRY_ASSIGN(p.sky_day, load_program("sky", screen, "sky/sky.frag.glsl", plain));
    VX_TRY_ASSIGN(p.sky_night, load_program("night sky", screen, "sky/sky.frag.glsl", night));
    VX_TRY_ASSIGN(p.tonemap, load_program("tonemap", screen, "tonemap/tonemap.frag.glsl", plain));
    return p;
}

// 0 1 2 2 3 0 for every quad that 16-bit indices reach; diagonals are turned in the vertex shader.
gfx::Buffer make_quad_indices() {
    std::vector<u16> indices;
    indices.reserve(DrawList::kQuadsADraw * 6);
    for (u32 q = 0; q < DrawList::kQuadsADraw; ++q)
        for (u32 c : {0u, 1u, 2u, 2u, 3u, 0u})
            indices.push_back(u16(q * 4 + c));
    return gfx::make_buffer(indices.size() * sizeof(u16), 0, indices.data());
}

} // namespace

struct Renderer::Impl {
    explicit Impl(const RendererOptions& options)
        : sections(options.quad_bytes_start)
        , ring(1u << 20) {}

    gfx::ContextInfo context;
    Quality quality = Quality::high;
    Programs programs;
    gfx::Program outline, icon;
    SectionStore sections;
    TextureSet textures;
    gfx::UploadRing ring;
    gfx::Buffer quad_indices, models, fixed_tints;
    u32 models_held = 0, models_capacity = 0;
    std::size_t fixed_tints_held = 0;
    gfx::VertexArray terrain_array, plain_array;
    gfx::Texture noise;
    gfx::FrameGraph graph;
    bool graph_made = false, graph_stencil = false;
    gfx::Texture picture;
    gfx::Framebuffer picture_framebuffer;
    bool picture_drawn = false;
    std::array<Culler, kViewsMost> cullers;
    bool caves = true, timing = false, background_on = false;
    Vec3 background;
    FrameStats stats;

    // Of the frame being drawn.
    struct ViewDraws {
        DrawList list;
        TerrainInputs inputs;
    };
    std::vector<ViewDraws> draws;
    std::vector<VisibleSection> visible;
    const scene::FrameView* frame = nullptr;
    u32 target_framebuffer = 0;

    void make_graph(bool stencil);
    void timed(const char* name, const std::function<void()>& body);
    void prepare_view(u32 index, const scene::View& view);
    void pass_terrain();
    void pass_lighting(const gfx::FrameGraph& g);
    void pass_translucent(const gfx::FrameGraph& g);
    void pass_outlines();
    void pass_tonemap(const gfx::FrameGraph& g);
    void reserve_models(u32 count);
};

void Renderer::Impl::timed(const char* name, const std::function<void()>& body) {
    if (!timing) return body();
    glFinish();
    const u64 start = now_ns();
    body();
    glFinish();
    stats.passes_ms.emplace_back(name, seconds_since(start) * 1e3);
}

void Renderer::Impl::make_graph(bool stencil) {
    graph.clear();
    graph_made = true, graph_stencil = stencil;
    graph.add_target({"albedo", GL_RGBA8});
    graph.add_target({"light", GL_RGBA8});
    graph.add_target({"surface", GL_RGBA8UI});
    // Stencil masks the views of portals; without any, 4 bytes a pixel are saved.
    graph.add_target({"depth", u32(stencil ? GL_DEPTH32F_STENCIL8 : GL_DEPTH_COMPONENT32F)});
    graph.add_target({"color", GL_RGBA16F});
    graph.add_external("screen");
    using C = const gfx::PassContext&;
    graph.add_pass({"terrain",
                    {},
                    {"albedo", "light", "surface", "depth"},
                    [this](C) { timed("terrain", [&] { pass_terrain(); }); },
                    ""});
    graph.add_pass({"lighting",
                    {"albedo", "light", "surface"},
                    {"color"},
                    [this](C c) { timed("lighting", [&] { pass_lighting(c.graph); }); },
                    "depth"});
    graph.add_pass({"translucent",
                    {},
                    {"color"},
                    [this](C c) { timed("translucent", [&] { pass_translucent(c.graph); }); },
                    "depth"});
    graph.add_pass({"outline", {}, {"color"}, [this](C) { timed("outline", [&] { pass_outlines(); }); }, "depth"});
    graph.add_pass(
        {"tonemap", {"color"}, {"screen"}, [this](C c) { timed("tonemap", [&] { pass_tonemap(c.graph); }); }, ""});
}

void Renderer::Impl::prepare_view(u32 index, const scene::View& view) {
    ViewDraws& d = draws[index];
    cullers[index].find_visible(sections, view, float(frame->width) / float(frame->height), frame->view_distance,
                                caves && index == 0, visible);
    // Nearest sections first, as many as the budget allows; the rest keep their old order for a frame.
    u32 sorted = 0;
    for (const VisibleSection& v : visible) {
        if (v.section->translucent.size() < 2) continue;
        auto cell = [](i32 o) { return i8(std::clamp(-o, -1, 16)); };
        sorted += sections.sort_translucent(*v.section, {cell(v.offset.x), cell(v.offset.y), cell(v.offset.z)});
        if (sorted > kTranslucentQuadsSortedAFrame) break;
    }
    build_draw_list(visible, quality == Quality::high, d.list);

    TerrainInputs& in = d.inputs;
    in = {};
    in.vertex_array = terrain_array.name();
    in.quads = sections.quad_buffer(), in.tints = sections.tints().buffer();
    in.fixed_tints = fixed_tints.name(), in.models = models.name();
    in.albedo = textures.albedo().name(), in.material = textures.material().name();
    const gfx::Texture& atlas = sections.light().texture();
    in.light = atlas.name();
    in.light_atlas = {1.0f / float(atlas.width), 1.0f / float(atlas.height), 1.0f / float(atlas.depth),
                      float(LightAtlas::kRow)};
    in.view = index;
    in.mirrored = view.mirrored;
    if (!d.list.records.empty()) {
        const auto records = ring.allocate(d.list.records.size() * sizeof(SectionRecord), 256);
        std::memcpy(records.data, d.list.records.data(), records.bytes);
        in.records = records.buffer, in.records_offset = records.offset;
        u64 bytes = 0;
        for (const auto& list : d.list.commands)
            bytes += list.size() * sizeof(DrawCommand);
        const auto commands = ring.allocate(bytes, 256);
        in.commands = commands.buffer;
        u64 at = 0;
        for (u32 k = 0; k < u32(DrawKind::count); ++k) {
            const auto& list = d.list.commands[k];
            in.ranges[k] = {commands.offset + at, u32(list.size())};
            if (!list.empty()) std::memcpy(commands.data + at, list.data(), list.size() * sizeof(DrawCommand));
            at += list.size() * sizeof(DrawCommand);
            stats.draws += u32(list.size());
        }
    }
    stats.sections_visible += u32(d.list.records.size());
    stats.quads += d.list.quads;
}

void Renderer::Impl::pass_terrain() {
    glDepthMask(GL_TRUE);
    glDisable(GL_BLEND);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_GREATER);
    const float far = 0;
    const u32 framebuffer = graph.framebuffer("terrain");
    if (graph_stencil)
        glClearNamedFramebufferfi(framebuffer, GL_DEPTH_STENCIL, 0, far, 0);
    else
        glClearNamedFramebufferfv(framebuffer, GL_DEPTH, 0, &far);
    // Colors need no clearing: only pixels with a depth are ever read.
    for (u32 i = 0; i < draws.size(); ++i) {
        if (graph_stencil) {
            glEnable(GL_STENCIL_TEST);
            glStencilFunc(GL_EQUAL, GLint(i), 0xff);
            glStencilOp(GL_KEEP, GL_KEEP, GL_KEEP);
        }
        const Vec4 p = frame->views[i].clip_plane;
        const bool clips = p.x != 0 || p.y != 0 || p.z != 0;
        if (clips) glEnable(GL_CLIP_DISTANCE0);
        if (!draws[i].list.records.empty()) draw_terrain_opaque(programs.terrain, draws[i].inputs);
        if (clips) glDisable(GL_CLIP_DISTANCE0);
    }
    glDisable(GL_STENCIL_TEST);
}

void Renderer::Impl::pass_lighting(const gfx::FrameGraph& g) {
    // Depth is sampled while it is attached: allowed, since nothing writes it between the barriers.
    glTextureBarrier();
    draw_screen(
        programs.lighting, plain_array.name(), ScreenArea::surfaces,
        {g.target("albedo").name(), g.target("light").name(), g.target("surface").name(), g.target("depth").name()});
    const bool night = frame->sky.stars > 0 || frame->sky.moon_direction.y > -0.15f;
    draw_screen(night ? programs.sky_night : programs.sky_day, plain_array.name(), ScreenArea::background,
                {noise.name()});
}

void Renderer::Impl::pass_translucent(const gfx::FrameGraph& g) {
    glEnable(GL_BLEND);
    glBlendFunc(GL_ONE, GL_SRC1_COLOR);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_GREATER);
    glDepthMask(GL_FALSE);
    for (u32 i = 0; i < draws.size(); ++i) {
        if (graph_stencil) {
            glEnable(GL_STENCIL_TEST);
            glStencilFunc(GL_EQUAL, GLint(i), 0xff);
        }
        draws[i].inputs.depth = g.target("depth").name(); // sampled while attached, as in pass_lighting
        const Vec4 p = frame->views[i].clip_plane;
        const bool clips = p.x != 0 || p.y != 0 || p.z != 0;
        if (clips) glEnable(GL_CLIP_DISTANCE0);
        if (!draws[i].list.records.empty()) draw_terrain_translucent(programs.terrain, draws[i].inputs);
        if (clips) glDisable(GL_CLIP_DISTANCE0);
    }
    glDisable(GL_STENCIL_TEST);
    glBlendFunc(GL_ONE, GL_ZERO); // Mesa refuses several targets while two sources are set, even with blending off
}

void Renderer::Impl::pass_outlines() {
    const scene::View& view = frame->views[0];
    std::vector<Box> boxes;
    for (const scene::Outline& picked : frame->outlines) {
        if (picked.at.dimension != view.eye.dimension) continue;
        const Vec3 corner = view_from(view.eye.at, picked.at.at).v;
        for (const Box& box : picked.boxes)
            boxes.push_back({corner + box.min, corner + box.max});
    }
    if (boxes.empty()) return;
    glEnable(GL_BLEND);
    glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
    glDepthFunc(GL_GEQUAL);
    draw_outline(outline, plain_array.name(), 0, boxes);
}

void Renderer::Impl::pass_tonemap(const gfx::FrameGraph& g) {
    glBindFramebuffer(GL_FRAMEBUFFER, target_framebuffer);
    draw_screen(programs.tonemap, plain_array.name(), ScreenArea::all, {g.target("color").name()});
}

void Renderer::Impl::reserve_models(u32 count) {
    if (count <= models_capacity) return;
    const u32 capacity = std::max(count, models_capacity * 2);
    gfx::grow_buffer(models, u64(capacity) * sizeof(scene::ModelQuad), u64(models_held) * sizeof(scene::ModelQuad));
    models_capacity = capacity;
}

Renderer::Renderer() = default;
Renderer::~Renderer() = default;

Result<std::unique_ptr<Renderer>> Renderer::create(const RendererOptions& options) {
    VX_TRY_ASSIGN(gfx::ContextInfo context, gfx::context_info());
    gfx::install_debug_callback();
    std::unique_ptr<Renderer> made(new Renderer);
    made->impl_ = std::make_unique<Impl>(options);
    Impl& impl = *made->impl_;
    impl.context = std::move(context);
    if (impl.context.software) impl.context.anisotropy_max = 1; // eight times the texture work on the CPU
    impl.quality = options.quality;
    VX_TRY_ASSIGN(impl.programs, make_programs(options.quality));
    VX_TRY_ASSIGN(impl.outline, load_program("outline", "outline/outline.vert.glsl", "outline/outline.frag.glsl"));
    VX_TRY_ASSIGN(impl.icon, load_program("icon", "icon/icon.vert.glsl", "icon/icon.frag.glsl"));
    impl.quad_indices = make_quad_indices();
    impl.terrain_array = gfx::make_vertex_array();
    impl.plain_array = gfx::make_vertex_array();
    const u32 array = impl.terrain_array.name();
    glVertexArrayElementBuffer(array, impl.quad_indices.name());
    glEnableVertexArrayAttrib(array, 0);
    glVertexArrayAttribIFormat(array, 0, 4, GL_INT, 0);
    glVertexArrayAttribBinding(array, 0, 0);
    glVertexArrayBindingDivisor(array, 0, 1);
    impl.reserve_models(1024);
    std::vector<u32> white(256, 0xffffffffu);
    impl.fixed_tints = gfx::make_buffer(white.size() * 4, GL_DYNAMIC_STORAGE_BIT, white.data());
    impl.noise = make_noise_texture();
    VX_TRY(impl.textures.load(BlockRegistry(), options.quality == Quality::high, impl.context.anisotropy_max));
    return made;
}

Result<> Renderer::load_textures(const BlockRegistry& registry) {
    return impl_->textures.load(registry, impl_->quality == Quality::high, impl_->context.anisotropy_max);
}
u32 Renderer::missing_textures() const {
    return u32(impl_->textures.missing().size());
}
const std::vector<std::string>& Renderer::missing_texture_names() const {
    return impl_->textures.missing();
}

void Renderer::sync_models(const scene::BlockModels& models) {
    Impl& impl = *impl_;
    if (models.model_quad_count() > impl.models_held) {
        const std::vector<scene::ModelQuad> fresh = models.model_quads(impl.models_held);
        impl.reserve_models(impl.models_held + u32(fresh.size()));
        glNamedBufferSubData(impl.models.name(), GLintptr(u64(impl.models_held) * sizeof(scene::ModelQuad)),
                             GLsizeiptr(fresh.size() * sizeof(scene::ModelQuad)), fresh.data());
        impl.models_held += u32(fresh.size());
    }
    const auto tints = models.fixed_tints();
    if (tints.size() > impl.fixed_tints_held) {
        std::vector<u32> words;
        for (const auto& t : tints)
            words.push_back(u32(t[0]) | u32(t[1]) << 8 | u32(t[2]) << 16 | 0xff000000u);
        words.resize(std::min<std::size_t>(words.size(), 256));
        glNamedBufferSubData(impl.fixed_tints.name(), 0, GLsizeiptr(words.size() * 4), words.data());
        impl.fixed_tints_held = tints.size();
    }
}

void Renderer::set_section(ChunkPos at, DimensionId d, const SectionMesh& mesh) {
    impl_->sections.set({at, d}, mesh);
}
void Renderer::set_section_light(ChunkPos at, DimensionId d, const LightBrick& brick) {
    impl_->sections.set_light({at, d}, brick);
}
void Renderer::set_section_tints(ChunkPos at, DimensionId d, const TintGrid& tints) {
    impl_->sections.set_tints({at, d}, tints);
}
void Renderer::remove_section(ChunkPos at, DimensionId d) {
    impl_->sections.remove({at, d});
}
void Renderer::clear_sections() {
    impl_->sections.clear();
}
bool Renderer::has_section(ChunkPos at, DimensionId d) const {
    return impl_->sections.find({at, d}) != nullptr;
}

Result<> Renderer::render(const scene::FrameView& frame, u32 framebuffer) {
    Impl& impl = *impl_;
    if (frame.views.empty()) return fail(ErrorCode::invalid_argument, "a frame without a view");
    if (frame.width == 0 || frame.height == 0 || frame.width > 16384 || frame.height > 16384)
        return fail(ErrorCode::invalid_argument,
                    fmt::format("a picture of {}x{} cannot be drawn", frame.width, frame.height));
    const u64 start = now_ns();
    const bool stencil = frame.views.size() > 1;
    if (!impl.graph_made || stencil != impl.graph_stencil) {
        impl.make_graph(stencil);
        VX_TRY(impl.graph.compile());
    }
    VX_TRY(impl.graph.resize(frame.width, frame.height));
    if (framebuffer == kOwnPicture) {
        if (impl.picture.width != frame.width || impl.picture.height != frame.height) {
            impl.picture = gfx::make_texture_2d(GL_RGBA8, frame.width, frame.height);
            const gfx::Texture* colors[] = {&impl.picture};
            impl.picture_framebuffer = gfx::make_framebuffer(colors, nullptr);
        }
        framebuffer = impl.picture_framebuffer.name();
        impl.picture_drawn = true;
    }
    impl.frame = &frame;
    impl.target_framebuffer = framebuffer;
    impl.stats.passes_ms.clear();
    impl.stats.draws = impl.stats.sections_visible = 0;
    impl.stats.quads = 0;

    impl.ring.begin_frame();
    const FrameUniforms uniforms = make_frame_uniforms(frame, impl.background_on, impl.background);
    const auto slice = impl.ring.allocate(sizeof uniforms, 256);
    std::memcpy(slice.data, &uniforms, sizeof uniforms);
    impl.textures.animate(frame.seconds);
    impl.draws.resize(std::min<std::size_t>(frame.views.size(), kViewsMost));
    for (u32 i = 0; i < impl.draws.size(); ++i)
        impl.prepare_view(i, frame.views[i]);
    const u64 culled = now_ns();

    glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
    glDisable(GL_SCISSOR_TEST);
    glDisable(GL_FRAMEBUFFER_SRGB);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glBlendEquation(GL_FUNC_ADD);
    glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
    for (u32 unit = 0; unit < 4; ++unit)
        glBindSampler(unit, 0); // a user interface may have left one
    glBindBufferRange(GL_UNIFORM_BUFFER, 0, slice.buffer, GLintptr(slice.offset), sizeof uniforms);
    impl.graph.execute();
    impl.ring.end_frame();

    FrameStats& stats = impl.stats;
    stats.sections = u32(impl.sections.all().size());
    stats.triangles = stats.quads * 2;
    stats.quads_held = impl.sections.quads_held();
    stats.gpu_bytes = impl.sections.gpu_bytes() + impl.textures.gpu_bytes() + impl.ring.bytes() +
                      impl.graph.target_bytes() + impl.models.bytes + impl.quad_indices.bytes + impl.noise.bytes() +
                      impl.picture.bytes();
    stats.cpu_bytes = impl.sections.cpu_bytes();
    stats.cull_ms = double(culled - start) * 1e-6;
    stats.total_ms = double(now_ns() - start) * 1e-6;
    stats.submit_ms = stats.total_ms - stats.cull_ms;
    impl.frame = nullptr;
    return {};
}

static void flip_rows(u8* pixels, u32 rows, std::size_t row_bytes) {
    for (u32 y = 0; y < rows / 2; ++y)
        std::swap_ranges(pixels + y * row_bytes, pixels + (y + 1) * row_bytes, pixels + (rows - 1 - y) * row_bytes);
}

Result<Image> Renderer::read_pixels() {
    Impl& impl = *impl_;
    if (!impl.picture_drawn) return fail(ErrorCode::not_found, "no picture has been drawn yet");
    Image image{impl.picture.width, impl.picture.height, 3, {}};
    image.pixels.resize(std::size_t(image.width) * image.height * 3);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, impl.picture_framebuffer.name());
    glReadPixels(0, 0, GLsizei(image.width), GLsizei(image.height), GL_RGB, GL_UNSIGNED_BYTE, image.pixels.data());
    glPixelStorei(GL_PACK_ALIGNMENT, 4);
    flip_rows(image.pixels.data(), image.height, std::size_t(image.width) * 3);
    return image;
}

Result<std::vector<u8>> Renderer::read_view_numbers() {
    Impl& impl = *impl_;
    if (!impl.graph_made) return fail(ErrorCode::not_found, "no picture has been drawn yet");
    const gfx::Texture& surface = impl.graph.target("surface");
    std::vector<u8> raw(std::size_t(surface.width) * surface.height * 4), numbers(raw.size() / 4);
    glGetTextureImage(surface.name(), 0, GL_RGBA_INTEGER, GL_UNSIGNED_BYTE, GLsizei(raw.size()), raw.data());
    for (std::size_t i = 0; i < numbers.size(); ++i)
        numbers[i] = raw[i * 4 + 2];
    flip_rows(numbers.data(), surface.height, surface.width);
    return numbers;
}

Result<gfx::Texture> Renderer::render_block_icon(const StateTable& states, const scene::BlockModels& models,
                                                 StateId state, u32 size) {
    if (size == 0 || size > 2048 || !states.contains(state)) return fail(ErrorCode::invalid_argument, "no such icon");
    return draw_icon(impl_->icon, impl_->textures, states, models, state, size);
}

Result<Image> Renderer::read_texture(const gfx::Texture& texture) {
    Image image{texture.width, texture.height, 4, {}};
    image.pixels.resize(std::size_t(image.width) * image.height * 4);
    glGetTextureImage(texture.name(), 0, GL_RGBA, GL_UNSIGNED_BYTE, GLsizei(image.pixels.size()), image.pixels.data());
    flip_rows(image.pixels.data(), image.height, std::size_t(image.width) * 4);
    return image;
}

void Renderer::set_quality(Quality quality) {
    if (quality == impl_->quality) return;
    Result<Programs> programs = make_programs(quality);
    if (!programs) return; // both qualities are built by the same compiler: keep what works
    impl_->programs = std::move(*programs);
    impl_->quality = quality;
    impl_->textures.set_smooth(quality == Quality::high, impl_->context.anisotropy_max);
}
Quality Renderer::quality() const {
    return impl_->quality;
}
void Renderer::set_cave_culling(bool on) {
    impl_->caves = on;
}
void Renderer::set_timing(bool on) {
    impl_->timing = on;
}
void Renderer::set_background(bool on, Vec3 color) {
    impl_->background_on = on, impl_->background = color;
}
const FrameStats& Renderer::stats() const {
    return impl_->stats;
}

} // namespace vitrail::render
