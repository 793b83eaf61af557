// TracedView: the path tracer in the game. Made at first use; from then on it hears of every change of the world, shown
// or not, so that going over to it takes one frame. Pictures are as large as the frame rate lets them be.
//
//     VX_TRY_ASSIGN(auto view, TracedView::open(options));
//     each frame, after sections.update: view->feed(eye, budget_ms);
//     VX_TRY(view->draw(frame, ...)), then renderer.render(frame) shows the picture; view->hide(renderer) ends it
#pragma once

#include "client/trace_feeder.h"
#include "client/trace_options.h"
#include "render/renderer.h"
#include "scene/resolution.h"

#include <array>
#include <memory>
#include <optional>
#include <string>

namespace vitrail::client {

// Which device is meant by "cpu", "cuda" or "auto". Errors: invalid_argument.
Result<trace::Device> trace_device_named(const std::string& name);

class TracedView {
public:
    struct Parts {
        trace::Device device = trace::Device::cpu;
        u32 devices_most = 1;
        ThreadPool& pool;
        SectionFeeder& sections;
        replica::Replica& replica;
        std::shared_ptr<const BlockRegistry> registry;
        std::shared_ptr<const scene::PackLooks> packs; // or null
    };
    // The pictures of blocks are read by a worker; until they are, `ready` is false. Errors: the tracer's.
    static Result<std::unique_ptr<TracedView>> open(const Parts& parts);
    ~TracedView(); // before what it was opened with
    TracedView(const TracedView&) = delete;
    TracedView& operator=(const TracedView&) = delete;

    bool ready() const { return !pictures_; }
    // Other packs; after SectionFeeder::set_packs.
    void set_packs(std::shared_ptr<const scene::PackLooks> packs);
    // Takes in the pictures once they are read, then chunks, nearest to the eye first, for about budget_ms. Errors: the
    // tracer's.
    Result<> feed(BlockPos eye, double budget_ms);
    // Traces `frame` at the size that its frame rate allows, sets frame.resolution to that and gives the picture to the
    // renderer. last_frame_ms: what the last frame took in all, not above 0: not known. Errors: the tracer's.
    Result<> draw(scene::FrameView& frame, const TraceOptions& options, const render::Effects& effects,
                  float last_frame_ms, render::Renderer& renderer);
    void hide(render::Renderer& renderer);

    trace::Device device() const { return tracer_->device(); } // cpu or cuda
    const trace::TracerStats& stats() const { return tracer_->stats(); }
    float share() const { return share_; } // of width and height that was traced
    std::size_t waiting() const { return feeder_->waiting(); }

private:
    explicit TracedView(const Parts& parts)
        : parts_(parts) {}
    struct Seen {
        Located<WorldPos> eye;
        std::array<float, 16> rotation{};
        float fov = 0, time = 0;
        u32 width = 0, height = 0;
        bool operator==(const Seen&) const = default;
    };
    bool same_view(const scene::FrameView& frame);
    float choose_share(const TraceOptions& options, const render::Effects& effects, float last_frame_ms);

    struct Pictures; // being read
    Parts parts_;
    std::unique_ptr<trace::Tracer> tracer_;
    std::unique_ptr<TraceFeeder> feeder_;
    std::shared_ptr<Pictures> pictures_;
    scene::ResolutionControl resolution_;
    gfx::Texture film_;
    float share_ = 1;
    float traced_ms_ = 0;           // of the last picture, at share_
    std::optional<float> most_now_; // what share_ may be at most, learned from that
    Seen seen_;
    u32 resting_frames_ = 0;
    std::optional<float> rest_share_; // while the view rests
    bool shown_ = false;
    std::size_t chunks_a_frame_; // as many as the tracer takes in within the budget
};

} // namespace vitrail::client
