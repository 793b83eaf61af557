#include "terrain/cuda/device.h"

#if VITRAIL_CUDA

#include "base/clock.h"
#include "jobs/thread_pool.h"
#include "terrain/cuda/launch.h"

#include <cuda_runtime_api.h>

#include <algorithm>
#include <fmt/format.h>
#include <mutex>
#include <optional>

namespace vitrail {

namespace {

Result<> check(cudaError_t e, const char* what) {
    if (e == cudaSuccess) return {};
    return fail(e == cudaErrorMemoryAllocation ? ErrorCode::limit : ErrorCode::io,
                fmt::format("CUDA: {} failed: {}", what, cudaGetErrorString(e)));
}

struct DeviceFree {
    void operator()(void* p) const { cudaFree(p); }
};
struct HostFree {
    void operator()(void* p) const { cudaFreeHost(p); }
};
template <class T>
using DeviceArray = std::unique_ptr<T, DeviceFree>;
template <class T>
using PinnedArray = std::unique_ptr<T, HostFree>;

template <class T>
Result<> make(DeviceArray<T>& out, std::size_t count) {
    void* p = nullptr;
    VX_TRY(check(cudaMalloc(&p, count * sizeof(T)), "memory of the device"));
    out.reset(static_cast<T*>(p));
    return {};
}
template <class T>
Result<> make(PinnedArray<T>& out, std::size_t count) {
    void* p = nullptr;
    VX_TRY(check(cudaMallocHost(&p, count * sizeof(T)), "pinned memory"));
    out.reset(static_cast<T*>(p));
    return {};
}

inline constexpr u32 kMarks = u32(TerrainStage::count) + 2; // before each stage, before the copy, after it

// Everything one batch needs, made once; slots take turns.
struct Slot {
    DeviceArray<LandTile> lands;
    DeviceArray<float> floor, surface_a, surface_b, loose;
    DeviceArray<GroundTile> grounds;
    DeviceArray<LatticeTile> lattices;
    DeviceArray<CaveTile> caves;
    DeviceArray<FeatureTile> features;
    DeviceArray<BlockTile> blocks;
    DeviceArray<BiomeTile> biomes;
    PinnedArray<BlockTile> host_blocks;
    PinnedArray<BiomeTile> host_biomes;
    cudaStream_t stream = nullptr;
    cudaEvent_t mark[kMarks] = {};
    std::optional<u32> number; // of the batch under way
    ColumnRect rect;

    ~Slot() {
        for (cudaEvent_t e : mark)
            if (e) cudaEventDestroy(e);
        if (stream) cudaStreamDestroy(stream);
    }
};

class CudaBatches final : public ColumnBatchMaker {
public:
    CudaBatches(std::shared_ptr<const TerrainGenerator> generator, CudaOptions options)
        : generator_(std::move(generator))
        , options_(options)
        , pool_(options.pack_threads) {}
    ~CudaBatches() override {
        for (const auto& slot : slots_)
            if (slot->stream) cudaStreamSynchronize(slot->stream);
    }

