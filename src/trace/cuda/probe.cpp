#include "trace/cuda/probe.h"

#if VITRAIL_CUDA

#include "trace/cuda/frame_film.h"
#include "trace/cuda/mirror.h"
#include "trace/cuda/words.h"

#include <array>

namespace vitrail::trace::cuda {

namespace {

Result<> have_device() {
    int count = 0;
    const cudaError_t e = cudaGetDeviceCount(&count);
    if (e == cudaSuccess && count > 0) return {};
    return fail(ErrorCode::unsupported,
                fmt::format("no CUDA device: {}", e != cudaSuccess ? cudaGetErrorString(e) : "there is none"));
}

// Time between two points of a stream.
class Stopwatch {
public:
    explicit Stopwatch(const Gpu& gpu)
        : gpu_(gpu) {}
    ~Stopwatch() {
        for (cudaEvent_t e : events_)
            if (e) cudaEventDestroy(e);
    }
    Result<> open() {
        for (cudaEvent_t& e : events_)
            VX_TRY(check(cudaEventCreate(&e), "an event"));
        return {};
    }
    Result<> start() { return check(cudaEventRecord(events_[0], gpu_.stream), "an event"); }
    Result<double> stop() {
        VX_TRY(check(cudaGetLastError(), "a launch"));
        VX_TRY(check(cudaEventRecord(events_[1], gpu_.stream), "an event"));
        VX_TRY(gpu_.wait());
        float ms = 0;
        VX_TRY(check(cudaEventElapsedTime(&ms, events_[0], events_[1]), "asking for times"));
        return double(ms);
    }

private:
    const Gpu& gpu_;
    cudaEvent_t events_[2] = {};
};

class Rays final : public RayProbe {
public:
    Result<> open() {
        VX_TRY(gpus_[0].open(0));
        VX_TRY(counters_.make(gpus_[0], kRayCounters * sizeof(u32)));
        VX_TRY(watch_.open());
        return mirror_.open();
    }
    Result<> update(const MirrorSource& source) override { return mirror_.update(source, nullptr); }
    Result<> set_rays(std::span<const Ray> rays, bool alike) override {
        count_ = u32(rays.size()), alike_ = alike;
        std::vector<Word4> words(rays.size() * kRayWords);
        for (std::size_t i = 0; i < rays.size(); ++i)
            words_of(rays[i], words[i], words[i + rays.size()], words[i + 2 * rays.size()]);
        VX_TRY(gpus_[0].wait());
        VX_TRY(rays_.make(gpus_[0], words.size() * sizeof(Word4)));
        VX_TRY(hits_.make(gpus_[0], rays.size() * kHitWords * sizeof(Word4)));
        VX_TRY(lit_.make(gpus_[0], rays.size()));
        VX_TRY(hard_.make(gpus_[0], rays.size() * sizeof(u32)));
        return check(cudaMemcpy(rays_.as(), words.data(), words.size() * sizeof(Word4), cudaMemcpyHostToDevice),
                     "copying rays");
    }
    Result<double> closest(u32 medium) override { return launch(launch_closest, medium); }
    Result<double> shadows(u32 medium) override { return launch(launch_shadows, medium); }
    Result<std::vector<Hit>> hits() override {
        std::vector<Word4> words(std::size_t(count_) * kHitWords);
        VX_TRY(check(cudaMemcpy(words.data(), hits_.as(), words.size() * sizeof(Word4), cudaMemcpyDeviceToHost),
                     "reading hits"));
        std::vector<Hit> out(count_);
        for (std::size_t i = 0; i < out.size(); ++i)
            out[i] = hit_of(words[i], words[i + count_]);
        return out;
    }
    Result<std::vector<u8>> lit() override {
        std::vector<u8> out(count_);
        VX_TRY(check(cudaMemcpy(out.data(), lit_.as(), count_, cudaMemcpyDeviceToHost), "reading shadows"));
        return out;
    }
    u64 sent_bytes() const override { return mirror_.sent_bytes(); }

private:
    std::array<Gpu, 1> gpus_;
    SceneMirror mirror_{gpus_};
    Stopwatch watch_{gpus_[0]};
    Result<double> launch(void (*rays)(const RayJob&, CUstream_st*), u32 medium) {
        VX_TRY(gpus_[0].use());
        RayJob job{
            .scene = mirror_.scene(0), .rays = rays_.as<Word4>(), .count = count_, .medium = medium, .alike = alike_};
        job.hits = hits_.as<Word4>(), job.lit = lit_.as<u8>();
        job.hard = hard_.as<u32>(), job.counters = counters_.as<u32>();
        VX_TRY(watch_.start());
        rays(job, gpus_[0].stream);
        return watch_.stop();
    }

    DeviceBytes rays_, hits_, lit_, hard_, counters_; // as RayJob's
    u32 count_ = 0;
    bool alike_ = false;
};

class FilmAlone final : public FilmProbe {
public:
    Result<> open() {
        VX_TRY(gpu_.open(0));
        VX_TRY(counts_.make(gpu_, sizeof(PathCounts)));
        return watch_.open();
    }
    Result<Camera> begin(const Camera& now, const FilmSettings& settings, bool changed) override {
        VX_TRY(film_.begin(now, settings, changed));
        return film_.frame().now;
    }
    Result<> put(std::span<const SampleMean> means) override {
        VX_TRY(means_.reach(gpu_, means.size_bytes()));
        VX_TRY(
            check(cudaMemcpyAsync(means_.as(), means.data(), means.size_bytes(), cudaMemcpyHostToDevice, gpu_.stream),
                  "copying samples"));
        PathJob job;
        job.film = film_.planes(), job.frame = film_.frame();
        job.means = means_.as<SampleMean>();
        job.counts = counts_.as<PathCounts>();
        launch_put_means(job, gpu_.stream);
        VX_TRY(check(cudaGetLastError(), "putting samples"));
        return gpu_.wait();
    }
    Result<double> finish() override {
        VX_TRY(watch_.start());
        VX_TRY(film_.finish());
        return watch_.stop();
    }
    Result<std::vector<float>> color() override { return film_.read(FilmLayer::color); }
    Result<std::vector<float>> samples() override { return film_.read(FilmLayer::samples); }

private:
    Gpu gpu_;
    DeviceFilm film_{gpu_};
    DeviceBytes means_, counts_;
    Stopwatch watch_{gpu_};
};

} // namespace

Result<std::unique_ptr<RayProbe>> RayProbe::open() {
    VX_TRY(have_device());
    auto rays = std::make_unique<Rays>();
    VX_TRY(rays->open());
    return std::unique_ptr<RayProbe>(std::move(rays));
}

Result<std::unique_ptr<FilmProbe>> FilmProbe::open() {
    VX_TRY(have_device());
    auto film = std::make_unique<FilmAlone>();
    VX_TRY(film->open());
    return std::unique_ptr<FilmProbe>(std::move(film));
}

} // namespace vitrail::trace::cuda

#else

namespace vitrail::trace::cuda {

Result<std::unique_ptr<RayProbe>> RayProbe::open() {
    return fail(ErrorCode::unsupported, "this build has no CUDA");
}
Result<std::unique_ptr<FilmProbe>> FilmProbe::open() {
    return fail(ErrorCode::unsupported, "this build has no CUDA");
}

} // namespace vitrail::trace::cuda

#endif
