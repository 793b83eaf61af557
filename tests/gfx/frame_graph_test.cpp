#include "gfx/context.h"
#include "gfx/frame_graph.h"
#include "gfx/program.h"
#include "gfx/upload_ring.h"
#include "platform/headless.h"

#include <array>
#include <cstring>
#include <epoxy/gl.h>
#include <gtest/gtest.h>

namespace vitrail::gfx {

static PassDesc pass(std::string name, std::vector<std::string> reads, std::vector<std::string> writes) {
    return {std::move(name), std::move(reads), std::move(writes), [](const PassContext&) {}, ""};
}

static std::string refusal(const FrameGraph& graph) {
    const Result<> result = graph.compile();
    return result ? "" : result.error().message;
}

TEST(FrameGraph, RefusesWhatCannotBe) {
    FrameGraph graph;
    graph.add_target({"a", GL_RGBA8});
    graph.add_target({"b", GL_RGBA8, 2});
    graph.add_external("screen");
    graph.add_pass(pass("one", {}, {"a"}));
    EXPECT_EQ(refusal(graph), "");
    auto with = [&](PassDesc p) {
        FrameGraph g;
        g.add_target({"a", GL_RGBA8});
        g.add_target({"b", GL_RGBA8, 2});
        g.add_target({"d", GL_DEPTH_COMPONENT32F});
        g.add_external("screen");
        g.add_pass(pass("one", {}, {"a"}));
        g.add_pass(std::move(p));
        return refusal(g);
    };
    EXPECT_EQ(with(pass("two", {"a"}, {"screen"})), "");
    EXPECT_NE(with(pass("two", {"b"}, {"screen"})).find("before anything wrote"), std::string::npos);
    EXPECT_NE(with(pass("two", {"x"}, {"screen"})).find("unknown"), std::string::npos);
    EXPECT_NE(with(pass("two", {"a"}, {"x"})).find("unknown"), std::string::npos);
    EXPECT_NE(with(pass("two", {"a"}, {})).find("nothing"), std::string::npos);
    EXPECT_NE(with(pass("two", {"a"}, {"a"})).find("attached"), std::string::npos);
    EXPECT_NE(with(pass("one", {}, {"b"})).find("second"), std::string::npos);
    EXPECT_NE(with(pass("two", {}, {"a", "b"})).find("different sizes"), std::string::npos);
    EXPECT_NE(with(pass("two", {}, {"a", "screen"})).find("external"), std::string::npos);
    PassDesc tests_depth = pass("two", {}, {"a"});
    tests_depth.depth_test = "d";
    EXPECT_NE(with(tests_depth).find("before anything wrote"), std::string::npos);
}

class WithContext : public testing::Test {
protected:
    void SetUp() override {
        auto made = platform::HeadlessContext::create();
        if (!made) GTEST_SKIP() << made.error().message;
        context_ = std::move(*made);
    }
    std::unique_ptr<platform::HeadlessContext> context_;
};

using Graphics = WithContext;

TEST_F(Graphics, ContextTellsWhatItIs) {
    const auto info = context_info();
    ASSERT_TRUE(info) << info.error().message;
    EXPECT_GE(info->major * 10 + info->minor, 45u);
    EXPECT_GE(info->texture_layers_max, 2048u);
    EXPECT_FALSE(info->renderer.empty());
}

TEST_F(Graphics, ShaderErrorsNameProgramAndLine) {
    const auto bad = build_program(
        {"broken", "void main() { gl_Position = vec4(0); }\n", "\nvoid main() {\n  nonsense = 1;\n}\n", "", {}});
    ASSERT_FALSE(bad);
    EXPECT_EQ(bad.error().code, ErrorCode::invalid_argument);
    EXPECT_NE(bad.error().message.find("fragment shader of broken"), std::string::npos) << bad.error().message;
    EXPECT_NE(bad.error().message.find("nonsense = 1"), std::string::npos) << bad.error().message;
    const auto good = build_program({"fine",
                                     "void main() { gl_Position = vec4(0); }\n",
                                     "layout(location = 0) out vec4 c;\nvoid main() { c = vec4(VALUE); }\n",
                                     "",
                                     {"VALUE 1.0"}});
    EXPECT_TRUE(good) << good.error().message;
}

TEST_F(Graphics, TargetsFollowTheSize) {
    FrameGraph graph;
    graph.add_target({"color", GL_RGBA8});
    graph.add_target({"half", GL_RGBA16F, 2});
    graph.add_target({"depth", GL_DEPTH_COMPONENT32F});
    u32 seen_width = 0, seen_half = 0;
    graph.add_pass({"draw", {}, {"color", "depth"}, [&](const PassContext& c) { seen_width = c.width; }, ""});
    graph.add_pass({"blur", {"color"}, {"half"}, [&](const PassContext& c) { seen_half = c.width; }, ""});
    ASSERT_TRUE(graph.compile());
    for (u32 width : {64u, 333u, 1u}) {
        ASSERT_TRUE(graph.resize(width, 40));
        graph.execute();
        EXPECT_EQ(seen_width, width);
        EXPECT_EQ(seen_half, (width + 1) / 2);
        EXPECT_EQ(graph.target("color").width, width);
    }
    EXPECT_EQ(graph.target_bytes(), 1 * 40 * 4 + 1 * 20 * 8 + 1 * 40 * 4u);
    EXPECT_EQ(take_gl_error(), "");
}

// What is as large as the screen follows it, whatever the frame's size; what external passes draw into too.
TEST_F(Graphics, TheScreenMayBeLargerThanTheFrame) {
    FrameGraph graph;
    std::vector<std::array<u32, 2>> seen(3);
    graph.add_external("window");
    graph.add_target({"small", GL_RGBA8});
    graph.add_target({.name = "large", .format = GL_RGBA8, .screen = true});
    const auto note = [&](u32 i) { return [&seen, i](const PassContext& c) { seen[i] = {c.width, c.height}; }; };
    graph.add_pass({"draw", {}, {"small"}, note(0), ""});
    graph.add_pass({"enlarge", {"small"}, {"large"}, note(1), ""});
    graph.add_pass({"show", {"large"}, {"window"}, note(2), ""});
    ASSERT_TRUE(graph.compile());
    ASSERT_TRUE(graph.resize(30, 20, 50, 40));
    graph.execute();
    EXPECT_EQ(seen, (std::vector<std::array<u32, 2>>{{30, 20}, {50, 40}, {50, 40}}));
    const u32 large = graph.target("large").name();
    ASSERT_TRUE(graph.resize(40, 30, 50, 40));
    graph.execute();
    EXPECT_EQ(seen, (std::vector<std::array<u32, 2>>{{40, 30}, {50, 40}, {50, 40}}));
    EXPECT_EQ(graph.target("large").name(), large); // its size stayed
    FrameGraph mixed;
    mixed.add_target({"small", GL_RGBA8});
    mixed.add_target({.name = "large", .format = GL_RGBA8, .screen = true});
    mixed.add_pass(pass("both", {}, {"small", "large"}));
    EXPECT_NE(refusal(mixed).find("different sizes"), std::string::npos);
}

static float first_texel(const Texture& texture) {
    std::vector<float> values(std::size_t(texture.width) * texture.height);
    glGetTextureImage(texture.name(), 0, GL_RED, GL_FLOAT, GLsizei(values.size() * sizeof(float)), values.data());
    return values[0];
}

// A target with history: what a frame wrote is "@before" in the next, and nothing is before the first.
TEST_F(Graphics, HistoryIsTheFrameBefore) {
    FrameGraph graph;
    graph.add_target({.name = "sum", .format = GL_R32F, .history = true});
    graph.add_target({.name = "one", .format = GL_R32F, .width = 1, .height = 1, .history = true});
    float frame = 0;
    std::vector<std::pair<bool, float>> seen;
    graph.add_pass({"write",
                    {"sum@before"},
                    {"sum"},
                    [&](const PassContext& c) {
                        const bool known = c.graph.has_history("sum");
                        seen.emplace_back(known, known ? first_texel(c.graph.target("sum@before")) : -1);
                        glClearBufferfv(GL_COLOR, 0, std::array{++frame, 0.0f, 0.0f, 0.0f}.data());
                    },
                    ""});
    graph.add_pass({"read",
                    {"sum"},
                    {"one"},
                    [&](const PassContext& c) {
                        EXPECT_EQ(c.width, 1u);
                        EXPECT_EQ(first_texel(c.graph.target("sum")), frame); // of this frame
                    },
                    ""});
    ASSERT_TRUE(graph.compile());
    ASSERT_TRUE(graph.resize(8, 8));
    for (int i = 0; i < 4; ++i)
        graph.execute();
    ASSERT_TRUE(graph.resize(9, 8)); // other textures: what was before is gone
    EXPECT_FALSE(graph.has_history("sum"));
    for (int i = 0; i < 2; ++i)
        graph.execute();
    const std::vector<std::pair<bool, float>> wanted{{false, -1}, {true, 1},   {true, 2},
                                                     {true, 3},   {false, -1}, {true, 5}};
    EXPECT_EQ(seen, wanted);
    EXPECT_EQ(graph.target_bytes(), 2 * 9 * 8 * 4 + 2 * 4u);
    EXPECT_EQ(take_gl_error(), "");
    // Reading a past that is not kept is refused.
    FrameGraph without;
    without.add_target({.name = "a", .format = GL_R32F});
    without.add_target({.name = "b", .format = GL_R32F});
    without.add_pass(pass("one", {"a@before"}, {"b"}));
    EXPECT_NE(refusal(without).find("a@before"), std::string::npos);
}

// What a target held stays where its size and description do: through another size of the frame, and where passes are
// declared anew.
TEST_F(Graphics, TargetsThatStayAsTheyAreKeepWhatTheyHold) {
    FrameGraph graph;
    std::vector<float> before;
    const auto declare = [&](u32 format) {
        graph.clear();
        graph.add_target({.name = "one", .format = format, .width = 1, .height = 1, .history = true});
        graph.add_target({.name = "color", .format = GL_R32F});
        graph.add_pass({"count",
                        {"one@before"},
                        {"one"},
                        [&](const PassContext& c) {
                            before.push_back(c.graph.has_history("one") ? first_texel(c.graph.target("one@before"))
                                                                        : -1);
                            glClearBufferfv(GL_COLOR, 0, std::array{float(before.size()), 0.0f, 0.0f, 0.0f}.data());
                        },
                        ""});
        graph.add_pass({"draw", {"one"}, {"color"}, [](const PassContext&) {}, ""});
        ASSERT_TRUE(graph.compile());
    };
    declare(GL_R32F);
    for (u32 width : {8u, 8u, 9u}) {
        ASSERT_TRUE(graph.resize(width, 8));
        graph.execute();
    }
    declare(GL_R32F);
    graph.clear(); // twice in a row, and without a frame between: as once
    declare(GL_R32F);
    ASSERT_TRUE(graph.resize(9, 8));
    graph.execute();
    graph.execute();
    declare(GL_R16F); // another target of the same name
    ASSERT_TRUE(graph.resize(9, 8));
    graph.execute();
    EXPECT_EQ(before, (std::vector<float>{-1, 1, 2, 3, 4, -1}));
    EXPECT_EQ(take_gl_error(), "");
}

// Times come some frames later, for every pass in order, and never for passes of another list.
TEST_F(Graphics, PassesAreTimed) {
    FrameGraph graph;
    const auto declare = [&](u32 passes) {
        graph.clear();
        for (u32 i = 0; i < passes; ++i) {
            const std::string name = "p" + std::to_string(i);
            graph.add_target({.name = name, .format = GL_RGBA16F});
            graph.add_pass({name,
                            {},
                            {name},
                            [i](const PassContext&) {
                                for (u32 k = 0; k < 1 + 40 * i; ++k)
                                    glClearBufferfv(GL_COLOR, 0, std::array{0.5f, 0.0f, 0.0f, float(k)}.data());
                            },
                            ""});
        }
        ASSERT_TRUE(graph.compile());
        ASSERT_TRUE(graph.resize(256, 256));
    };
    declare(3);
    graph.execute();
    EXPECT_TRUE(graph.times_ms().empty()); // nobody asked
    graph.set_timing(true);
    for (int i = 0; i < 3; ++i) {
        graph.execute();
        glFinish();
    }
    graph.execute();
    ASSERT_EQ(graph.times_ms().size(), 3u);
    for (u32 i = 0; i < 3; ++i) {
        EXPECT_EQ(graph.times_ms()[i].first, "p" + std::to_string(i));
        EXPECT_GE(graph.times_ms()[i].second, 0.0);
        EXPECT_LT(graph.times_ms()[i].second, 60000.0);
    }
    declare(2);
    EXPECT_TRUE(graph.times_ms().empty());
    for (int i = 0; i < 3; ++i) {
        graph.execute();
        glFinish();
    }
    graph.execute();
    EXPECT_EQ(graph.times_ms().size(), 2u);
    graph.set_timing(false);
    EXPECT_TRUE(graph.times_ms().empty());
    EXPECT_EQ(take_gl_error(), "");
}

TEST_F(Graphics, UploadRingKeepsWhatItWasGiven) {
    UploadRing ring(512);
    Buffer out = make_buffer(4096, GL_DYNAMIC_STORAGE_BIT);
    for (u32 frame = 0; frame < 12; ++frame) {
        ring.begin_frame();
        for (u32 part = 0; part < 4; ++part) { // more than fits: it must grow
            const u32 bytes = 100 + frame * 60;
            const auto slice = ring.allocate(bytes, 256);
            EXPECT_EQ(slice.offset % 256, 0u);
            std::memset(slice.data, int(frame * 4 + part), bytes);
            glCopyNamedBufferSubData(slice.buffer, out.name(), GLintptr(slice.offset), part * 1024, bytes);
            u8 back = 0;
            glGetNamedBufferSubData(out.name(), part * 1024 + bytes - 1, 1, &back);
            EXPECT_EQ(back, frame * 4 + part);
        }
        ring.end_frame();
    }
    EXPECT_EQ(take_gl_error(), "");
}

TEST_F(Graphics, HandlesMoveAndFree) {
    Texture a = make_texture_2d(GL_RGBA8, 8, 8, 4);
    EXPECT_EQ(a.bytes(), (64 + 16 + 4 + 1) * 4u);
    const u32 name = a.name();
    Texture b = std::move(a);
    EXPECT_FALSE(a);
    EXPECT_EQ(b.name(), name);
    b.reset();
    EXPECT_FALSE(glIsTexture(name));
}

} // namespace vitrail::gfx
