#include "platform/headless.h"
#include "platform/window.h"

#include <cstdlib>
#include <epoxy/gl.h>
#include <gtest/gtest.h>

namespace vitrail::platform {

TEST(Headless, GivesOpenGL45OrOneClearLine) {
    const auto context = HeadlessContext::create(true);
    if (!context) {
        EXPECT_EQ(context.error().code, ErrorCode::not_found);
        EXPECT_EQ(context.error().message.find('\n'), std::string::npos);
        GTEST_SKIP() << context.error().message;
    }
    GLint major = 0, profile = 0;
    glGetIntegerv(GL_MAJOR_VERSION, &major);
    glGetIntegerv(GL_CONTEXT_PROFILE_MASK, &profile);
    EXPECT_EQ(major, 4);
    EXPECT_TRUE(profile & GL_CONTEXT_CORE_PROFILE_BIT);
    EXPECT_FALSE((*context)->description().empty());
}

TEST(Headless, ManyInARow) {
    for (int i = 0; i < 4; ++i) {
        auto context = HeadlessContext::create();
        if (!context) GTEST_SKIP() << context.error().message;
        (*context)->release();
        EXPECT_TRUE((*context)->make_current());
        EXPECT_NE(glGetString(GL_VERSION), nullptr);
    }
}

TEST(Headless, SoftwareCanBeAskedFor) {
    setenv("VITRAIL_GL", "software", 1);
    const auto context = HeadlessContext::create();
    unsetenv("VITRAIL_GL");
    if (!context) GTEST_SKIP() << context.error().message;
    EXPECT_NE(std::string(reinterpret_cast<const char*>(glGetString(GL_RENDERER))).find("llvmpipe"), std::string::npos);
}

TEST(Window, NoDisplayIsOneClearLine) {
    const char* driver = std::getenv("SDL_VIDEODRIVER");
    const std::string before = driver ? driver : "";
    setenv("SDL_VIDEODRIVER", "nonsense", 1);
    const auto window = Window::create({.hidden = true});
    if (driver)
        setenv("SDL_VIDEODRIVER", before.c_str(), 1);
    else
        unsetenv("SDL_VIDEODRIVER");
    ASSERT_FALSE(window);
    EXPECT_EQ(window.error().code, ErrorCode::not_found);
    EXPECT_EQ(window.error().message.find('\n'), std::string::npos);
}

TEST(Window, OpensHiddenAndResizesWhereThereIsADisplay) {
    auto window = Window::create({.width = 320, .height = 200, .vsync = false, .hidden = true});
    if (!window) GTEST_SKIP() << window.error().message;
    EXPECT_EQ((*window)->width(), 320u);
    (*window)->set_size(400, 240);
    std::vector<InputEvent> events;
    for (int i = 0; i < 20; ++i) {
        (*window)->poll(events);
        (*window)->swap();
    }
    EXPECT_EQ((*window)->width(), 400u);
    EXPECT_EQ((*window)->height(), 240u);
}

} // namespace vitrail::platform
