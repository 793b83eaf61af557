// A window with an OpenGL 4.5 core context, by SDL2. One window a process; use it on the thread that made it.
#pragma once

#include "base/result.h"
#include "base/types.h"
#include "platform/input.h"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace vitrail::platform {

struct WindowOptions {
    std::string title = "Vitrail";
    u32 width = 1280, height = 720;
    bool vsync = true;
    bool hidden = false; // for tests
    bool debug = false;  // OpenGL debug context
};

class Window {
public:
    // The context is current afterwards. Errors: not_found where there is no display or no such OpenGL.
    static Result<std::unique_ptr<Window>> create(const WindowOptions& options);
    ~Window();
    Window(const Window&) = delete;
    Window& operator=(const Window&) = delete;

    // Appends what happened since the last call.
    void poll(std::vector<InputEvent>& out);
    // Sees every SDL_Event first (as a pointer to it), for user-interface libraries.
    void set_raw_listener(std::function<void(const void* sdl_event)> listener) { raw_listener_ = std::move(listener); }
    void swap();
    u32 width() const { return width_; } // drawable pixels
    u32 height() const { return height_; }
    void capture_mouse(bool on); // hidden and endless, for looking around
    bool mouse_captured() const { return captured_; }
    void set_vsync(bool on);
    void set_fullscreen(bool on);
    bool fullscreen() const { return fullscreen_; }
    void set_title(const std::string& title);
    void set_size(u32 width, u32 height);
    void start_text_input(bool on);
    void* sdl_window() const { return window_; }  // SDL_Window*
    void* gl_context() const { return context_; } // SDL_GLContext

private:
    Window() = default;
    void* window_ = nullptr;
    void* context_ = nullptr;
    u32 width_ = 0, height_ = 0;
    bool captured_ = false, fullscreen_ = false, sdl_started_ = false;
    std::function<void(const void*)> raw_listener_;
};

} // namespace vitrail::platform
