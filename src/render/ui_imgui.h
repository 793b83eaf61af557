// Dear ImGui on the window: set-up, frames, drawing. The client draws crosshair, hotbar, menus and F3 text with ImGui
// itself between begin and end.
#pragma once

#include "base/result.h"
#include "platform/window.h"

#include <memory>

namespace vitrail::render {

class UiLayer {
public:
    // One at a time; the window must outlive it. Takes the window's raw listener. Errors: unsupported.
    static Result<std::unique_ptr<UiLayer>> create(platform::Window& window);
    ~UiLayer();
    UiLayer(const UiLayer&) = delete;
    UiLayer& operator=(const UiLayer&) = delete;
    void begin_frame();
    void end_frame(); // draws onto the window's framebuffer
    bool wants_mouse() const;
    bool wants_keyboard() const;

private:
    UiLayer() = default;
    platform::Window* window_ = nullptr;
};

} // namespace vitrail::render
