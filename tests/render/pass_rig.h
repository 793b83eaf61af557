// Runs passes alone, on pictures that a test makes: a source pass fills "color" (and the G-buffer), then the
// passes under test as the renderer would declare them.
#pragma once

#include "gfx/frame_graph.h"
#include "render/passes/pass.h"
#include "render_fixture.h"

#include <cmath>
#include <cstring>
#include <epoxy/gl.h>

namespace vitrail::render {

// Linear RGB, rows from the top.
struct Picture {
    u32 width = 0, height = 0;
    std::vector<Vec3> pixels;
    Picture(u32 w, u32 h, Vec3 all = {})
        : width(w)
        , height(h)
        , pixels(std::size_t(w) * h, all) {}
    Vec3& at(u32 x, u32 y) { return pixels[std::size_t(y) * width + x]; }
    const Vec3& at(u32 x, u32 y) const { return pixels[std::size_t(y) * width + x]; }
    Vec3 sum() const {
        double s[3] = {};
        for (const Vec3& p : pixels)
            s[0] += double(p.x), s[1] += double(p.y), s[2] += double(p.z);
        return {float(s[0]), float(s[1]), float(s[2])};
    }
};

class PassRig {
public:
    PassRig(const Effects& effects, std::vector<std::unique_ptr<RenderPass>> passes, std::string shader_folder = {})
        : shaders_(std::move(shader_folder))
        , effects_(effects)
        , passes_(std::move(passes)) {
        context_ = *gfx::context_info();
        plain_ = gfx::make_vertex_array();
        Vec4 clear_air[1 + kViewsMost] = {}; // common/mist.glsl
        clear_air[0].z = 1;
        mist_ = gfx::make_buffer(sizeof clear_air, 0, clear_air);
        for (const auto& pass : passes_) {
            const Result<> built = pass->build({shaders_, effects_, context_});
            EXPECT_TRUE(built) << built.error().message;
        }
        graph_.add_target({.name = "color", .format = GL_RGBA16F, .linear = true});
        graph_.add_target({.name = "depth", .format = GL_DEPTH_COMPONENT32F});
        graph_.add_target({.name = "surface", .format = GL_RGBA8UI});
        graph_.add_target({.name = "albedo", .format = GL_RGBA8});
        graph_.add_target({.name = "light", .format = GL_RGBA8});
        graph_.add_external("screen");
        graph_.add_pass({"source",
                         {},
                         {"color", "albedo", "light", "surface", "depth"},
                         [this](const gfx::PassContext&) { fill(); },
                         ""});
        DeclareContext declaring{graph_, effects_, false};
        for (const auto& pass : passes_)
            pass->declare(declaring);
        const Result<> compiled = graph_.compile();
        EXPECT_TRUE(compiled) << compiled.error().message;
        frame_.continues = false;
    }

    using Source = std::function<Picture(const FrameUniforms& uniforms)>;

    void draw(const Picture& color, const scene::FrameView& frame, float seconds_since) {
        draw([&](const FrameUniforms&) { return color; }, frame, seconds_since);
    }
    // One frame: `source` makes the picture so far, with the view as the passes shifted it. Depth stays as last set.
    void draw(const Source& source, const scene::FrameView& frame, float seconds_since) {
        ASSERT_TRUE(graph_.resize(frame.width, frame.height));
        if (screen_.width != frame.width || screen_.height != frame.height) {
            screen_ = gfx::make_texture_2d(GL_RGBA8, frame.width, frame.height);
            const gfx::Texture* attached[] = {&screen_};
            screen_framebuffer_ = gfx::make_framebuffer(attached, nullptr);
        }
        frame_.frame = &frame;
        frame_.effects = &effects_;
        frame_.context = &context_;
        frame_.seconds_since = seconds_since;
        frame_.plain_array = plain_.name();
        frame_.target_framebuffer = screen_framebuffer_.name();
        frame_.jitter = {};
        for (const auto& pass : passes_)
            pass->begin(frame_);
        frame_.uniforms =
            make_frame_uniforms(frame, frame_.jitter, frame_.continues ? before_ : PreviousViews{}, false, {});
        for (const auto& pass : passes_)
            pass->prepare(frame_);
        const Picture color = source(frame_.uniforms);
        ASSERT_EQ(color.width, frame.width);
        ASSERT_EQ(color.height, frame.height);
        color_ = &color;
        uniforms_ = gfx::make_buffer(sizeof frame_.uniforms, 0, &frame_.uniforms);
        glBindBufferBase(GL_UNIFORM_BUFFER, 0, uniforms_.name());
        glBindBufferBase(GL_UNIFORM_BUFFER, 2, mist_.name());
        glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
        graph_.execute();
        before_ = {frame.views, frame.width, frame.height};
        frame_.continues = true;
        ++frame_.number;
    }

