#include "client/still.h"

#include "base/clock.h"
#include "client/packs.h"

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <epoxy/gl.h>
#include <filesystem>
#include <fmt/format.h>
#include <thread>

namespace vitrail::client {

namespace fs = std::filesystem;

static Result<std::string> make_scratch_folder() {
    std::error_code error;
    std::string pattern = (fs::temp_directory_path(error) / "vitrail-world-XXXXXX").string();
    if (error || !mkdtemp(pattern.data())) return fail(ErrorCode::io, "no folder for a passing world: the temporary folder cannot be written");
    return pattern;
}

Result<std::unique_ptr<Still>> Still::open(const StillOptions& options, const Content& content) {
    const u64 start = now_ns();
    std::unique_ptr<Still> still(new Still);
    still->options_ = options;
    VX_TRY_ASSIGN(still->packs_, open_packs(options.packs, *content.registry));
    VX_TRY_ASSIGN(still->context_, platform::HeadlessContext::create());
    LocalGameOptions local;
    if (options.world.empty()) {
        VX_TRY_ASSIGN(still->scratch_folder_, make_scratch_folder());
        local.server.folder = still->scratch_folder_;
        local.server.seed = options.seed;
    } else {
        local.server.folder = options.world;
        local.server.create = false;
        local.server.read_only = true;
    }
    local.server.threads = default_worker_count();
    local.server.view_distance_most = 32;
    local.server.generation_us_a_second = 0; // nobody waits for a frame here
    local.server.bytes_a_tick_most = 16u << 20;
    local.server.bytes_in_flight_most = 64u << 20;
    local.server.start = server::StartPlace{options.dimension, options.pose.eye.at};
    local.replica.name = "camera";
    local.replica.view_distance = options.view_distance;
    VX_TRY_ASSIGN(still->game_, LocalGame::open(local, content));
    VX_TRY(still->game_->wait_joined(60));
    VX_TRY_ASSIGN(still->renderer_, render::Renderer::create({.effects = options.effects, .shader_folder = options.shader_folder}));
    VX_TRY(still->renderer_->load_textures(*content.registry, still->packs_.get()));
    still->pool_ = std::make_unique<ThreadPool>(default_worker_count());
    still->feeder_ = std::make_unique<SectionFeeder>(*still->renderer_, *still->pool_, still->packs_);
    if (options.trace) {
        trace::TracerOptions tracer;
        tracer.device = *options.trace;
        tracer.devices_most = options.trace_devices;
        tracer.stages = options.trace_stages;
        tracer.pool = still->pool_.get();
        VX_TRY_ASSIGN(still->tracer_, trace::Tracer::create(tracer));
        still->trace_feeder_ = std::make_unique<TraceFeeder>(*still->tracer_);
        still->trace_feeder_->set_packs(*content.registry, still->packs_.get());
        still->feeder_->set_meshing(false);
        still->feeder_->on_dirty([feeder = still->trace_feeder_.get()](const replica::DirtySection& d) { feeder->mark(d); });
    }
    still->times_.open_s = seconds_since(start);
    VX_TRY(still->wait_complete());
    return still;
}

Still::~Still() {
    feeder_.reset();
    trace_feeder_.reset();
    tracer_.reset();
    game_.reset();
    renderer_.reset();
    if (!scratch_folder_.empty()) {
        std::error_code ignored;
        fs::remove_all(scratch_folder_, ignored);
    }
}

Result<> Still::wait_complete() {
    const StillOptions& options = options_;
    const u64 start = now_ns();
    replica::Replica& replica = game_->replica();
    const BlockPos eye = block_of(options.pose.eye.at);
    bool all_here = false;
    for (;;) {
        // Asked before polling: what the server had sent by then is in the queue that we poll next.
        const bool idle = game_->server().stats().idle;
        if (!replica.poll()) return fail(ErrorCode::denied, fmt::format("the server ended the session: {}", replica.lost_reason()));
        if (!all_here && idle) {
            all_here = true;
            times_.world_s = seconds_since(start);
        }
        if (all_here) feeder_->update(replica, eye, 1e9); // meshed once, with all neighbors here
        if (all_here && trace_feeder_) VX_TRY(trace_feeder_->update(replica, *feeder_, eye, 1e9));
        if (all_here && feeder_->settled() && game_->server().stats().idle) break;
        if (options.stop && *options.stop) return fail(ErrorCode::denied, "interrupted");
        if (seconds_since(start) > options.seconds_most)
            return fail(ErrorCode::limit, fmt::format("the world did not arrive within {} s", options.seconds_most));
        std::this_thread::sleep_for(std::chrono::microseconds(500));
    }
    times_.mesh_s = seconds_since(start) - times_.world_s;
    return {};
}

Result<> Still::go_to(const CameraPose& pose) {
    const bool stays = chunk_of(block_of(pose.eye.at)) == chunk_of(block_of(options_.pose.eye.at));
    options_.pose = pose;
    if (stays) return {};
    game_->server().put_everybody({options_.dimension, pose.eye.at});
    return wait_complete();
}

scene::FrameView Still::frame_at(const CameraPose& pose, u32 width, u32 height, float time) {
    return build_frame(pose, game_->replica().dimension(), width, height, time, options_.view_distance, seconds_,
                       water_tint_at(game_->replica(), block_of(pose.eye.at)));
}

Result<> Still::draw_only(const CameraPose& pose, u32 width, u32 height, float time) {
    VX_TRY(renderer_->render(frame_at(pose, width, height, time)));
    glFinish();
    return {};
}

Result<> Still::trace(const CameraPose& pose, u32 width, u32 height, float time, const trace::TraceSettings& settings) {
    return tracer_->render(frame_at(pose, width, height, time), settings);
}

Result<render::Image> Still::develop(const CameraPose& pose, u32 width, u32 height, float time, bool settled) {
    if (film_.width != width || film_.height != height) film_ = gfx::make_texture_2d(GL_RGBA32F, width, height);
    VX_TRY(tracer_->write_texture(film_.name()));
    renderer_->show_film(film_.name());
    // What builds up over frames now is exposure alone; a first frame has it whole.
    return settled ? draw_settled(pose, width, height, time, 2) : draw_next(pose, width, height, time);
}

Result<render::Image> Still::draw_next(const CameraPose& pose, u32 width, u32 height, float time) {
    VX_TRY(draw_only(pose, width, height, time));
    return renderer_->read_pixels();
}

Result<render::Image> Still::draw_settled(const CameraPose& pose, u32 width, u32 height, float time, u32 frames) {
    renderer_->forget_frames();
    for (u32 i = 0; i < frames; ++i)
        VX_TRY(draw_only(pose, width, height, time));
    return renderer_->read_pixels();
}

Result<render::Image> Still::draw(const CameraPose& pose, u32 width, u32 height, float time) {
    return draw_settled(pose, width, height, time, render::settling_frames(renderer_->effects()));
}

Result<std::vector<std::pair<std::string, double>>> Still::time_passes(const CameraPose& pose, u32 width, u32 height, float time) {
    std::vector<std::pair<std::string, double>> least;
    renderer_->set_timing(true);
    for (u32 i = 0; i < 6; ++i) {
        VX_TRY(draw_only(pose, width, height, time)); // finishes: the next frame finds the answers
        const auto& times = renderer_->stats().passes_ms;
        if (least.size() != times.size()) least = times;
        for (std::size_t k = 0; k < times.size(); ++k)
            least[k].second = std::min(least[k].second, times[k].second);
    }
    renderer_->set_timing(false);
    return least;
}

} // namespace vitrail::client
