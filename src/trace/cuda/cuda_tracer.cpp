#include "trace/cuda/cuda_tracer.h"

#if VITRAIL_CUDA

#include "base/clock.h"
#include "trace/cuda/frame_film.h"
#include "trace/cuda/gl_share.h"
#include "trace/cuda/mirror.h"
#include "trace/cuda/stage_clock.h"
#include "trace/cuda/wave_memory.h"
#include "trace/frame_setup.h"
#include "trace/scene_host.h"
#include "trace/sky_source.h"

#include <algorithm>

namespace vitrail::trace {

namespace {

using namespace cuda;

Result<int> count_devices() {
    int count = 0;
    const cudaError_t e = cudaGetDeviceCount(&count);
    if (e != cudaSuccess)
        return fail(ErrorCode::unsupported,
                    fmt::format("path tracing on CUDA is not possible here: {}", cudaGetErrorString(e)));
    if (count == 0)
        return fail(ErrorCode::unsupported, "path tracing on CUDA is not possible here: there is no device");
    return count;
}

// Of the current device.
Result<> check_kernels() {
    const auto e = cudaError_t(load_kernels());
    if (e == cudaSuccess) return {};
    (void)cudaGetLastError();
    return fail(ErrorCode::unsupported, fmt::format("path tracing on CUDA is not possible here: this build has nothing "
                                                    "that runs on the device ({})",
                                                    cudaGetErrorString(e)));
}

class CudaTracer final : public Tracer {
public:
    explicit CudaTracer(const TracerOptions& options)
        : pool_(options.pool)
        , scene_(options.window_chunks, options.pool)
        , tells_stages_(options.stages) {}
    ~CudaTracer() override {
        for (const Gpu& g : gpus_)
            (void)g.wait();
        for (const Events& e : events_)
            for (cudaEvent_t event : {e.begin, e.end, e.filtered})
                if (event) cudaEventDestroy(event);
    }

    Result<> open(u32 devices) {
        gpus_.resize(devices);
        events_.resize(devices);
        counts_.resize(devices);
        means_.resize(devices);
        waves_.resize(devices);
        lights_.resize(devices);
        for (u32 i = 0; i < devices; ++i) {
            VX_TRY(gpus_[i].open(int(i)));
            VX_TRY(lights_[i].open(gpus_[i]));
            VX_TRY(check_kernels());
            for (cudaEvent_t* event : {&events_[i].begin, &events_[i].end, &events_[i].filtered})
                VX_TRY(check(cudaEventCreate(event), "an event"));
            VX_TRY(counts_[i].make(gpus_[i], sizeof(PathCounts)));
            cudaDeviceProp properties{};
            VX_TRY(check(cudaGetDeviceProperties(&properties, int(i)), "asking for the device"));
            stats_.device += (i ? " + " : "CUDA: ") + std::string(properties.name);
            int direct = 0;
            if (i > 0 && cudaDeviceCanAccessPeer(&direct, 0, int(i)) == cudaSuccess && direct) {
                VX_TRY(gpus_[0].use());
                if (cudaDeviceEnablePeerAccess(int(i), 0) != cudaSuccess) (void)cudaGetLastError(); // copies are slower
            }
        }
        VX_TRY(host_counts_.reach({}, sizeof(PathCounts) * (devices + 1)));
        mirror_ = std::make_unique<SceneMirror>(gpus_);
        film_ = std::make_unique<DeviceFilm>(gpus_[0]);
        gl_ = std::make_unique<GlShare>(gpus_[0]);
        if (tells_stages_) clock_ = std::make_unique<StageClock>(gpus_[0]);
        return mirror_->open();
    }

    Result<> set_content(const scene::BlockModels& models, const StateTable& states,
                         const scene::BlockPictures* pictures) override {
        return scene_.set_content(models, states, pictures);
    }
    void set_chunk(ChunkPos at, DimensionId dimension, ChunkPtr chunk, const scene::TintGrid* tints) override {
        scene_.set_chunk(at, dimension, std::move(chunk), tints);
    }
    void clear() override {
        scene_.clear();
        forget_frames();
    }
    void forget_frames() override {
        film_->forget();
        watch_.forget();
        frames_ = 0;
    }

    Result<> render(const scene::FrameView& frame, const TraceSettings& settings) override;
    std::vector<float> read(Layer layer) override {
        constexpr FilmLayer kLayers[] = {FilmLayer::color, FilmLayer::albedo, FilmLayer::normal, FilmLayer::distance,
                                         FilmLayer::samples};
        auto out = film_->read(kLayers[u32(layer)]);
        return out ? std::move(*out) : std::vector<float>();
    }
    Result<> write_texture(u32 texture) override {
        const FilmPlanes& p = film_->planes();
        if (p.width == 0) return fail(ErrorCode::not_found, "nothing was traced yet");
        VX_TRY(gl_->write(texture, p.color, p.width, p.height));
        stats_.shown_directly = gl_->direct();
        return {};
    }
    const TracerStats& stats() const override { return stats_; }
    Device device() const override { return Device::cuda; }

private:
    struct Events {
        cudaEvent_t begin = nullptr, end = nullptr, filtered = nullptr;
    };
    Result<> trace(const TraceSettings& settings);
    Result<> trace_bands(std::size_t gpu, PathJob job, const TraceSettings& settings);
    Result<> gather(std::size_t gpu);
    Result<> collect();

