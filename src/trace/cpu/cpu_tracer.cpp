#include "trace/cpu/cpu_tracer.h"

#include "base/clock.h"
#include "trace/cpu/path_stream.h"
#include "trace/sky_source.h"

#include <algorithm>
#include <atomic>
#include <epoxy/gl.h>

namespace vitrail::trace {

// Neighboring paths meet the same chunks: a tile's are in the cache.
constexpr u32 kTileSide = 32;
static_assert(kTileSide * kTileSide <= kPathsAtOnce);

namespace {

struct Tile {
    u32 x0, y0, x1, y1;
};

// A thread's room for paths, and what they start from and come to.
struct Work {
    PathRoom room;
    std::vector<PathStart> starts;
    std::vector<PixelSample> sums;
};

struct Traced {
    u64 rays = 0, paths = 0;
};

// Those pixels of a tile that the film wants light of, or those that it does not.
Traced trace_pixels(const SceneView& scene, const SkyView& sky, const Camera& camera, const PathSettings& settings,
                    u32 samples, const Tile& tile, bool light, Film& film) {
    static thread_local Work work;
    Traced traced;
    SampleMean mean;
    const auto trace = [&] {
        work.sums.resize(work.starts.size());
        traced.rays += trace_paths(scene, sky, camera, settings, work.starts, work.sums, work.room);
        traced.paths += work.starts.size();
        for (std::size_t i = 0; i < work.starts.size(); ++i) {
            const PathStart& s = work.starts[i];
            add_sample(mean, work.sums[i]);
            if (s.sample + 1 < samples) continue;
            film.put(s.x, s.y, mean);
            mean = {};
        }
        work.starts.clear();
    };
    for (u32 y = tile.y0; y < tile.y1; ++y)
        for (u32 x = tile.x0; x < tile.x1; ++x) {
            if (film.wants_light(x, y) != light) continue;
            for (u32 s = 0; s < samples; ++s) {
                work.starts.push_back({x, y, s});
                if (work.starts.size() == kPathsAtOnce) trace();
            }
        }
    trace();
    return traced;
}

} // namespace

CpuTracer::CpuTracer(const TracerOptions& options)
    : pool_(options.pool)
    , scene_(options.window_chunks, options.pool) {
    stats_.device = "CPU";
}

Result<> CpuTracer::set_content(const scene::BlockModels& models, const StateTable& states,
                                const scene::BlockPictures* pictures) {
    return scene_.set_content(models, states, pictures);
}

void CpuTracer::set_chunk(ChunkPos at, DimensionId dimension, ChunkPtr chunk, const scene::TintGrid* tints) {
    scene_.set_chunk(at, dimension, std::move(chunk), tints);
}

void CpuTracer::clear() {
    scene_.clear();
    forget_frames();
}

void CpuTracer::forget_frames() {
    film_.forget();
    watch_.forget();
    frames_ = 0;
}

Result<> CpuTracer::render(const scene::FrameView& frame, const TraceSettings& settings) {
    VX_TRY(check_frame(frame, settings));
    const u64 start = now_ns();
    scene_.update(frame);
    const SceneView scene = scene_.view(frame.seconds, settings.wave_height);
    const SkyView sky = sky_view_of(frame);
    if (film_.width() != frame.width || film_.height() != frame.height) film_.resize(frame.width, frame.height);
    const u64 dropped = film_.dropped();
    const bool changed = watch_.changed(frame, settings, scene_.revision());
    const Camera camera = film_.begin(camera_of(frame, scene_.eye_medium(frame)), film_settings_of(settings), changed);
    const u64 updated = now_ns();

    const PathSettings full = path_settings_of(settings, frames_ * settings.samples);
    PathSettings guides = full; // where half mode wants no light: first surfaces alone
    guides.bounces = 0;
    const u32 across = (frame.width + kTileSide - 1) / kTileSide, down = (frame.height + kTileSide - 1) / kTileSide;
    std::atomic<u64> rays{0}, paths{0};
    const auto trace_tile = [&](u32 tile) {
        const u32 x0 = tile % across * kTileSide, y0 = tile / across * kTileSide;
        const u32 x1 = std::min(x0 + kTileSide, frame.width), y1 = std::min(y0 + kTileSide, frame.height);
        const Tile t{x0, y0, x1, y1};
        const Traced lit = trace_pixels(scene, sky, camera, full, settings.samples, t, true, film_),
                     dark = trace_pixels(scene, sky, camera, guides, 1, t, false, film_);
        rays += lit.rays + dark.rays, paths += lit.paths + dark.paths;
    };
    if (pool_)
        pool_->parallel_for(across * down, trace_tile);
    else
        for (u32 tile = 0; tile < across * down; ++tile)
            trace_tile(tile);
    const u64 traced = now_ns();
    film_.finish(pool_);
    ++frames_;

    stats_.rays = rays, stats_.paths = paths;
    stats_.dropped = film_.dropped() - dropped;
    stats_.samples = film_.samples();
    stats_.update_ms = double(updated - start) * 1e-6;
    stats_.trace_ms = double(traced - updated) * 1e-6;
    stats_.denoise_ms = double(now_ns() - traced) * 1e-6;
    stats_.host_bytes = scene_.memory_bytes() + film_.bytes();
    stats_.chunks = scene_.chunk_count();
    stats_.emitters = scene_.emitter_count();
    return {};
}

std::vector<float> CpuTracer::read(Layer layer) {
    switch (layer) {
    case Layer::albedo:
        return film_.albedo();
    case Layer::normal:
        return film_.normal();
    case Layer::distance:
        return film_.distance();
    case Layer::samples:
        return film_.counts();
    case Layer::color:
        break;
    }
    std::vector<float> out;
    out.reserve(film_.color().size() * 3);
    for (const Vec4& c : film_.color())
        out.insert(out.end(), {c.x, c.y, c.z});
    return out;
}

Result<> CpuTracer::write_texture(u32 texture) {
    if (film_.width() == 0) return fail(ErrorCode::not_found, "nothing was traced yet");
    glTextureSubImage2D(texture, 0, 0, 0, GLsizei(film_.width()), GLsizei(film_.height()), GL_RGBA, GL_FLOAT,
                        film_.color().data());
    return {};
}

} // namespace vitrail::trace
