#include "gfx/context.h"

#include "base/log.h"

#include <atomic>
#include <epoxy/gl.h>
#include <fmt/format.h>

namespace vitrail::gfx {

static std::string text_of(GLenum name) {
    const GLubyte* text = glGetString(name);
    return text ? reinterpret_cast<const char*>(text) : "";
}

Result<ContextInfo> context_info() {
    ContextInfo info;
    info.version = text_of(GL_VERSION);
    if (info.version.empty()) return fail(ErrorCode::unsupported, "no OpenGL context is current");
    info.vendor = text_of(GL_VENDOR);
    info.renderer = text_of(GL_RENDERER);
    GLint v = 0;
    glGetIntegerv(GL_MAJOR_VERSION, &v), info.major = u32(v);
    glGetIntegerv(GL_MINOR_VERSION, &v), info.minor = u32(v);
    if (info.major * 10 + info.minor < 45)
        return fail(ErrorCode::unsupported,
                    fmt::format("OpenGL 4.5 is needed, {} offers {}", info.renderer, info.version));
    for (const char* name : {"llvmpipe", "softpipe", "swrast", "SWR"})
        if (info.renderer.find(name) != std::string::npos) info.software = true;
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &v), info.texture_size_max = u32(v);
    glGetIntegerv(GL_MAX_3D_TEXTURE_SIZE, &v), info.texture_3d_size_max = u32(v);
    glGetIntegerv(GL_MAX_ARRAY_TEXTURE_LAYERS, &v), info.texture_layers_max = u32(v);
    if (epoxy_has_gl_extension("GL_EXT_texture_filter_anisotropic") ||
        epoxy_has_gl_extension("GL_ARB_texture_filter_anisotropic"))
        glGetFloatv(GL_MAX_TEXTURE_MAX_ANISOTROPY_EXT, &info.anisotropy_max);
    return info;
}

static std::atomic<u64> g_errors{0};

static void on_message(GLenum, GLenum type, GLuint, GLenum severity, GLsizei length, const GLchar* text, const void*) {
    // The same error comes every frame: the first ones tell enough.
    if (type == GL_DEBUG_TYPE_ERROR && ++g_errors > 20) return;
    const std::string_view message(text, length < 0 ? std::char_traits<char>::length(text) : std::size_t(length));
    if (type == GL_DEBUG_TYPE_ERROR)
        log_error(fmt::format("OpenGL: {}", message));
    else if (severity == GL_DEBUG_SEVERITY_HIGH)
        log_warning(fmt::format("OpenGL: {}", message));
}

void install_debug_callback() {
    glEnable(GL_DEBUG_OUTPUT);
    glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
    glDebugMessageCallback(on_message, nullptr);
}

u64 debug_error_count() {
    return g_errors;
}

std::string take_gl_error() {
    switch (const GLenum error = glGetError()) {
    case GL_NO_ERROR:
        return {};
    case GL_INVALID_ENUM:
        return "invalid enum";
    case GL_INVALID_VALUE:
        return "invalid value";
    case GL_INVALID_OPERATION:
        return "invalid operation";
    case GL_INVALID_FRAMEBUFFER_OPERATION:
        return "invalid framebuffer operation";
    case GL_OUT_OF_MEMORY:
        return "out of memory";
    default:
        return fmt::format("error {:#x}", error);
    }
}

} // namespace vitrail::gfx