    Result<> open() {
        VX_TRY(check(cudaSetDevice(options_.device), "choosing the device"));
        cudaDeviceProp properties{};
        VX_TRY(check(cudaGetDeviceProperties(&properties, options_.device), "asking for the device"));
        name_ = properties.name;
        const TerrainTables& t = generator_->tables();
        VX_TRY(make(tables_, 1));
        VX_TRY(check(cudaMemcpy(tables_.get(), &t, sizeof t, cudaMemcpyHostToDevice), "copying tables"));
        VX_TRY(make(decorators_, cuda::decorator_index_bytes()));
        cuda::launch_decorator_index(tables_.get(), decorators(), nullptr);
        VX_TRY(check(cudaDeviceSynchronize(), "the first launch"));
        rows_.loose = t.loose;
        rows_.passes = t.erosion_passes;
        for (u32 i = 0; i < t.loose; ++i)
            rows_.repose[i] = t.loose_layer[i].repose;
        side_ = 1;
        while ((side_ + 1) * (side_ + 1) <= i32(options_.columns_most))
            ++side_;
        for (u32 i = 0; i < std::max(1u, options_.batches); ++i) {
            auto slot = std::make_unique<Slot>();
            const auto ring = [&](i32 r) { return std::size_t(side_ + 2 * r) * std::size_t(side_ + 2 * r); };
            const std::size_t plane = ring(cuda::kLandRing) * kColumnCells, wanted = ring(0);
            VX_TRY(make(slot->lands, ring(cuda::kLandRing)));
            VX_TRY(make(slot->floor, plane));
            VX_TRY(make(slot->surface_a, plane));
            VX_TRY(make(slot->surface_b, plane));
            VX_TRY(make(slot->loose, plane * std::max(1u, t.loose)));
            VX_TRY(make(slot->grounds, ring(kFeatureReach)));
            VX_TRY(make(slot->lattices, std::size_t(side_ + 7) * std::size_t(side_ + 7)));
            VX_TRY(make(slot->caves, ring(kFeatureReach)));
            VX_TRY(make(slot->features, ring(kFeatureReach)));
            VX_TRY(make(slot->blocks, wanted));
            VX_TRY(make(slot->biomes, wanted));
            VX_TRY(make(slot->host_blocks, wanted));
            VX_TRY(make(slot->host_biomes, wanted));
            VX_TRY(check(cudaStreamCreateWithFlags(&slot->stream, cudaStreamNonBlocking), "a stream"));
            for (cudaEvent_t& e : slot->mark)
                VX_TRY(check(cudaEventCreate(&e), "an event"));
            slots_.push_back(std::move(slot));
        }
        return {};
    }

    Result<u32> submit(ColumnRect rect) override {
        if (rect.width < 1 || rect.depth < 1 || rect.width > side_ || rect.depth > side_)
            return fail(ErrorCode::limit, fmt::format("a batch takes 1 to {} columns a side", side_));
        Slot* slot = nullptr;
        for (const auto& s : slots_)
            if (!s->number) slot = s.get();
        if (!slot) return fail(ErrorCode::limit, "every batch is under way: collect one first");
        VX_TRY(check(cudaSetDevice(options_.device), "choosing the device"));
        cuda::BatchView v;
        v.tables = tables_.get();
        v.decorators = decorators();
        v.first = rect.first;
        v.width = rect.width;
        v.depth = rect.depth;
        v.lands = slot->lands.get();
        v.floor = slot->floor.get();
        v.surface[0] = slot->surface_a.get();
        v.surface[1] = slot->surface_b.get();
        v.loose = slot->loose.get();
        v.grounds = slot->grounds.get();
        v.lattices = slot->lattices.get();
        v.caves = slot->caves.get();
        v.features = slot->features.get();
        v.blocks = slot->blocks.get();
        v.biomes = slot->biomes.get();
        u32 mark = 0;
        const auto stage = [&] { cudaEventRecord(slot->mark[mark++], slot->stream); };
        stage();
        cuda::launch_land(v, slot->stream);
        stage();
        cuda::launch_ground(v, rows_, slot->stream);
        stage();
        cuda::launch_lattice(v, slot->stream);
        stage();
        cuda::launch_caves(v, slot->stream);
        stage();
        cuda::launch_features(v, slot->stream);
        stage();
        cuda::launch_blocks(v, slot->stream);
        stage();
        VX_TRY(check(cudaMemcpyAsync(slot->host_blocks.get(), v.blocks, rect.count() * sizeof(BlockTile),
                                     cudaMemcpyDeviceToHost, slot->stream),
                     "copying blocks"));
        VX_TRY(check(cudaMemcpyAsync(slot->host_biomes.get(), v.biomes, rect.count() * sizeof(BiomeTile),
                                     cudaMemcpyDeviceToHost, slot->stream),
                     "copying biomes"));
        stage();
        VX_TRY(check(cudaGetLastError(), "a launch"));
        slot->rect = rect;
        slot->number = next_++;
        return *slot->number;
    }

