// Renderer's reading of pictures and targets back from the GPU.
#include "render/renderer_impl.h"

#include <algorithm>
#include <epoxy/gl.h>
#include <fmt/format.h>

namespace vitrail::render {

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

Result<TargetPixels> Renderer::read_target(const std::string& name) {
    const gfx::FrameGraph& graph = impl_->graph;
    if (!impl_->picture_drawn || !graph.has_target(name))
        return fail(ErrorCode::not_found, fmt::format("no target {}", name));
    // After a frame, targets with history have changed places.
    const gfx::Texture& texture = graph.target(graph.has_history(name) ? name + "@before" : name);
    TargetPixels out{texture.width, texture.height * texture.depth, 4, {}}; // layers one above the other
    out.values.resize(std::size_t(out.width) * out.height * 4);
    const u32 f = texture.format;
    const bool depth = f == GL_DEPTH_COMPONENT32F || f == GL_DEPTH_COMPONENT24 || f == GL_DEPTH_COMPONENT16 ||
                       f == GL_DEPTH32F_STENCIL8;
    const bool whole = f == GL_RGBA8UI || f == GL_R8UI || f == GL_RGBA16UI || f == GL_R32UI || f == GL_RG32UI;
    if (depth) {
        out.channels = 1;
        out.values.resize(std::size_t(out.width) * out.height);
    }
    const GLsizei bytes = GLsizei(out.values.size() * sizeof(float));
    if (whole) {
        std::vector<u32> words(out.values.size());
        glGetTextureImage(texture.name(), 0, GL_RGBA_INTEGER, GL_UNSIGNED_INT, bytes, words.data());
        std::copy(words.begin(), words.end(), out.values.begin());
    } else {
        glGetTextureImage(texture.name(), 0, depth ? GL_DEPTH_COMPONENT : GL_RGBA, GL_FLOAT, bytes, out.values.data());
    }
    flip_rows(reinterpret_cast<u8*>(out.values.data()), out.height, std::size_t(out.width) * out.channels * sizeof(float));
    return out;
}

Result<std::vector<u8>> Renderer::read_view_numbers() {
    VX_TRY_ASSIGN(const TargetPixels surface, read_target("surface"));
    std::vector<u8> numbers(std::size_t(surface.width) * surface.height);
    for (std::size_t i = 0; i < numbers.size(); ++i)
        numbers[i] = u8(surface.values[i * 4 + 2]) & 7;
    return numbers;
}

Result<Image> Renderer::read_texture(const gfx::Texture& texture) {
    Image image{texture.width, texture.height, 4, {}};
    image.pixels.resize(std::size_t(image.width) * image.height * 4);
    glGetTextureImage(texture.name(), 0, GL_RGBA, GL_UNSIGNED_BYTE, GLsizei(image.pixels.size()), image.pixels.data());
    flip_rows(image.pixels.data(), image.height, std::size_t(image.width) * 4);
    return image;
}

} // namespace vitrail::render
