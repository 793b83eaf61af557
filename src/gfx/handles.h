// Move-only owners of OpenGL objects, made by direct state access (OpenGL 4.5 core). Names are plain u32, so that
// headers need no OpenGL header. All must be made, used and destroyed on the thread whose context is current.
#pragma once

#include "base/types.h"

#include <span>
#include <string_view>
#include <utility>

namespace vitrail::gfx {

// Owns one OpenGL name; 0 is empty. Destroy is a plain function, so that a handle is 4 bytes.
template <void (*Destroy)(u32)>
class Handle {
public:
    Handle() = default;
    explicit Handle(u32 name)
        : name_(name) {}
    Handle(Handle&& o) noexcept
        : name_(std::exchange(o.name_, 0u)) {}
    Handle& operator=(Handle&& o) noexcept {
        if (this != &o) {
            reset();
            name_ = std::exchange(o.name_, 0u);
        }
        return *this;
    }
    ~Handle() { reset(); }
    u32 name() const { return name_; }
    explicit operator bool() const { return name_ != 0; }
    void reset() {
        if (name_ != 0) Destroy(std::exchange(name_, 0u));
    }

private:
    u32 name_ = 0;
};

void destroy_buffer(u32 name);
void destroy_texture(u32 name);
void destroy_framebuffer(u32 name);
void destroy_program(u32 name);
void destroy_vertex_array(u32 name);
void destroy_query(u32 name);
void destroy_sampler(u32 name);

using Program = Handle<destroy_program>;
using Framebuffer = Handle<destroy_framebuffer>;
using VertexArray = Handle<destroy_vertex_array>;
using Query = Handle<destroy_query>;
using Sampler = Handle<destroy_sampler>;

// Immutable storage of a fixed size.
struct Buffer : Handle<destroy_buffer> {
    using Handle::Handle;
    u64 bytes = 0;
};
// flags: GL_DYNAMIC_STORAGE_BIT and the like; data may be null.
Buffer make_buffer(u64 bytes, u32 flags, const void* data = nullptr);

// A larger buffer (GL_DYNAMIC_STORAGE_BIT) that begins with the first `keep` bytes of this one, in its place. Waits for
// the GPU.
void grow_buffer(Buffer& buffer, u64 bytes, u64 keep);

struct Texture : Handle<destroy_texture> {
    using Handle::Handle;
    u32 target = 0, format = 0; // GL_TEXTURE_2D..., sized internal format
    u32 width = 0, height = 0, depth = 1, levels = 1;
    u64 bytes() const; // of all levels, without padding of the driver
};
Texture make_texture_2d(u32 format, u32 width, u32 height, u32 levels = 1);
Texture make_texture_2d_array(u32 format, u32 width, u32 height, u32 layers, u32 levels = 1);
Texture make_texture_3d(u32 format, u32 width, u32 height, u32 depth);
void set_filter(const Texture& texture, u32 min_filter, u32 mag_filter, u32 wrap);

// Colors at attachments 0, 1, ...; depth may be null. Depth-stencil formats are attached as both.
Framebuffer make_framebuffer(std::span<const Texture* const> colors, const Texture* depth);
VertexArray make_vertex_array();
Query make_query(u32 target);
Sampler make_sampler(u32 min_filter, u32 mag_filter, u32 wrap);

u32 bytes_per_texel(u32 format); // 0 for a format we do not use

} // namespace vitrail::gfx
