// One still picture of a world: server, replica, mesher and renderer as in the game, without a window. Used by
// `vitrail render`, by the frame benchmarks and by tests.
#pragma once

#include "client/frame_builder.h"
#include "client/local_game.h"
#include "client/section_feeder.h"
#include "client/trace_feeder.h"
#include "platform/headless.h"

#include <atomic>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace vitrail::client {

struct StillOptions {
    std::string world; // folder, opened read-only; empty: a world of `seed` that is kept nowhere
    u64 seed = 1;
    std::string dimension; // name; empty: the world's spawn dimension
    CameraPose pose;
    u32 view_distance = 12; // chunks
    render::Effects effects = render::preset_effects(render::Preset::high);
    std::string shader_folder;               // see render::RendererOptions
    std::vector<std::string> packs;          // resource packs, the later over the earlier
    std::optional<trace::Device> trace;      // pictures are traced, on this device; else rasterized
    u32 trace_devices = 1;                   // CUDA: split over so many at most
    bool trace_stages = false;               // see trace::TracerOptions
    double seconds_most = 600;               // for the world to arrive
    const std::atomic<bool>* stop = nullptr; // where it turns true, opening ends with an error
};

struct StillTimes {
    double open_s = 0, world_s = 0, mesh_s = 0; // until joined; until all sections are here; until all are drawn
};

class Still {
public:
    // Opens the world and waits until everything the eye could see is meshed and on the GPU. Errors: no OpenGL, the
    // world's, limit.
    static Result<std::unique_ptr<Still>> open(const StillOptions& options, const Content& content);
    ~Still();
    // time: 0..24000. The pose may turn and move within the view distance. As many frames as the effects need to settle
    // (render::settling_frames).
    Result<render::Image> draw(const CameraPose& pose, u32 width, u32 height, float time);
    // As if the eye had been there for a while: earlier frames are forgotten, and what builds up over frames (exposure,
    // antialiasing, answers to occlusion queries) has `frames` of them at one moment of animation.
    Result<render::Image> draw_settled(const CameraPose& pose, u32 width, u32 height, float time, u32 frames = 8);
    // The frame after the last one: nothing is forgotten, one frame is drawn. For films.
    Result<render::Image> draw_next(const CameraPose& pose, u32 width, u32 height, float time);
    // Without reading pixels back; finishes drawing. For timing.
    Result<> draw_only(const CameraPose& pose, u32 width, u32 height, float time);
    // GPU milliseconds by pass, in the passes' order; the least of a few frames, drawn for it.
    Result<std::vector<std::pair<std::string, double>>> time_passes(const CameraPose& pose, u32 width, u32 height,
                                                                    float time);

    // The path tracer, where it was asked for: one more frame of samples, and the picture so far as the eye shows it.
    Result<> trace(const CameraPose& pose, u32 width, u32 height, float time, const trace::TraceSettings& settings);
    // settled false: the eye grows used to light as it does while playing.
    Result<render::Image> develop(const CameraPose& pose, u32 width, u32 height, float time, bool settled = true);
    // Waits until the world around another place is here too. Nothing is done where the eye stays in its section.
    // Errors: as of open.
    Result<> go_to(const CameraPose& pose);
    // Seconds of animation, from 0 on: waves, clouds, pictures that move.
    void set_seconds(float seconds) { seconds_ = seconds; }
    bool traces() const { return tracer_ != nullptr; }
    trace::Tracer& tracer() { return *tracer_; }
    render::Renderer& renderer() { return *renderer_; }
    const scene::PackLooks* packs() const { return packs_.get(); } // null without
    SectionFeeder& feeder() { return *feeder_; }
    replica::Replica& replica() { return game_->replica(); }
    server::Server& server() { return game_->server(); }
    const StillTimes& times() const { return times_; }

private:
    Still() = default;
    Result<> wait_complete();
    scene::FrameView frame_at(const CameraPose& pose, u32 width, u32 height, float time);
    std::unique_ptr<platform::HeadlessContext> context_;
    std::string scratch_folder_; // of a world kept nowhere, removed at the end
    std::unique_ptr<LocalGame> game_;
    std::unique_ptr<ThreadPool> pool_;
    std::unique_ptr<render::Renderer> renderer_;
    std::unique_ptr<SectionFeeder> feeder_;
    std::unique_ptr<trace::Tracer> tracer_;
    std::unique_ptr<TraceFeeder> trace_feeder_;
    gfx::Texture film_;
    std::shared_ptr<const scene::PackLooks> packs_;
    StillOptions options_;
    float seconds_ = 40; // some moment
    StillTimes times_;
};

} // namespace vitrail::client
