#include "client/traced_view.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <epoxy/gl.h>
#include <fmt/format.h>

namespace vitrail::client {

namespace {

// Below this share a picture hardly shows blocks any more.
constexpr float kLeastShare = 1.0f / 3;
// After so many frames of the same view the picture is made as large as a frame of so many times the wished length lets
// it be, and then left to gather samples; a gain below that in width is not worth beginning anew.
constexpr u32 kFramesOfRest = 8;
constexpr float kRestTime = 2, kRestGain = 1.15f;
// The time of a frame that is the tracer's own; how many times more or less than wanted is far off; steps of sizes.
constexpr float kTracedPart = 0.8f, kFarOff = 2, kShareSteps = 16;
constexpr std::size_t kChunksLeast = 64, kChunksMost = 4096;

} // namespace

Result<trace::Device> trace_device_named(const std::string& name) {
    if (name == "cpu") return trace::Device::cpu;
    if (name == "cuda") return trace::Device::cuda;
    if (name != "auto")
        return fail(ErrorCode::invalid_argument, fmt::format("--device is cpu, cuda or auto, not '{}'", name));
    return trace::Device::best;
}

// Filled by a worker, which may come back after the view went.
struct TracedView::Pictures {
    std::atomic<bool> done{false};
    scene::BlockPictures pictures;
};

Result<std::unique_ptr<TracedView>> TracedView::open(const Parts& parts) {
    std::unique_ptr<TracedView> view(new TracedView(parts));
    trace::TracerOptions options;
    options.device = parts.device;
    options.devices_most = parts.devices_most;
    options.pool = &parts.pool;
    VX_TRY_ASSIGN(view->tracer_, trace::Tracer::create(options));
    view->feeder_ = std::make_unique<TraceFeeder>(*view->tracer_);
    view->feeder_->take_all(parts.replica);
    parts.sections.on_dirty(
        [feeder = view->feeder_.get()](const replica::DirtySection& dirty) { feeder->mark(dirty); });
    view->pictures_ = std::make_shared<Pictures>();
    view->chunks_a_frame_ = kChunksLeast;
    parts.pool.submit([job = view->pictures_, registry = parts.registry, packs = parts.packs] {
        job->pictures = scene::BlockPictures::load(*registry, packs.get());
        job->done = true;
    });
    return view;
}

TracedView::~TracedView() {
    parts_.sections.on_dirty({});
}

void TracedView::set_packs(std::shared_ptr<const scene::PackLooks> packs) {
    pictures_.reset(); // those of the packs before
    parts_.packs = std::move(packs);
    feeder_->set_packs(*parts_.registry, parts_.packs.get());
}

Result<> TracedView::feed(BlockPos eye, double budget_ms) {
    if (pictures_) {
        if (!pictures_->done) return {};
        feeder_->set_pictures(std::move(pictures_->pictures));
        pictures_.reset();
    }
    // What the tracer made of the last ones counts: it takes them in when it draws.
    const double took = tracer_->stats().update_ms;
    if (took > budget_ms)
        chunks_a_frame_ = std::max(chunks_a_frame_ / 2, kChunksLeast);
    else if (took < budget_ms / 2)
        chunks_a_frame_ = std::min(chunks_a_frame_ * 2, kChunksMost);
    return feeder_->update(parts_.replica, parts_.sections, eye, budget_ms, chunks_a_frame_);
}

float TracedView::choose_share(const TraceOptions& options, const render::Effects& effects, float last_frame_ms) {
    const float most = std::min(options.scale, effects.resolution.scale), least = std::min(kLeastShare, most);
    const float wanted_ms = 1000.0f / frame_rate_of(options, device());
    if (resting_frames_ < kFramesOfRest) {
        rest_share_.reset();
    } else if (rest_share_) {
        return std::min(*rest_share_, most);
    } else if (traced_ms_ > 0) {
        const float fits = std::min(most, share_ * std::sqrt(kTracedPart * kRestTime * wanted_ms / traced_ms_));
        rest_share_ = fits > share_ * kRestGain ? fits : share_;
        return std::min(*rest_share_, most);
    }
    // Far from what is wanted there is no time for judging many frames: the time that a pixel took tells the size. On
    // the CPU the first picture is a small one, to learn that.
    if (traced_ms_ <= 0) {
        if (device() == trace::Device::cpu && !most_now_) most_now_ = least;
    } else if (traced_ms_ > kFarOff * wanted_ms || (traced_ms_ * kFarOff < wanted_ms && share_ < most)) {
        const float fits = share_ * std::sqrt(kTracedPart * wanted_ms / traced_ms_);
        most_now_ = std::round(fits * kShareSteps) / kShareSteps;
    }
    const float most_here = std::clamp(most_now_.value_or(most), least, most);
    return resolution_.next(shown_ ? last_frame_ms : 0.0f, {wanted_ms, least, most_here});
}

// The eye, where it looks and the light are those of the frame before.
bool TracedView::same_view(const scene::FrameView& frame) {
    const scene::View& view = frame.views[0];
    const Seen now{view.eye, view.rotation.m, view.fov_y, frame.sky.time, frame.width, frame.height};
    const bool same = shown_ && now == seen_;
    seen_ = now;
    return same;
}

Result<> TracedView::draw(scene::FrameView& frame, const TraceOptions& options, const render::Effects& effects,
                          float last_frame_ms, render::Renderer& renderer) {
    resting_frames_ = same_view(frame) ? resting_frames_ + 1 : 0;
    share_ = choose_share(options, effects, last_frame_ms);
    shown_ = true;
    const auto [width, height] = scene::drawn_size(frame.width, frame.height, share_);
    scene::FrameView traced = frame;
    traced.width = width, traced.height = height;
    VX_TRY(tracer_->render(traced, tracer_settings(options, effects.water.waves ? effects.water.wave_height : 0.0f)));
    const trace::TracerStats& stats = tracer_->stats();
    traced_ms_ = float(stats.trace_ms + stats.denoise_ms);
    if (film_.width != width || film_.height != height) film_ = gfx::make_texture_2d(GL_RGBA32F, width, height);
    VX_TRY(tracer_->write_texture(film_.name()));
    renderer.show_film(film_.name());
    frame.resolution = share_;
    return {};
}

void TracedView::hide(render::Renderer& renderer) {
    renderer.show_film(0);
    shown_ = false;
}

} // namespace vitrail::client