    ThreadPool* pool_;
    SceneHost scene_;
    FrameWatch watch_;
    std::vector<Gpu> gpus_; // before what lies on them
    std::vector<Events> events_;
    std::vector<DeviceBytes> counts_; // PathCounts of each
    struct Means {
        DeviceBytes own, gathered; // on its device; on the first
    };
    std::vector<Means> means_;
    struct WaveRoom {
        DeviceBytes bytes;
        u32 most = kWaveMost; // paths of a batch
    };
    std::vector<WaveRoom> waves_;
    std::vector<SideStream> lights_;
    PinnedBytes host_counts_;
    std::unique_ptr<SceneMirror> mirror_;
    std::unique_ptr<DeviceFilm> film_;
    std::unique_ptr<GlShare> gl_;
    bool tells_stages_;
    std::unique_ptr<StageClock> clock_;
    TracerStats stats_;
    u32 frames_ = 0;
};

MirrorSource source_of(SceneHost& scene, const SceneView& view) {
    MirrorSource s;
    s.view = view;
    s.grid = &scene.grid();
    s.lights = &scene.lights();
    s.quads = scene.content().quads().size();
    s.media = scene.content().media().size();
    s.tables = scene.content().generation();
    s.pictures = scene.content().texture_generation();
    s.changed_layers = scene.changed_layers();
    s.box_nodes = scene.boxes().nodes();
    s.boxes = scene.boxes().generation();
    return s;
}

Result<> CudaTracer::render(const scene::FrameView& frame, const TraceSettings& settings) {
    VX_TRY(check_frame(frame, settings));
    const u64 start = now_ns();
    scene_.update(frame);
    scene_.grid().refresh(pool_);
    const SkyView sky = sky_view_of(frame);
    VX_TRY(mirror_->update(source_of(scene_, scene_.view(frame.seconds, settings.wave_height)), &sky));
    const bool changed = watch_.changed(frame, settings, scene_.revision());
    VX_TRY(film_->begin(camera_of(frame, scene_.eye_medium(frame)), film_settings_of(settings), changed));
    stats_.update_ms = double(now_ns() - start) * 1e-6;

    VX_TRY(trace(settings));
    VX_TRY(film_->finish());
    VX_TRY(check(cudaEventRecord(events_[0].filtered, gpus_[0].stream), "an event"));
    ++frames_;
    return collect();
}

Result<> CudaTracer::trace_bands(std::size_t gpu, PathJob job, const TraceSettings& settings) {
    const Gpu& g = gpus_[gpu];
    VX_TRY(g.use());
    VX_TRY(check(cudaEventRecord(events_[gpu].begin, g.stream), "an event"));
    VX_TRY(check(cudaMemsetAsync(counts_[gpu].as(), 0, sizeof(PathCounts), g.stream), "clearing counts"));
    job.scene = mirror_->scene(gpu);
    job.sky = mirror_->sky(gpu);
    job.counts = counts_[gpu].as<PathCounts>();
    job.settings = path_settings_of(settings, frames_ * settings.samples);
    job.samples = settings.samples;
    if (gpu > 0) {
        const u64 bytes =
            u64(rows_of_bands(job.film.height, job.band, job.bands)) * job.film.width * sizeof(SampleMean);
        VX_TRY(means_[gpu].own.reach(g, bytes));
        job.means = means_[gpu].own.as<SampleMean>();
    }
    WaveRoom& room = waves_[gpu];
    VX_TRY_ASSIGN(const WavePlan plan, fit_wave(job, room.most, [&](u64 bytes) {
                      auto taken = room.bytes.reach(g, bytes);
                      if (!taken) (void)cudaGetLastError(); // is told here, not by the launches
                      return taken;
                  }));
    const SideStream& side = lights_[gpu];
    WaveStreams streams{g.stream, side.stream, side.sent, side.arrived};
    StageMark mark;
    if (clock_ && gpu == 0) {
        streams.lights = g.stream; // stages are told one after the other
        clock_->begin();
        mark = [this](const char* stage, u32 round, const u32* items) {
            clock_->mark(fmt::format("{} {}", stage, round), items);
        };
    }
    launch_paths(job, plan, lay_out_wave(plan, room.bytes.as()), mark, streams);
    VX_TRY(check(cudaGetLastError(), "tracing"));
    return check(cudaEventRecord(events_[gpu].end, g.stream), "an event");
}

// What another device traced comes to the first one.
Result<> CudaTracer::gather(std::size_t gpu) {
    const Gpu& first = gpus_[0];
    PathJob job;
    job.film = film_->planes(), job.frame = film_->frame();
    job.band = u32(gpu), job.bands = u32(gpus_.size());
    const u64 bytes = u64(rows_of_bands(job.film.height, job.band, job.bands)) * job.film.width * sizeof(SampleMean);
    if (bytes == 0) return {};
    VX_TRY(means_[gpu].gathered.reach(first, bytes));
    VX_TRY(first.use());
    VX_TRY(check(cudaStreamWaitEvent(first.stream, events_[gpu].end, 0), "waiting for a device"));
    VX_TRY(check(cudaMemcpyPeerAsync(means_[gpu].gathered.as(), first.id, means_[gpu].own.as(), gpus_[gpu].id, bytes,
                                     first.stream),
                 "gathering rows"));
    job.means = means_[gpu].gathered.as<SampleMean>();
    job.counts = counts_[0].as<PathCounts>();
    launch_put_means(job, first.stream);
    return check(cudaGetLastError(), "gathering rows");
}

Result<> CudaTracer::trace(const TraceSettings& settings) {
    PathJob job;
    job.film = film_->planes(), job.frame = film_->frame();
    job.bands = u32(gpus_.size());
    for (std::size_t i = gpus_.size(); i-- > 0;) { // the first one last: the others are under way by then
        job.band = u32(i);
        VX_TRY(trace_bands(i, job, settings));
    }
    for (std::size_t i = 1; i < gpus_.size(); ++i)
        VX_TRY(gather(i));
    return {};
}

Result<> CudaTracer::collect() {
    auto* counts = host_counts_.as<PathCounts>();
    for (std::size_t i = 0; i < gpus_.size(); ++i) {
        VX_TRY(gpus_[i].use());
        VX_TRY(check(
            cudaMemcpyAsync(counts + i, counts_[i].as(), sizeof(PathCounts), cudaMemcpyDeviceToHost, gpus_[i].stream),
            "reading counts"));
    }
    stats_.rays = stats_.paths = stats_.dropped = 0;
    stats_.trace_ms = stats_.denoise_ms = 0;
    for (std::size_t i = 0; i < gpus_.size(); ++i) {
        VX_TRY(gpus_[i].wait());
        stats_.rays += counts[i].rays, stats_.paths += counts[i].paths;
        stats_.dropped += counts[i].dropped; // the first one's, of all
        float ms = 0;
        VX_TRY(check(cudaEventElapsedTime(&ms, events_[i].begin, events_[i].end), "asking for times"));
        stats_.trace_ms = std::max(stats_.trace_ms, double(ms));
    }
    float ms = 0;
    VX_TRY(gpus_[0].use());
    VX_TRY(check(cudaEventElapsedTime(&ms, events_[0].end, events_[0].filtered), "asking for times"));
    stats_.denoise_ms = double(ms);
    if (clock_) {
        VX_TRY_ASSIGN(stats_.stages, clock_->read());
    }
    stats_.samples = film_->samples();
    stats_.host_bytes = scene_.memory_bytes();
    stats_.device_bytes = mirror_->device_bytes() + film_->bytes();
    for (std::size_t i = 0; i < gpus_.size(); ++i)
        stats_.device_bytes += means_[i].own.size() + means_[i].gathered.size() + waves_[i].bytes.size();
    stats_.chunks = scene_.chunk_count();
    stats_.emitters = scene_.emitter_count();
    return {};
}

} // namespace

Result<std::unique_ptr<Tracer>> make_cuda_tracer(const TracerOptions& options) {
    VX_TRY_ASSIGN(const int count, count_devices());
    auto tracer = std::make_unique<CudaTracer>(options);
    VX_TRY(tracer->open(std::clamp(options.devices_most, 1u, u32(count))));
    return std::unique_ptr<Tracer>(std::move(tracer));
}

Result<> cuda_possible() {
    VX_TRY(count_devices());
    VX_TRY(check(cudaSetDevice(0), "choosing the device"));
    return check_kernels();
}

std::string cuda_tracer_summary() {
    const auto count = count_devices();
    return count ? fmt::format("processor; CUDA, on up to {} device{}", *count, *count == 1 ? "" : "s")
                 : fmt::format("processor ({})", count.error().message);
}

} // namespace vitrail::trace

#else

namespace vitrail::trace {

static constexpr const char* kNotBuilt = "path tracing on CUDA is not possible here: this build has no CUDA";

Result<std::unique_ptr<Tracer>> make_cuda_tracer(const TracerOptions&) {
    return fail(ErrorCode::unsupported, kNotBuilt);
}

Result<> cuda_possible() {
    return fail(ErrorCode::unsupported, kNotBuilt);
}

std::string cuda_tracer_summary() {
    return "processor (this build has no CUDA)";
}

} // namespace vitrail::trace

#endif
