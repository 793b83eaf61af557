// FrameGraph: the passes of a frame in order, each saying by name what it reads and writes; it owns the targets, makes
// them anew when the size changes, refuses an order in which a pass reads what nobody wrote, and times every pass on
// the GPU.
//
//     graph.add_target({.name = "albedo", .format = GL_RGBA8});
//     graph.add_pass({"terrain", {}, {"albedo", "depth"}, [&](const PassContext& c) { ... }});
//     VX_TRY(graph.compile());
//     graph.resize(width, height);
//     graph.execute();
//
// A target with history is two textures that change places after each frame: passes write the one of this frame and may
// read "NAME@before", what was written in the frame before (`has_history` says whether there is any).
//
// Rejected: a graph that finds its own order and aliases memory. A dozen passes in a written order are easier to read.
#pragma once

#include "base/result.h"
#include "gfx/handles.h"

#include <array>
#include <functional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

namespace vitrail::gfx {

struct TargetDesc {
    std::string name;
    u32 format = 0;            // sized internal format
    u32 divisor = 1;           // of the frame's size; without meaning where width is set
    u32 width = 0, height = 0; // of its own, whatever the frame's size (0: follows the frame)
    u32 layers = 0;            // above 0: a 2-D array; its passes attach layers themselves (no framebuffer is made)
    bool screen = false;       // as large as the screen where that is not the frame's size (resize)
    bool history = false;
    bool linear = false; // filtered when sampled; always clamped to the edge
    bool mips = false;   // has all smaller levels too; passes draw into the largest and fill the others
    bool operator==(const TargetDesc&) const = default;
};

class FrameGraph;

struct PassContext {
    const FrameGraph& graph;
    u32 width = 0, height = 0;
};

struct PassDesc {
    std::string name;
    std::vector<std::string> reads;              // sampled; written by an earlier pass, external, or "NAME@before"
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
    // Makes targets and framebuffers where the size is new; targets whose size stays keep what they hold, those of a
    // graph that was cleared and declared anew too, where they are declared alike. screen_width, screen_height: of
    // external targets and those with `screen`; 0: the frame's. Errors: limit, where the driver gives no complete
    // framebuffer.
    Result<> resize(u32 width, u32 height, u32 screen_width = 0, u32 screen_height = 0);
    // Runs the passes; afterwards targets with history change places.
    void execute();
    void clear();                                         // passes and targets
    bool has_target(std::string_view name) const;         // made by this graph
    const Texture& target(const std::string& name) const; // asserts that it exists; "NAME@before" too
    bool has_history(const std::string& name) const;      // a frame of this size has written it
    u32 framebuffer(const std::string& pass) const;       // 0 where the pass writes an external or layered target
    u64 target_bytes() const;
    std::vector<std::string> pass_names() const;

    // GPU time a pass by timer queries, read some frames later and never waited for.
    void set_timing(bool on);
    // (pass, milliseconds), of the newest frame whose answers are all here; empty until then.
    const std::vector<std::pair<std::string, double>>& times_ms() const { return times_ms_; }

private:
    static constexpr u32 kTimedFrames = 4; // under way at once
    struct Target {
        TargetDesc desc;
        std::array<Texture, 2> textures; // the second: of history
        bool external = false;
        u32 frames = 0; // executed since it was made
    };
    struct Pass {
        PassDesc desc;
        std::array<Framebuffer, 2> framebuffers; // by parity
        u32 width = 0, height = 0;
    };
    struct TimedFrame {
        std::vector<Query> stamps; // passes + 1
        bool running = false;
    };
    const Target* find(std::string_view name) const;
    void collect_times();
    std::unordered_map<std::string, Target> targets_, cleared_; // the second: kept from clear() to resize()
    std::vector<Pass> passes_;
    u32 width_ = 0, height_ = 0, screen_width_ = 0, screen_height_ = 0, parity_ = 0;
    bool timing_ = false;
    std::array<TimedFrame, kTimedFrames> timed_;
    u32 next_timed_ = 0;
    std::vector<std::pair<std::string, double>> times_ms_;
};

} // namespace vitrail::gfx