    Result<std::vector<GeneratedColumn>> collect(u32 number, const TerrainPalette& palette) override {
        for (const auto& s : slots_)
            if (s->number == number) return collect(*s, palette);
        return fail(ErrorCode::invalid_argument, "no such batch");
    }

    u32 max_columns_a_side() const override { return u32(side_); }
    u32 max_batches() const override { return u32(slots_.size()); }
    std::string device_name() const override { return name_; }
    BatchTimes times() const override { return times_; }

private:
    Result<std::vector<GeneratedColumn>> collect(Slot& slot, const TerrainPalette& palette) {
        const auto done = check(cudaStreamSynchronize(slot.stream), "a batch");
        slot.number.reset();
        VX_TRY(done);
        for (u32 i = 0; i + 2 < kMarks; ++i) {
            float ms = 0;
            cudaEventElapsedTime(&ms, slot.mark[i], slot.mark[i + 1]);
            times_.stage_ms[i] += ms;
        }
        float ms = 0;
        cudaEventElapsedTime(&ms, slot.mark[kMarks - 2], slot.mark[kMarks - 1]);
        times_.copy_ms += ms;
        std::vector<GeneratedColumn> out(slot.rect.count());
        const u64 start = now_ns();
        pool_.parallel_for(slot.rect.count(), [&](u32 i) {
            out[i] = pack_column(slot.host_blocks.get()[i], slot.host_biomes.get()[i], palette);
        });
        times_.pack_ms += seconds_since(start) * 1000;
        times_.columns += out.size();
        return out;
    }

    std::shared_ptr<const TerrainGenerator> generator_;
    const CudaOptions options_;
    ThreadPool pool_;
    std::string name_;
    DecoratorIndex* decorators() const { return reinterpret_cast<DecoratorIndex*>(decorators_.get()); }

    DeviceArray<TerrainTables> tables_;
    DeviceArray<u8> decorators_;
    cuda::BatchRows rows_;
    i32 side_ = 0;
    std::vector<std::unique_ptr<Slot>> slots_;
    u32 next_ = 1;
    BatchTimes times_;
};

} // namespace

Result<std::unique_ptr<ColumnBatchMaker>> open_cuda_batches(std::shared_ptr<const TerrainGenerator> generator,
                                                            CudaOptions options) {
    int count = 0;
    if (const cudaError_t e = cudaGetDeviceCount(&count); e != cudaSuccess || count <= options.device)
        return fail(ErrorCode::not_found, fmt::format("no CUDA device {}: {}", options.device,
                                                      e != cudaSuccess ? cudaGetErrorString(e) : "there are fewer"));
    auto batches = std::make_unique<CudaBatches>(std::move(generator), options);
    VX_TRY(batches->open());
    return batches;
}

std::string cuda_summary() {
    int count = 0;
    if (const cudaError_t e = cudaGetDeviceCount(&count); e != cudaSuccess)
        return fmt::format("none: {}", cudaGetErrorString(e));
    std::string out;
    for (int i = 0; i < count; ++i) {
        cudaDeviceProp p{};
        if (cudaGetDeviceProperties(&p, i) != cudaSuccess) continue;
        out += fmt::format("{}{} ({} GiB, compute {}.{})", out.empty() ? "" : ", ", p.name, p.totalGlobalMem >> 30,
                           p.major, p.minor);
    }
    return out.empty() ? "no device" : out;
}

} // namespace vitrail

#else

namespace vitrail {

Result<std::unique_ptr<ColumnBatchMaker>> open_cuda_batches(std::shared_ptr<const TerrainGenerator>, CudaOptions) {
    return fail(ErrorCode::not_found, "this build has no CUDA");
}
std::string cuda_summary() {
    return "not in this build";
}

} // namespace vitrail

#endif
