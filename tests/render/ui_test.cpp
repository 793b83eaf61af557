#include "gfx/context.h"
#include "render/renderer.h"
#include "render/ui_imgui.h"
#include "scene/sky.h"

#include <epoxy/gl.h>
#include <gtest/gtest.h>
#include <imgui.h>

namespace vitrail::render {

TEST(Ui, DrawsOverThePictureInAWindow) {
    auto window = platform::Window::create({.width = 320, .height = 200, .vsync = false, .hidden = true});
    if (!window) GTEST_SKIP() << window.error().message;
    auto renderer = Renderer::create({.effects = preset_effects(Preset::low)});
    ASSERT_TRUE(renderer) << renderer.error().message;
    auto ui = UiLayer::create(**window);
    ASSERT_TRUE(ui) << ui.error().message;
    scene::FrameView frame;
    frame.sky = scene::sky_at(6000);
    frame.views.emplace_back();
    frame.views[0].rotation = view_rotation(0, 0);
    std::vector<platform::InputEvent> events;
    const u64 errors = gfx::debug_error_count();
    for (int i = 0; i < 3; ++i) { // twice: each must leave the state that the other needs
        (*window)->poll(events);
        frame.width = (*window)->width(), frame.height = (*window)->height();
        ASSERT_TRUE((*renderer)->render(frame, 0));
        (*ui)->begin_frame();
        ImGui::GetForegroundDrawList()->AddRectFilled(ImVec2(10, 10), ImVec2(60, 60), IM_COL32(255, 0, 255, 255));
        (*ui)->end_frame();
        u8 inside[4] = {}, outside[4] = {};
        glBindFramebuffer(GL_READ_FRAMEBUFFER, 0);
        glReadPixels(30, GLint(frame.height) - 30, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE, inside);
        glReadPixels(200, 100, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE, outside);
        EXPECT_GT(inside[0], 250);
        EXPECT_LT(inside[1], 5);
        EXPECT_GT(outside[1], 60); // the sky
        (*window)->swap();
    }
    EXPECT_EQ(gfx::debug_error_count(), errors);
}

} // namespace vitrail::render
