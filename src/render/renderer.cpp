#include "render/renderer_impl.h"

#include "render/passes/film/film_pass.h"
#include "render/passes/icon/icon_pass.h"
#include "render/passes/terrain/shown.h"

#include <algorithm>
#include <cstddef>
#include <epoxy/gl.h>

namespace vitrail::render {

// 0 1 2 2 3 0 for every quad that 16-bit indices reach; diagonals are turned in the vertex shader.
static gfx::Buffer make_quad_indices() {
    std::vector<u16> indices;
    indices.reserve(DrawList::kQuadsADraw * 6);
    for (u32 q = 0; q < DrawList::kQuadsADraw; ++q)
        for (u32 c : {0u, 1u, 2u, 2u, 3u, 0u})
            indices.push_back(u16(q * 4 + c));
    return gfx::make_buffer(indices.size() * sizeof(u16), 0, indices.data());
}

Result<> Renderer::Impl::build(const Effects& wanted) {
    const BuildContext build{shaders, wanted, context, compute};
    for (const auto& pass : passes.all)
        VX_TRY(pass->build(build));
    VX_TRY_ASSIGN(icon, shaders.program("icon/icon.vert.glsl", "icon/icon.frag.glsl"));
    return {};
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
    made->impl_ = std::make_unique<Impl>(options, std::move(context));
    Impl& impl = *made->impl_;
    if (impl.context.software) impl.context.anisotropy_max = 1; // eight times the texture work on the CPU
    impl.compute =
        options.screen == ScreenWork::compute || (options.screen == ScreenWork::automatic && !impl.context.software);
    impl.effects = sane(options.effects);
    impl.passes = make_passes();
    VX_TRY(impl.build(impl.effects));
    impl.quad_indices = make_quad_indices();
    impl.terrain_array = gfx::make_vertex_array();
    impl.plain_array = gfx::make_vertex_array();
    const u32 array = impl.terrain_array.name();
    glVertexArrayElementBuffer(array, impl.quad_indices.name());
    glEnableVertexArrayAttrib(array, 0);
    glVertexArrayAttribIFormat(array, 0, 4, GL_INT, 0);
    glVertexArrayAttribBinding(array, 0, 0);
    glVertexArrayBindingDivisor(array, 0, 1);
    glVertexArrayAttribIFormat(array, 1, 1, GL_UNSIGNED_INT, offsetof(ShownSection, base)); // where bind_terrain enables it
    glVertexArrayAttribBinding(array, 1, 1);
    glVertexArrayBindingDivisor(array, 1, 1);
    impl.reserve_models(1024);
    std::vector<u32> white(256, 0xffffffffu);
    impl.fixed_tints = gfx::make_buffer(white.size() * 4, GL_DYNAMIC_STORAGE_BIT, white.data());
    VX_TRY(made->load_textures(BlockRegistry()));
    return made;
}

Result<> Renderer::load_textures(const BlockRegistry& registry, const scene::PackLooks* packs) {
    TextureLimits limits;
    if (impl_->context.software) limits.bytes_most /= 3; // it is the machine's own memory
    impl_->textures_for = 1;
    return impl_->textures.load(registry, packs, limits, impl_->effects.surface.smooth, impl_->context.anisotropy_max);
}
u32 Renderer::missing_textures() const {
    return u32(impl_->textures.missing().size());
}
const std::vector<std::string>& Renderer::missing_texture_names() const {
    return impl_->textures.missing();
}

void Renderer::forget_models() {
    impl_->models_held = 0;
    impl_->fixed_tints_held = 0;
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

Result<gfx::Texture> Renderer::render_block_icon(const StateTable& states, const scene::BlockModels& models,
                                                 StateId state, u32 size) {
    if (size == 0 || size > 2048 || !states.contains(state)) return fail(ErrorCode::invalid_argument, "no such icon");
    return draw_icon(*impl_->icon, impl_->textures, states, models, state, size);
}

Result<> Renderer::set_effects(const Effects& effects) {
    const Effects wanted = sane(effects);
    if (wanted == impl_->effects) return {};
    if (Result<> built = impl_->build(wanted); !built) {
        (void)impl_->build(impl_->effects); // those were built before
        return built;
    }
    if (wanted.surface.smooth != impl_->effects.surface.smooth)
        impl_->textures.set_smooth(wanted.surface.smooth, impl_->context.anisotropy_max);
    impl_->effects = wanted;
    impl_->declared = false;
    return {};
}
const Effects& Renderer::effects() const {
    return impl_->effects;
}
void Renderer::forget_frames() {
    impl_->before = {};
    for (const auto& pass : impl_->passes.all)
        pass->forget();
}
const std::string& Renderer::shader_error() const {
    return impl_->shader_error;
}
void Renderer::show_film(u32 texture) {
    const bool traced = texture != 0;
    impl_->passes.film->set_film(texture);
    if (traced != impl_->traced) impl_->declared = false;
    impl_->traced = traced;
}
void Renderer::set_timing(bool on) {
    impl_->graph.set_timing(on);
}
void Renderer::set_background(bool on, Vec3 color) {
    impl_->background_on = on, impl_->background = color;
}
const FrameStats& Renderer::stats() const {
    return impl_->stats;
}

} // namespace vitrail::render
