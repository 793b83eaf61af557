#include "gfx/frame_graph.h"

#include "base/assert.h"

#include <algorithm>
#include <epoxy/gl.h>
#include <fmt/format.h>
#include <set>

namespace vitrail::gfx {

static bool is_depth(u32 format) {
    return format == GL_DEPTH_COMPONENT32F || format == GL_DEPTH32F_STENCIL8 || format == GL_DEPTH_COMPONENT24 ||
           format == GL_DEPTH24_STENCIL8;
}

void FrameGraph::add_target(TargetDesc target) {
    Target& t = targets_[target.name];
    t.desc = std::move(target);
    t.external = false;
}

void FrameGraph::add_external(std::string name) {
    Target& t = targets_[name];
    t.desc.name = std::move(name);
    t.external = true;
}

void FrameGraph::add_pass(PassDesc pass) {
    passes_.push_back({std::move(pass), {}, 0, 0});
}

Result<> FrameGraph::compile() const {
    std::set<std::string> written, names;
    auto wrong = [](const PassDesc& pass, const std::string& what) {
        return fail(ErrorCode::invalid_argument, fmt::format("pass {}: {}", pass.name, what));
    };
    for (const auto& [name, target] : targets_)
        if (target.external) written.insert(name);
    for (const Pass& p : passes_) {
        const PassDesc& pass = p.desc;
        if (!names.insert(pass.name).second) return wrong(pass, "a second pass of this name");
        if (pass.writes.empty()) return wrong(pass, "writes nothing");
        std::vector<std::string> reads = pass.reads;
        if (!pass.depth_test.empty()) reads.push_back(pass.depth_test);
        for (const std::string& name : reads) {
            if (!targets_.contains(name)) return wrong(pass, "reads unknown target " + name);
            if (!written.contains(name)) return wrong(pass, "reads " + name + " before anything wrote it");
        }
        u32 divisor = 0;
        for (const std::string& name : pass.writes) {
            const auto target = targets_.find(name);
            if (target == targets_.end()) return wrong(pass, "writes unknown target " + name);
            if (target->second.external && pass.writes.size() > 1)
                return wrong(pass, "writes an external target and others");
            if (std::count(pass.writes.begin(), pass.writes.end(), name) > 1)
                return wrong(pass, "writes " + name + " twice");
            if (std::find(pass.reads.begin(), pass.reads.end(), name) != pass.reads.end())
                return wrong(pass, "samples " + name + " while it is attached");
            if (divisor != 0 && divisor != target->second.desc.divisor)
                return wrong(pass, "writes targets of different sizes");
            divisor = target->second.desc.divisor;
            written.insert(name);
        }
    }
    return {};
}

Result<> FrameGraph::resize(u32 width, u32 height) {
    if (width == width_ && height == height_) return {};
    for (auto& [name, t] : targets_) {
        if (t.external) continue;
        const u32 d = t.desc.divisor;
        t.texture =
            make_texture_2d(t.desc.format, std::max((width + d - 1) / d, 1u), std::max((height + d - 1) / d, 1u));
    }
    for (Pass& pass : passes_) {
        std::vector<const Texture*> colors;
        const Texture* depth = pass.desc.depth_test.empty() ? nullptr : &target(pass.desc.depth_test);
        pass.width = width, pass.height = height;
        bool external = false;
        for (const std::string& name : pass.desc.writes) {
            const Target& t = targets_.at(name);
            if (t.external) {
                external = true;
                continue;
            }
            pass.width = t.texture.width, pass.height = t.texture.height;
            if (is_depth(t.desc.format))
                depth = &t.texture;
            else
                colors.push_back(&t.texture);
        }
        if (external) continue;
        pass.framebuffer = make_framebuffer(colors, depth);
        if (glCheckNamedFramebufferStatus(pass.framebuffer.name(), GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
            return fail(ErrorCode::limit,
                        fmt::format("no framebuffer of {}x{} for pass {}", width, height, pass.desc.name));
    }
    width_ = width, height_ = height;
    return {};
}

void FrameGraph::execute() const {
    for (const Pass& pass : passes_) {
        if (pass.framebuffer) glBindFramebuffer(GL_FRAMEBUFFER, pass.framebuffer.name());
        glViewport(0, 0, GLsizei(pass.width), GLsizei(pass.height));
        pass.desc.run({*this, pass.width, pass.height});
    }
}

void FrameGraph::clear() {
    passes_.clear();
    targets_.clear();
    width_ = height_ = 0;
}

const Texture& FrameGraph::target(const std::string& name) const {
    const auto at = targets_.find(name);
    VX_ASSERT(at != targets_.end() && !at->second.external);
    return at->second.texture;
}

u32 FrameGraph::framebuffer(const std::string& pass) const {
    for (const Pass& p : passes_)
        if (p.desc.name == pass) return p.framebuffer.name();
    return 0;
}

u64 FrameGraph::target_bytes() const {
    u64 sum = 0;
    for (const auto& [name, t] : targets_)
        if (!t.external) sum += t.texture.bytes();
    return sum;
}

std::vector<std::string> FrameGraph::pass_names() const {
    std::vector<std::string> names;
    for (const Pass& p : passes_)
        names.push_back(p.desc.name);
    return names;
}

} // namespace vitrail::gfx
