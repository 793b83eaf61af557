#include "gfx/frame_graph.h"

#include "base/assert.h"

#include <algorithm>
#include <bit>
#include <epoxy/gl.h>
#include <fmt/format.h>
#include <set>

namespace vitrail::gfx {

namespace {

constexpr std::string_view kBefore = "@before";

bool is_depth(u32 format) {
    return format == GL_DEPTH_COMPONENT32F || format == GL_DEPTH32F_STENCIL8 || format == GL_DEPTH_COMPONENT24 ||
           format == GL_DEPTH24_STENCIL8 || format == GL_DEPTH_COMPONENT16;
}

std::pair<u32, u32> size_of(const TargetDesc& d, u32 width, u32 height) {
    if (d.width) return {d.width, d.height};
    return {std::max((width + d.divisor - 1) / d.divisor, 1u), std::max((height + d.divisor - 1) / d.divisor, 1u)};
}

Texture make_target(const TargetDesc& d, u32 w, u32 h) {
    const u32 levels = d.mips ? u32(std::bit_width(std::max(w, h))) : 1;
    Texture made =
        d.layers ? make_texture_2d_array(d.format, w, h, d.layers, levels) : make_texture_2d(d.format, w, h, levels);
    if (d.linear) set_filter(made, d.mips ? GL_LINEAR_MIPMAP_LINEAR : GL_LINEAR, GL_LINEAR, GL_CLAMP_TO_EDGE);
    return made;
}

} // namespace

void FrameGraph::add_target(TargetDesc target) {
    Target& t = targets_[target.name];
    t = {};
    t.desc = std::move(target);
}

void FrameGraph::add_external(std::string name) {
    Target& t = targets_[name];
    t.desc.name = std::move(name);
    t.external = true;
}

void FrameGraph::add_pass(PassDesc pass) {
    passes_.push_back({std::move(pass), {}, 0, 0});
}

const FrameGraph::Target* FrameGraph::find(std::string_view name) const {
    const auto at = targets_.find(std::string(name));
    return at == targets_.end() ? nullptr : &at->second;
}

Result<> FrameGraph::compile() const {
    std::set<std::string> written, names;
    auto wrong = [](const PassDesc& pass, const std::string& what) {
        return fail(ErrorCode::invalid_argument, fmt::format("pass {}: {}", pass.name, what));
    };
    for (const auto& [name, target] : targets_) {
        if (target.external) written.insert(name);
        if (target.desc.history) written.insert(name + std::string(kBefore));
    }
    for (const Pass& p : passes_) {
        const PassDesc& pass = p.desc;
        if (!names.insert(pass.name).second) return wrong(pass, "a second pass of this name");
        if (pass.writes.empty()) return wrong(pass, "writes nothing");
        std::vector<std::string> reads = pass.reads;
        if (!pass.depth_test.empty()) reads.push_back(pass.depth_test);
        for (const std::string& name : reads) {
            if (written.contains(name)) continue;
            if (!targets_.contains(name)) return wrong(pass, "reads unknown target " + name);
            return wrong(pass, "reads " + name + " before anything wrote it");
        }
        std::pair<u32, u32> size{};
        for (const std::string& name : pass.writes) {
            const Target* target = find(name);
            if (!target) return wrong(pass, "writes unknown target " + name);
            if (target->external && pass.writes.size() > 1) return wrong(pass, "writes an external target and others");
            if (std::count(pass.writes.begin(), pass.writes.end(), name) > 1)
                return wrong(pass, "writes " + name + " twice");
            if (std::find(pass.reads.begin(), pass.reads.end(), name) != pass.reads.end())
                return wrong(pass, "samples " + name + " while it is attached");
            const TargetDesc& d = target->desc;
            const std::pair<u32, u32> own{d.width ? d.width : d.divisor, d.width ? d.height : d.screen ? ~0u : 0};
            if (size.first != 0 && size != own) return wrong(pass, "writes targets of different sizes");
            size = own;
            written.insert(name);
        }
    }
    return {};
}

Result<> FrameGraph::resize(u32 width, u32 height, u32 screen_width, u32 screen_height) {
    if (screen_width == 0) screen_width = width, screen_height = height;
    if (width == width_ && height == height_ && screen_width == screen_width_ && screen_height == screen_height_)
        return {};
    for (auto& [name, t] : targets_) {
        if (t.external) continue;
        const auto size = size_of(t.desc, t.desc.screen ? screen_width : width, t.desc.screen ? screen_height : height);
        const auto fits = [&](const Target& has) {
            return has.textures[0] && std::pair(has.textures[0].width, has.textures[0].height) == size;
        };
        if (fits(t)) continue;
        if (const auto old = cleared_.find(name);
            old != cleared_.end() && old->second.desc == t.desc && fits(old->second)) {
            t = std::move(old->second);
            continue;
        }
        t.frames = 0;
        for (u32 i = 0; i < (t.desc.history ? 2u : 1u); ++i)
            t.textures[i] = make_target(t.desc, size.first, size.second);
    }
    cleared_.clear();
    for (Pass& pass : passes_) {
        pass.width = screen_width, pass.height = screen_height; // of external targets
        bool own_framebuffer = true, history = false;
        for (const std::string& name : pass.desc.writes) {
            const Target& t = targets_.at(name);
            own_framebuffer = own_framebuffer && !t.external && !t.desc.layers;
            history = history || t.desc.history;
            if (!t.external) pass.width = t.textures[0].width, pass.height = t.textures[0].height;
        }
        pass.framebuffers = {};
        if (!own_framebuffer) continue;
        for (u32 parity = 0; parity < (history ? 2u : 1u); ++parity) {
            std::vector<const Texture*> colors;
            const Texture* depth = pass.desc.depth_test.empty() ? nullptr : &target(pass.desc.depth_test);
            for (const std::string& name : pass.desc.writes) {
                const Target& t = targets_.at(name);
                const Texture* texture = &t.textures[t.desc.history ? parity : 0];
                if (is_depth(t.desc.format))
                    depth = texture;
                else
                    colors.push_back(texture);
            }
            pass.framebuffers[parity] = make_framebuffer(colors, depth);
            if (glCheckNamedFramebufferStatus(pass.framebuffers[parity].name(), GL_FRAMEBUFFER) !=
                GL_FRAMEBUFFER_COMPLETE)
                return fail(ErrorCode::limit,
                            fmt::format("no framebuffer of {}x{} for pass {}", width, height, pass.desc.name));
        }
    }
    width_ = width, height_ = height, screen_width_ = screen_width, screen_height_ = screen_height;
    return {};
}

void FrameGraph::execute() {
    TimedFrame* timed = nullptr;
    if (timing_) {
        collect_times();
        timed = &timed_[next_timed_];
        if (timed->running)
            timed = nullptr; // its answers are not here yet: this frame is not timed
        else
            next_timed_ = (next_timed_ + 1) % kTimedFrames;
    }
    if (timed) {
        while (timed->stamps.size() < passes_.size() + 1)
            timed->stamps.push_back(make_query(GL_TIMESTAMP));
        glQueryCounter(timed->stamps[0].name(), GL_TIMESTAMP);
    }
    for (std::size_t i = 0; i < passes_.size(); ++i) {
        const Pass& pass = passes_[i];
        const u32 name = framebuffer(pass.desc.name);
        if (name) glBindFramebuffer(GL_FRAMEBUFFER, name);
        glViewport(0, 0, GLsizei(pass.width), GLsizei(pass.height));
        pass.desc.run({*this, pass.width, pass.height});
        if (timed) glQueryCounter(timed->stamps[i + 1].name(), GL_TIMESTAMP);
    }
    if (timed) timed->running = true;
    parity_ ^= 1;
    for (auto& [name, t] : targets_)
        ++t.frames;
}

void FrameGraph::set_timing(bool on) {
    if (on == timing_) return;
    timing_ = on;
    timed_ = {};
    next_timed_ = 0;
    times_ms_.clear();
}

void FrameGraph::collect_times() {
    // Oldest first, so that the newest answer stays.
    for (u32 k = 0; k < kTimedFrames; ++k) {
        TimedFrame& timed = timed_[(next_timed_ + k) % kTimedFrames];
        if (!timed.running || timed.stamps.size() < passes_.size() + 1) continue;
        GLint here = 0;
        glGetQueryObjectiv(timed.stamps[passes_.size()].name(), GL_QUERY_RESULT_AVAILABLE, &here);
        if (!here) continue;
        times_ms_.clear();
        GLuint64 last = 0;
        glGetQueryObjectui64v(timed.stamps[0].name(), GL_QUERY_RESULT, &last);
        for (std::size_t i = 0; i < passes_.size(); ++i) {
            GLuint64 now = 0;
            glGetQueryObjectui64v(timed.stamps[i + 1].name(), GL_QUERY_RESULT, &now);
            times_ms_.emplace_back(passes_[i].desc.name, now > last ? double(now - last) * 1e-6 : 0.0);
            last = now;
        }
        timed.running = false;
    }
}

void FrameGraph::clear() {
    passes_.clear();
    for (auto& [name, t] : targets_)
        if (t.textures[0]) cleared_[name] = std::move(t);
    targets_.clear();
    timed_ = {};
    next_timed_ = 0;
    times_ms_.clear();
    width_ = height_ = screen_width_ = screen_height_ = 0;
}

bool FrameGraph::has_target(std::string_view name) const {
    const Target* t = find(name);
    return t && !t->external;
}

const Texture& FrameGraph::target(const std::string& name) const {
    const bool before = name.ends_with(kBefore);
    const Target* t = find(before ? std::string_view(name).substr(0, name.size() - kBefore.size()) : name);
    VX_ASSERT(t && !t->external && (!before || t->desc.history));
    return t->textures[t->desc.history ? parity_ ^ u32(before) : 0];
}

bool FrameGraph::has_history(const std::string& name) const {
    const Target* t = find(name);
    return t && t->desc.history && t->frames > 0;
}

u32 FrameGraph::framebuffer(const std::string& pass) const {
    for (const Pass& p : passes_)
        if (p.desc.name == pass) return p.framebuffers[p.framebuffers[1] ? parity_ : 0].name();
    return 0;
}

u64 FrameGraph::target_bytes() const {
    u64 sum = 0;
    for (const auto& [name, t] : targets_)
        if (!t.external) sum += t.textures[0].bytes() + t.textures[1].bytes();
    return sum;
}

std::vector<std::string> FrameGraph::pass_names() const {
    std::vector<std::string> names;
    for (const Pass& p : passes_)
        names.push_back(p.desc.name);
    return names;
}

} // namespace vitrail::gfx
