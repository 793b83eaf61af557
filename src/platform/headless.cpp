#include "platform/headless.h"

#include <cstdlib>
#include <cstring>
#include <dlfcn.h>
#include <epoxy/egl.h>
#include <epoxy/gl.h>
#include <fmt/format.h>
#include <vector>

namespace vitrail::platform {

namespace {

struct Candidate {
    EGLDisplay display = EGL_NO_DISPLAY;
    std::string name;
};

bool has_word(const char* list, const char* word) {
    if (!list) return false;
    const std::size_t length = std::strlen(word);
    for (const char* at = list; (at = std::strstr(at, word)); at += length)
        if ((at == list || at[-1] == ' ') && (at[length] == 0 || at[length] == ' ')) return true;
    return false;
}

// Hardware devices first, then Mesa without any device (software), then software devices, then the default display.
std::vector<Candidate> candidates(bool only_software) {
    std::vector<Candidate> found, software;
    const char* client = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
    if (has_word(client, "EGL_EXT_device_enumeration") && has_word(client, "EGL_EXT_platform_device")) {
        EGLDeviceEXT devices[32];
        EGLint count = 0;
        if (eglQueryDevicesEXT(32, devices, &count))
            for (EGLint i = 0; i < count; ++i) {
                const bool soft =
                    has_word(eglQueryDeviceStringEXT(devices[i], EGL_EXTENSIONS), "EGL_MESA_device_software");
                const EGLDisplay display = eglGetPlatformDisplayEXT(EGL_PLATFORM_DEVICE_EXT, devices[i], nullptr);
                if (soft)
                    software.push_back({display, fmt::format("EGL software device {}", i)});
                else if (!only_software)
                    found.push_back({display, fmt::format("EGL device {}", i)});
            }
    }
    if (has_word(client, "EGL_MESA_platform_surfaceless"))
        found.push_back(
            {eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr), "EGL surfaceless"});
    found.insert(found.end(), software.begin(), software.end());
    if (!only_software) found.push_back({eglGetDisplay(EGL_DEFAULT_DISPLAY), "EGL default display"});
    return found;
}

bool draws_in_software() {
    const auto* name = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
    return name && (std::strstr(name, "llvmpipe") || std::strstr(name, "softpipe") || std::strstr(name, "swrast"));
}

// A context without surfaces; null where this display has none.
EGLContext make_context(EGLDisplay display, bool debug, bool only_software) {
    EGLint major = 0, minor = 0;
    if (display == EGL_NO_DISPLAY || !eglInitialize(display, &major, &minor)) return EGL_NO_CONTEXT;
    const char* extensions = eglQueryString(display, EGL_EXTENSIONS);
    const bool usable = has_word(extensions, "EGL_KHR_surfaceless_context") &&
                        has_word(extensions, "EGL_KHR_create_context") && eglBindAPI(EGL_OPENGL_API);
    EGLContext context = EGL_NO_CONTEXT;
    if (usable) {
        const EGLint wanted[] = {EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_NONE};
        EGLConfig config = nullptr;
        EGLint count = 0;
        if (!eglChooseConfig(display, wanted, &config, 1, &count) || count == 0) config = nullptr; // no-config context
        const EGLint attributes[] = {EGL_CONTEXT_MAJOR_VERSION,
                                     4,
                                     EGL_CONTEXT_MINOR_VERSION,
                                     5,
                                     EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                     EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                     EGL_CONTEXT_OPENGL_DEBUG,
                                     debug ? EGL_TRUE : EGL_FALSE,
                                     EGL_NONE};
        context = eglCreateContext(display, config, EGL_NO_CONTEXT, attributes);
        if (context != EGL_NO_CONTEXT && !eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context)) {
            eglDestroyContext(display, context);
            context = EGL_NO_CONTEXT;
        }
        // The surfaceless platform may belong to a hardware driver.
        if (context != EGL_NO_CONTEXT && only_software && !draws_in_software()) {
            eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
            eglDestroyContext(display, context);
            return EGL_NO_CONTEXT;
        }
    }
    if (context == EGL_NO_CONTEXT) eglTerminate(display);
    return context;
}

} // namespace

Result<std::unique_ptr<HeadlessContext>> HeadlessContext::create(bool debug) {
    // epoxy ends the program where it finds no library, so it is looked for first.
    if (void* egl = dlopen("libEGL.so.1", RTLD_LAZY | RTLD_LOCAL))
        dlclose(egl);
    else
        return fail(ErrorCode::not_found, "this machine has no libEGL.so.1");
    const char* wanted = std::getenv("VITRAIL_GL");
    const bool only_software = wanted && std::strcmp(wanted, "software") == 0;
    std::string tried;
    for (const Candidate& candidate : candidates(only_software)) {
        const EGLContext context = make_context(candidate.display, debug, only_software);
        if (context != EGL_NO_CONTEXT) {
            std::unique_ptr<HeadlessContext> made(new HeadlessContext);
            made->display_ = candidate.display;
            made->context_ = context;
            made->description_ = candidate.name;
            return made;
        }
        tried += (tried.empty() ? "" : ", ") + candidate.name;
    }
    return fail(
        ErrorCode::not_found,
        fmt::format(
            "no OpenGL 4.5 without a window here (tried {}); libegl-mesa0 and libgl1-mesa-dri bring a software one",
            tried.empty() ? "nothing: EGL offers no display" : tried));
}

HeadlessContext::~HeadlessContext() {
    eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    eglDestroyContext(display_, context_);
    // Displays are shared by the whole process; terminating one would pull it from under another context.
}

Result<> HeadlessContext::make_current() {
    if (eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_)) return {};
    return fail(ErrorCode::unsupported,
                fmt::format("the OpenGL context cannot be used here (EGL error {:#x})", eglGetError()));
}

void HeadlessContext::release() {
    eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
}

} // namespace vitrail::platform
