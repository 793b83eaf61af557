#include "gfx/handles.h"

#include "base/assert.h"

#include <algorithm>
#include <epoxy/gl.h>

namespace vitrail::gfx {

void destroy_buffer(u32 name) {
    glDeleteBuffers(1, &name);
}
void destroy_texture(u32 name) {
    glDeleteTextures(1, &name);
}
void destroy_framebuffer(u32 name) {
    glDeleteFramebuffers(1, &name);
}
void destroy_program(u32 name) {
    glDeleteProgram(name);
}
void destroy_vertex_array(u32 name) {
    glDeleteVertexArrays(1, &name);
}
void destroy_query(u32 name) {
    glDeleteQueries(1, &name);
}
void destroy_sampler(u32 name) {
    glDeleteSamplers(1, &name);
}

Buffer make_buffer(u64 bytes, u32 flags, const void* data) {
    u32 name = 0;
    glCreateBuffers(1, &name);
    glNamedBufferStorage(name, GLsizeiptr(std::max<u64>(bytes, 4)), bytes == 0 ? nullptr : data, flags);
    Buffer buffer(name);
    buffer.bytes = bytes;
    return buffer;
}

void grow_buffer(Buffer& buffer, u64 bytes, u64 keep) {
    Buffer bigger = make_buffer(bytes, GL_DYNAMIC_STORAGE_BIT);
    if (keep > 0) {
        glCopyNamedBufferSubData(buffer.name(), bigger.name(), 0, 0, GLsizeiptr(keep));
        // NVIDIA's driver (seen on an H200) lets the next glNamedBufferSubData overtake this copy, which then undoes
        // it.
        glFinish();
    }
    buffer = std::move(bigger);
}

u32 bytes_per_texel(u32 format) {
    switch (format) {
    case GL_R8:
    case GL_R8UI:
        return 1;
    case GL_RGBA4:
    case GL_RG8:
    case GL_R16F:
    case GL_R16:
    case GL_DEPTH_COMPONENT16:
        return 2;
    case GL_RGBA8:
    case GL_SRGB8_ALPHA8:
    case GL_RGBA8UI:
    case GL_R32UI:
    case GL_R32F:
    case GL_R11F_G11F_B10F:
    case GL_DEPTH_COMPONENT32F:
    case GL_DEPTH_COMPONENT24:
    case GL_DEPTH24_STENCIL8:
    case GL_RG16F:
        return 4;
    case GL_RGBA16F:
    case GL_DEPTH32F_STENCIL8:
    case GL_RG32UI:
    case GL_RG32F:
    case GL_RGBA16:
    case GL_RGBA16UI:
        return 8;
    case GL_RGBA32F:
        return 16;
    default:
        return 0;
    }
}

u64 Texture::bytes() const {
    u64 texels = 0;
    for (u32 level = 0; level < levels; ++level) {
        const u64 d = target == GL_TEXTURE_3D ? std::max(depth >> level, 1u) : depth;
        texels += u64(std::max(width >> level, 1u)) * std::max(height >> level, 1u) * d;
    }
    return texels * bytes_per_texel(format);
}

static Texture make_texture(u32 target, u32 format, u32 width, u32 height, u32 depth, u32 levels) {
    u32 name = 0;
    glCreateTextures(target, 1, &name);
    if (target == GL_TEXTURE_2D)
        glTextureStorage2D(name, GLsizei(levels), format, GLsizei(width), GLsizei(height));
    else
        glTextureStorage3D(name, GLsizei(levels), format, GLsizei(width), GLsizei(height), GLsizei(depth));
    Texture texture(name);
    texture.target = target, texture.format = format;
    texture.width = width, texture.height = height, texture.depth = depth, texture.levels = levels;
    set_filter(texture, GL_NEAREST, GL_NEAREST, GL_CLAMP_TO_EDGE);
    return texture;
}

Texture make_texture_2d(u32 format, u32 width, u32 height, u32 levels) {
    return make_texture(GL_TEXTURE_2D, format, width, height, 1, levels);
}
Texture make_texture_2d_array(u32 format, u32 width, u32 height, u32 layers, u32 levels) {
    return make_texture(GL_TEXTURE_2D_ARRAY, format, width, height, layers, levels);
}
Texture make_texture_3d(u32 format, u32 width, u32 height, u32 depth) {
    return make_texture(GL_TEXTURE_3D, format, width, height, depth, 1);
}

void set_filter(const Texture& texture, u32 min_filter, u32 mag_filter, u32 wrap) {
    glTextureParameteri(texture.name(), GL_TEXTURE_MIN_FILTER, GLint(min_filter));
    glTextureParameteri(texture.name(), GL_TEXTURE_MAG_FILTER, GLint(mag_filter));
    glTextureParameteri(texture.name(), GL_TEXTURE_WRAP_S, GLint(wrap));
    glTextureParameteri(texture.name(), GL_TEXTURE_WRAP_T, GLint(wrap));
    glTextureParameteri(texture.name(), GL_TEXTURE_WRAP_R, GLint(wrap));
}

static u32 depth_attachment(u32 format) {
    return format == GL_DEPTH32F_STENCIL8 || format == GL_DEPTH24_STENCIL8 ? GL_DEPTH_STENCIL_ATTACHMENT
                                                                           : GL_DEPTH_ATTACHMENT;
}

Framebuffer make_framebuffer(std::span<const Texture* const> colors, const Texture* depth) {
    VX_ASSERT(colors.size() <= 8);
    u32 name = 0;
    glCreateFramebuffers(1, &name);
    GLenum buffers[8];
    for (u32 i = 0; i < colors.size(); ++i) {
        buffers[i] = GL_COLOR_ATTACHMENT0 + i;
        glNamedFramebufferTexture(name, buffers[i], colors[i]->name(), 0);
    }
    glNamedFramebufferDrawBuffers(name, GLsizei(colors.size()), buffers);
    if (depth) glNamedFramebufferTexture(name, depth_attachment(depth->format), depth->name(), 0);
    return Framebuffer(name);
}

VertexArray make_vertex_array() {
    u32 name = 0;
    glCreateVertexArrays(1, &name);
    return VertexArray(name);
}

Query make_query(u32 target) {
    u32 name = 0;
    glCreateQueries(target, 1, &name);
    return Query(name);
}

Sampler make_sampler(u32 min_filter, u32 mag_filter, u32 wrap) {
    u32 name = 0;
    glCreateSamplers(1, &name);
    glSamplerParameteri(name, GL_TEXTURE_MIN_FILTER, GLint(min_filter));
    glSamplerParameteri(name, GL_TEXTURE_MAG_FILTER, GLint(mag_filter));
    glSamplerParameteri(name, GL_TEXTURE_WRAP_S, GLint(wrap));
    glSamplerParameteri(name, GL_TEXTURE_WRAP_T, GLint(wrap));
    glSamplerParameteri(name, GL_TEXTURE_WRAP_R, GLint(wrap));
    return Sampler(name);
}

} // namespace vitrail::gfx