    // RGB of a target after the last frame.
    Picture read(const std::string& name) const {
        const gfx::Texture& t = graph_.target(graph_.has_history(name) ? name + "@before" : name);
        return read_texture(t);
    }
    Picture screen() const { return read_texture(screen_); }
    void forget() {
        before_ = {};
        frame_.continues = false;
        for (const auto& pass : passes_)
            pass->forget();
    }

    std::vector<float> depth;                // reversed, by pixel, rows from the top; empty: nothing but sky
    std::vector<u8> views;                   // numbers by pixel; empty: 0
    std::vector<std::array<u8, 4>> surfaces; // the G-buffer's by pixel, before `views`; empty: 0

private:
    static Picture read_texture(const gfx::Texture& t) {
        Picture out(t.width, t.height);
        std::vector<float> values(std::size_t(t.width) * t.height * 4);
        glGetTextureImage(t.name(), 0, GL_RGBA, GL_FLOAT, GLsizei(values.size() * sizeof(float)), values.data());
        for (u32 y = 0; y < t.height; ++y)
            for (u32 x = 0; x < t.width; ++x) {
                const float* p = &values[(std::size_t(t.height - 1 - y) * t.width + x) * 4];
                out.at(x, y) = {p[0], p[1], p[2]};
            }
        return out;
    }
    void fill() {
        const u32 w = color_->width, h = color_->height;
        std::vector<float> rgb(std::size_t(w) * h * 4), z(std::size_t(w) * h, 0.0f);
        std::vector<u8> surface(std::size_t(w) * h * 4, 0);
        for (u32 y = 0; y < h; ++y)
            for (u32 x = 0; x < w; ++x) {
                const std::size_t to = std::size_t(h - 1 - y) * w + x, from = std::size_t(y) * w + x;
                const Vec3& c = color_->pixels[from];
                rgb[to * 4] = c.x, rgb[to * 4 + 1] = c.y, rgb[to * 4 + 2] = c.z, rgb[to * 4 + 3] = 1;
                if (!depth.empty()) z[to] = depth[from];
                if (!surfaces.empty()) std::copy(surfaces[from].begin(), surfaces[from].end(), &surface[to * 4]);
                if (!views.empty()) surface[to * 4 + 2] = u8((surface[to * 4 + 2] & ~7) | views[from]);
            }
        const auto put = [&](const char* name, u32 format, u32 type, const void* data) {
            glTextureSubImage2D(graph_.target(name).name(), 0, 0, 0, GLsizei(w), GLsizei(h), format, type, data);
        };
        const u8 white[4] = {255, 255, 255, 255}, dark[4] = {}; // surfaces without any light
        glClearTexImage(graph_.target("albedo").name(), 0, GL_RGBA, GL_UNSIGNED_BYTE, white);
        glClearTexImage(graph_.target("light").name(), 0, GL_RGBA, GL_UNSIGNED_BYTE, dark);
        put("color", GL_RGBA, GL_FLOAT, rgb.data());
        put("depth", GL_DEPTH_COMPONENT, GL_FLOAT, z.data());
        put("surface", GL_RGBA_INTEGER, GL_UNSIGNED_BYTE, surface.data());
    }

    ShaderLibrary shaders_;
    Effects effects_;
    std::vector<std::unique_ptr<RenderPass>> passes_;
    gfx::ContextInfo context_;
    gfx::VertexArray plain_;
    gfx::FrameGraph graph_;
    gfx::Texture screen_;
    gfx::Framebuffer screen_framebuffer_;
    gfx::Buffer mist_, uniforms_;
    FrameContext frame_;
    PreviousViews before_;
    const Picture* color_ = nullptr;
};

template <class... Passes>
std::vector<std::unique_ptr<RenderPass>> passes_of() {
    std::vector<std::unique_ptr<RenderPass>> list;
    (list.push_back(std::make_unique<Passes>()), ...);
    return list;
}

} // namespace vitrail::render
