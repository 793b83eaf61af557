#include "render/ui_imgui.h"

#include <SDL.h>
#include <backends/imgui_impl_opengl3.h>
#include <backends/imgui_impl_sdl.h>
#include <imgui.h>

namespace vitrail::render {

Result<std::unique_ptr<UiLayer>> UiLayer::create(platform::Window& window) {
    IMGUI_CHECKVERSION();
    ImGui::CreateContext();
    ImGui::GetIO().IniFilename = nullptr; // settings are ours to keep
    ImGui::GetIO().ConfigFlags |= ImGuiConfigFlags_NoMouseCursorChange;
    const bool sdl = ImGui_ImplSDL2_InitForOpenGL(static_cast<SDL_Window*>(window.sdl_window()), window.gl_context());
    if (!sdl || !ImGui_ImplOpenGL3_Init("#version 450 core")) {
        if (sdl) ImGui_ImplSDL2_Shutdown();
        ImGui::DestroyContext();
        return fail(ErrorCode::unsupported, "the user interface cannot start on this OpenGL");
    }
    window.set_raw_listener(
        [](const void* event) { ImGui_ImplSDL2_ProcessEvent(static_cast<const SDL_Event*>(event)); });
    std::unique_ptr<UiLayer> made(new UiLayer);
    made->window_ = &window;
    return made;
}

UiLayer::~UiLayer() {
    window_->set_raw_listener({});
    ImGui_ImplOpenGL3_Shutdown();
    ImGui_ImplSDL2_Shutdown();
    ImGui::DestroyContext();
}

void UiLayer::begin_frame() {
    ImGui_ImplOpenGL3_NewFrame();
    ImGui_ImplSDL2_NewFrame();
    ImGuiIO& io = ImGui::GetIO();
    if (window_->mouse_captured()) {
        io.MousePos = ImVec2(-1e9f, -1e9f); // the pointer is hidden
    } else if (ImGui::IsMousePosValid(&io.MousePos)) {
        // The backend asks for the pointer on the screen, which stands still for X11 while a button is held: sliders would not
        // follow. Where the window's own events put it is right everywhere.
        int x = 0, y = 0;
        SDL_GetMouseState(&x, &y);
        io.MousePos = ImVec2(float(x), float(y));
    }
    ImGui::NewFrame();
}

void UiLayer::end_frame() {
    ImGui::Render();
    ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

bool UiLayer::wants_mouse() const {
    return ImGui::GetIO().WantCaptureMouse;
}
bool UiLayer::wants_keyboard() const {
    return ImGui::GetIO().WantCaptureKeyboard;
}

} // namespace vitrail::render
