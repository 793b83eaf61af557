#include "render/passes/icon/icon_pass.h"

#include "render/meshing/light_brick.h"
#include "render/meshing/quad.h"

#include <epoxy/gl.h>

namespace vitrail::render {

namespace {

struct IconVertex {
    float x, y, z, layer, s, t, shade, solid, r, g, b, a; // solid: alpha is the share of tint
};

Vec3 tint_color(u64 look, const scene::BlockModels& models) {
    const BiomeTint plain;
    auto from = [](std::array<u8, 3> c) { return Vec3{float(c[0]) / 255, float(c[1]) / 255, float(c[2]) / 255}; };
    switch (TintKind(look >> 48 & 7)) {
    case TintKind::grass:
        return from(plain.grass);
    case TintKind::foliage:
        return from(plain.foliage);
    case TintKind::water:
        return from(plain.water);
    case TintKind::fixed: {
        const auto tints = models.fixed_tints();
        const u32 index = u32(look >> 51 & 255);
        return index < tints.size() ? from(tints[index]) : Vec3{1, 1, 1};
    }
    default:
        return {1, 1, 1};
    }
}

void push_quad(std::vector<IconVertex>& out, const Vec3 (&p)[4], const Vec2 (&uv)[4], u64 look, float shade,
               Vec3 tint, bool solid = false) {
    const float layer = float(look >> 32 & 0xffff);
    for (u32 i : {0u, 1u, 2u, 2u, 3u, 0u})
        out.push_back({p[i].x, p[i].y, p[i].z, layer, uv[i].x, uv[i].y, shade, solid ? 1.0f : 0.0f, tint.x, tint.y, tint.z, 1});
}

void push_cube_face(std::vector<IconVertex>& out, Face face, u64 look, Vec3 tint, bool solid) {
    const Vec2 uv[4] = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
    switch (face) {
    case Face::up:
        return push_quad(out, {{0, 1, 1}, {1, 1, 1}, {1, 1, 0}, {0, 1, 0}}, uv, look, 1.0f, tint, solid);
    case Face::south:
        return push_quad(out, {{0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}}, uv, look, 0.80f, tint, solid);
    case Face::east:
        return push_quad(out, {{1, 0, 1}, {1, 0, 0}, {1, 1, 0}, {1, 1, 1}}, uv, look, 0.62f, tint, solid);
    default:
        return;
    }
}

bool shown_flat(ShapeKind shape) {
    switch (shape) {
    case ShapeKind::cross:
    case ShapeKind::crop:
    case ShapeKind::rail:
    case ShapeKind::ladder:
    case ShapeKind::faces:
    case ShapeKind::lily_pad:
    case ShapeKind::torch:
    case ShapeKind::wall_torch:
    case ShapeKind::chain:
        return true;
    default:
        return false;
    }
}

std::vector<IconVertex> icon_vertices(const StateTable& states, const scene::BlockModels& models, StateId state,
                                      bool& flat) {
    std::vector<IconVertex> out;
    const StateInfo& info = states.info(state);
    const scene::ModelKind kind = models.kinds()[u32(state)];
    flat = info.look && shown_flat(info.look->shape);
    if (kind == scene::ModelKind::nothing) return out;
    if (flat) {
        const auto quads = models.quads(state);
        const u64 look = quads.empty() ? u64(info.face_textures[0]) << 32 : quads[0].bits;
        const Vec3 tint = tint_color(look, models);
        push_quad(out, {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1}, {1, 1}, {1, 0}, {0, 0}}, look, 1, tint);
    } else if (kind == scene::ModelKind::model) {
        for (const scene::StateQuad& q : models.quads(state)) {
            const scene::ModelQuad m = models.model_quad(Quad{q.bits}.model_quad());
            const Vec3 n{float(m.normal[0]) / 127, float(m.normal[1]) / 127, float(m.normal[2]) / 127};
            const bool two_sided = m.flags & scene::ModelQuad::kTwoSided;
            if (!two_sided && n.x + n.z + n.y * 0.8f <= 0.01f) continue;
            Vec3 p[4];
            Vec2 uv[4];
            for (u32 i = 0; i < 4; ++i) {
                p[i] = {float(m.corners[i].x) / 256, float(m.corners[i].y) / 256, float(m.corners[i].z) / 256};
                uv[i] = {float(m.corners[i].s) / 256, float(m.t[i]) / 256};
            }
            const float shade = 0.62f + 0.38f * std::max(n.y, 0.0f) + 0.18f * std::max(n.z, 0.0f);
            push_quad(out, p, uv, q.bits, shade, tint_color(q.bits, models));
        }
    } else {
        const scene::LiquidLook* liquid = models.liquid(state);
        for (Face f : {Face::east, Face::south, Face::up}) {
            const u64 look = liquid ? liquid->still : models.faces(state)[u8(f)];
            push_cube_face(out, f, look, tint_color(look, models), scene::hides(kind));
        }
    }
    return out;
}

} // namespace

Result<gfx::Texture> draw_icon(const gfx::Program& program, const TextureSet& textures, const StateTable& states,
                               const scene::BlockModels& models, StateId state, u32 size) {
    bool flat = false;
    const std::vector<IconVertex> vertices = icon_vertices(states, models, state, flat);
    gfx::Texture color = gfx::make_texture_2d(GL_RGBA8, size, size);
    gfx::set_filter(color, GL_LINEAR, GL_LINEAR, GL_CLAMP_TO_EDGE);
    const gfx::Texture depth = gfx::make_texture_2d(GL_DEPTH_COMPONENT32F, size, size);
    const gfx::Texture* colors[] = {&color};
    const gfx::Framebuffer framebuffer = gfx::make_framebuffer(colors, &depth);
    if (glCheckNamedFramebufferStatus(framebuffer.name(), GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
        return fail(ErrorCode::limit, "no framebuffer for a block's icon");
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE); // clearing heeds masks and scissors too
    glDepthMask(GL_TRUE);
    glDisable(GL_SCISSOR_TEST);
    const float clear[4] = {}, far = 0;
    glClearNamedFramebufferfv(framebuffer.name(), GL_COLOR, 0, clear);
    glClearNamedFramebufferfv(framebuffer.name(), GL_DEPTH, 0, &far);
    if (vertices.empty()) return color;
    const gfx::Buffer buffer = gfx::make_buffer(vertices.size() * sizeof(IconVertex), 0, vertices.data());
    const gfx::VertexArray array = gfx::make_vertex_array();
    glVertexArrayVertexBuffer(array.name(), 0, buffer.name(), 0, sizeof(IconVertex));
    for (u32 i = 0; i < 3; ++i) {
        glEnableVertexArrayAttrib(array.name(), i);
        glVertexArrayAttribFormat(array.name(), i, 4, GL_FLOAT, GL_FALSE, i * 16);
        glVertexArrayAttribBinding(array.name(), i, 0);
    }
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer.name());
    glViewport(0, 0, GLsizei(size), GLsizei(size));
    glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
    glDisable(GL_CULL_FACE);
    glDisable(GL_BLEND);
    glDisable(GL_STENCIL_TEST);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_GEQUAL);
    glUseProgram(program.name());
    glProgramUniform1i(program.name(), 0, flat ? 1 : 0);
    const u32 albedo = textures.albedo().name();
    glBindTextures(0, 1, &albedo);
    glBindVertexArray(array.name());
    glDrawArrays(GL_TRIANGLES, 0, GLsizei(vertices.size()));
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    return color;
}

} // namespace vitrail::render
