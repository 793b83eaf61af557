// FrameGraph: the passes of a frame in order, each saying by name what it reads and writes; it owns the targets, makes
// them anew when the size changes, and refuses an order in which a pass reads what nobody wrote.
//
//     graph.add_target({"gbuffer.albedo", GL_RGBA8});
//     graph.add_pass({"terrain", {}, {"gbuffer.albedo", "gbuffer.depth"}, [&](const PassContext& c) { ... }});
//     VX_TRY(graph.compile());
//     graph.resize(width, height);
//     graph.execute();
//
// Rejected: a graph that finds its own order and aliases memory. A dozen passes in a written order are easier to read.
#pragma once

#include "base/result.h"
#include "gfx/handles.h"

#include <functional>
#include <string>
#include <unordered_map>
#include <vector>

namespace vitrail::gfx {

struct TargetDesc {
    std::string name;
    u32 format = 0;  // sized internal format
    u32 divisor = 1; // of the frame's size
};

class FrameGraph;

struct PassContext {
    const FrameGraph& graph;
    u32 width = 0, height = 0;
};

struct PassDesc {
    std::string name;
    std::vector<std::string> reads;              // sampled; must be written by an earlier pass or be external
    std::vector<std::string> writes;             // attached: colors in this order, a depth format as depth
    std::function<void(const PassContext&)> run; // called with the framebuffer bound and the viewport set
    // Depth attached for testing only (named in `reads` too, never written): name, or empty.
    std::string depth_test;
};

class FrameGraph {
public:
    void add_target(TargetDesc target);
    // Targets that someone else draws into or reads, e.g. "screen"; writing it leaves the framebuffer to the pass.
    void add_external(std::string name);
    void add_pass(PassDesc pass);
    // Errors: invalid_argument, naming the pass: unknown target, a read before any write, a name twice, a pass with no
    // output.
    Result<> compile() const;
    // Makes targets and framebuffers where the size is new. Errors: limit, where the driver gives no complete
    // framebuffer.
    Result<> resize(u32 width, u32 height);
    void execute() const;
    void clear();                                         // passes and targets
    const Texture& target(const std::string& name) const; // asserts that it exists
    u32 framebuffer(const std::string& pass) const;       // 0 where the pass writes an external target
    u64 target_bytes() const;
    std::vector<std::string> pass_names() const;

private:
    struct Target {
        TargetDesc desc;
        Texture texture;
        bool external = false;
    };
    struct Pass {
        PassDesc desc;
        Framebuffer framebuffer;
        u32 width = 0, height = 0;
    };
    std::unordered_map<std::string, Target> targets_;
    std::vector<Pass> passes_;
    u32 width_ = 0, height_ = 0;
};

} // namespace vitrail::gfx
