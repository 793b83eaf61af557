#include "platform/window.h"

#include <SDL.h>
#include <cstdlib>
#include <fmt/format.h>

namespace vitrail::platform {

static constexpr const char* kNoDisplay =
    "no display for a window (DISPLAY and WAYLAND_DISPLAY are not set or do not answer)";

static SDL_Window* sdl(void* window) {
    return static_cast<SDL_Window*>(window);
}

static tl::unexpected<Error> no_window(const char* what) {
    return fail(ErrorCode::not_found, fmt::format("{}: {}", what, SDL_GetError()));
}

static bool is_set(const char* variable) {
    const char* value = std::getenv(variable);
    return value && *value;
}

Result<std::unique_ptr<Window>> Window::create(const WindowOptions& options) {
    SDL_SetHint(SDL_HINT_VIDEO_X11_NET_WM_BYPASS_COMPOSITOR, "0");
    // Without this variable no Wayland display can be reached, and its library would print lines of its own.
    if (!is_set("XDG_RUNTIME_DIR") && !is_set("SDL_VIDEODRIVER"))
        SDL_SetHintWithPriority(SDL_HINT_VIDEODRIVER, "x11,KMSDRM", SDL_HINT_OVERRIDE);
    if (SDL_InitSubSystem(SDL_INIT_VIDEO) != 0) {
        if (is_set("SDL_VIDEODRIVER")) return no_window("no display for a window");
        return fail(ErrorCode::not_found, kNoDisplay);
    }
    std::unique_ptr<Window> made(new Window);
    made->sdl_started_ = true;
    // SDL falls back to drivers that show nothing; nobody could see that window unless he asked for it.
    const std::string driver = SDL_GetCurrentVideoDriver();
    if ((driver == "offscreen" || driver == "dummy" || driver == "evdev") && !is_set("SDL_VIDEODRIVER"))
        return fail(ErrorCode::not_found, kNoDisplay);
    SDL_GL_SetAttribute(SDL_GL_CONTEXT_MAJOR_VERSION, 4);
    SDL_GL_SetAttribute(SDL_GL_CONTEXT_MINOR_VERSION, 5);
    SDL_GL_SetAttribute(SDL_GL_CONTEXT_PROFILE_MASK, SDL_GL_CONTEXT_PROFILE_CORE);
    SDL_GL_SetAttribute(SDL_GL_CONTEXT_FLAGS, options.debug ? SDL_GL_CONTEXT_DEBUG_FLAG : 0);
    SDL_GL_SetAttribute(SDL_GL_DOUBLEBUFFER, 1);
    SDL_GL_SetAttribute(SDL_GL_DEPTH_SIZE, 0); // our own targets carry depth
    u32 flags = SDL_WINDOW_OPENGL | SDL_WINDOW_RESIZABLE | SDL_WINDOW_ALLOW_HIGHDPI;
    if (options.hidden) flags |= SDL_WINDOW_HIDDEN;
    made->window_ = SDL_CreateWindow(options.title.c_str(), SDL_WINDOWPOS_CENTERED, SDL_WINDOWPOS_CENTERED,
                                     int(options.width), int(options.height), flags);
    if (!made->window_) return no_window("no window");
    made->context_ = SDL_GL_CreateContext(sdl(made->window_));
    if (!made->context_) return no_window("no OpenGL 4.5 for the window");
    SDL_SetWindowMinimumSize(sdl(made->window_), 160, 90);
    made->set_vsync(options.vsync);
    int w = 0, h = 0;
    SDL_GL_GetDrawableSize(sdl(made->window_), &w, &h);
    made->width_ = u32(w), made->height_ = u32(h);
    SDL_StopTextInput();
    return made;
}

Window::~Window() {
    if (context_) SDL_GL_DeleteContext(context_);
    if (window_) SDL_DestroyWindow(sdl(window_));
    if (sdl_started_) SDL_QuitSubSystem(SDL_INIT_VIDEO);
}

static MouseButton button_of(u8 sdl_button) {
    switch (sdl_button) {
    case SDL_BUTTON_LEFT:
        return MouseButton::left;
    case SDL_BUTTON_MIDDLE:
        return MouseButton::middle;
    case SDL_BUTTON_RIGHT:
        return MouseButton::right;
    case SDL_BUTTON_X1:
        return MouseButton::x1;
    case SDL_BUTTON_X2:
        return MouseButton::x2;
    default:
        return MouseButton::none;
    }
}

void Window::poll(std::vector<InputEvent>& out) {
    SDL_Event event;
    while (SDL_PollEvent(&event)) {
        if (raw_listener_) raw_listener_(&event);
        InputEvent e;
        switch (event.type) {
        case SDL_QUIT:
            e.kind = EventKind::quit;
            break;
        case SDL_KEYDOWN:
        case SDL_KEYUP:
            e.kind = EventKind::key;
            e.down = event.type == SDL_KEYDOWN;
            e.repeat = event.key.repeat != 0;
            e.key = Key(event.key.keysym.scancode);
            break;
        case SDL_MOUSEBUTTONDOWN:
        case SDL_MOUSEBUTTONUP:
            e.kind = EventKind::mouse_button;
            e.down = event.type == SDL_MOUSEBUTTONDOWN;
            e.button = button_of(event.button.button);
            e.x = float(event.button.x), e.y = float(event.button.y);
            break;
        case SDL_MOUSEMOTION:
            e.kind = EventKind::mouse_move;
            e.x = float(event.motion.x), e.y = float(event.motion.y);
            e.dx = float(event.motion.xrel), e.dy = float(event.motion.yrel);
            break;
        case SDL_MOUSEWHEEL:
            e.kind = EventKind::mouse_wheel;
            e.x = float(event.wheel.x), e.y = float(event.wheel.y);
            break;
        case SDL_TEXTINPUT:
            e.kind = EventKind::text;
            e.text = event.text.text;
            break;
        case SDL_WINDOWEVENT:
            switch (event.window.event) {
            case SDL_WINDOWEVENT_SIZE_CHANGED: {
                int w = 0, h = 0;
                SDL_GL_GetDrawableSize(sdl(window_), &w, &h);
                width_ = e.width = u32(w), height_ = e.height = u32(h);
                e.kind = EventKind::resize;
                break;
            }
            case SDL_WINDOWEVENT_FOCUS_GAINED:
            case SDL_WINDOWEVENT_FOCUS_LOST:
                e.kind = EventKind::focus;
                e.down = event.window.event == SDL_WINDOWEVENT_FOCUS_GAINED;
                break;
            default:
                continue;
            }
            break;
        default:
            continue;
        }
        out.push_back(std::move(e));
    }
}

void Window::swap() {
    SDL_GL_SwapWindow(sdl(window_));
}

void Window::capture_mouse(bool on) {
    SDL_SetRelativeMouseMode(on ? SDL_TRUE : SDL_FALSE);
    captured_ = on;
}

void Window::set_vsync(bool on) {
    if (!on)
        SDL_GL_SetSwapInterval(0);
    else if (SDL_GL_SetSwapInterval(-1) != 0)
        SDL_GL_SetSwapInterval(1); // adaptive where the driver has it
}

void Window::set_fullscreen(bool on) {
    if (SDL_SetWindowFullscreen(sdl(window_), on ? SDL_WINDOW_FULLSCREEN_DESKTOP : 0) == 0) fullscreen_ = on;
}

void Window::set_title(const std::string& title) {
    SDL_SetWindowTitle(sdl(window_), title.c_str());
}
void Window::set_size(u32 width, u32 height) {
    SDL_SetWindowSize(sdl(window_), int(width), int(height));
}

void Window::start_text_input(bool on) {
    if (on)
        SDL_StartTextInput();
    else
        SDL_StopTextInput();
}

} // namespace vitrail::platform
