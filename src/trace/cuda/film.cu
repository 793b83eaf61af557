// The film's stages on a GPU, a thread a pixel or tile; what is read of it; and words that find their place.
#include "trace/cuda/launch.h"
#include "trace/kernel/film_stage.h"

#include <cuda_runtime.h>

namespace vitrail::trace::cuda {

namespace {

constexpr u32 kWide = 32, kHigh = 4;

template <FilmStep Step>
__global__ void __launch_bounds__(kWide* kHigh)
    film_kernel(const __grid_constant__ FilmPlanes p, const __grid_constant__ FilmFrame f, u32 level, u32 width,
                u32 height) {
    const u32 x = blockIdx.x * kWide + threadIdx.x, y = blockIdx.y * kHigh + threadIdx.y;
    if (x < width && y < height) film_pixel<Step>(p, f, level, i32(x), i32(y));
}

// Finds the instance of a stage that is known at run time.
template <u32 Step>
void launch_step(const FilmPlanes& p, const FilmFrame& f, const FilmPass& pass, u32 width, u32 height, dim3 grid,
                 cudaStream_t stream) {
    if constexpr (Step < u32(FilmStep::count)) {
        if (u32(pass.stage) == Step)
            film_kernel<FilmStep(Step)><<<grid, dim3(kWide, kHigh), 0, stream>>>(p, f, pass.level, width, height);
        else
            launch_step<Step + 1>(p, f, pass, width, height, grid, stream);
    }
}

__global__ void read_kernel(const __grid_constant__ FilmPlanes p, const __grid_constant__ FilmFrame f, FilmLayer layer,
                            float* to) {
    const u32 x = blockIdx.x * blockDim.x + threadIdx.x, y = blockIdx.y;
    if (x >= p.width) return;
    const u32 i = level_at(p, i32(x), i32(y));
    const i32 j = framed_at(p, i32(x), i32(y));
    switch (layer) {
    case FilmLayer::color:
        to[3 * i] = p.color[i].x, to[3 * i + 1] = p.color[i].y, to[3 * i + 2] = p.color[i].z;
        break;
    case FilmLayer::albedo: {
        const Vec4 a = f.sum ? p.sum_albedo[i] : p.albedo[i];
        const float n = f.sum ? ratio_or(1, p.sum_normal[i].w, 0) : 1;
        to[3 * i] = a.x * n, to[3 * i + 1] = a.y * n, to[3 * i + 2] = a.z * n;
        break;
    }
    case FilmLayer::normal: {
        const Vec4 s = p.sum_normal[i];
        const Framed3& g = p.now.normal;
        const Vec3 n = normalized(f.sum ? Vec3{s.x, s.y, s.z} : Vec3{g.r[j], g.g[j], g.b[j]});
        to[3 * i] = n.x, to[3 * i + 1] = n.y, to[3 * i + 2] = n.z;
        break;
    }
    case FilmLayer::distance:
        to[i] = f.sum ? mean_of(p, i).w : p.albedo[i].w;
        break;
    case FilmLayer::samples:
        to[i] = f.sum ? p.sum[i].w : p.light.r[j] >= 0 ? 1.0f : 0.0f;
        break;
    }
}

__global__ void scatter_kernel(const u32* staging, const Piece* pieces) {
    const Piece p = pieces[blockIdx.x];
    for (u32 i = threadIdx.x; i < p.words; i += blockDim.x)
        p.to[i] = staging[p.from + i];
}

__global__ void fill_kernel(float* to, u64 count, float value) {
    for (u64 i = u64(blockIdx.x) * blockDim.x + threadIdx.x; i < count; i += u64(gridDim.x) * blockDim.x)
        to[i] = value;
}

} // namespace

int load_kernels() {
    cudaFuncAttributes attributes{};
    return cudaFuncGetAttributes(&attributes, read_kernel);
}

void launch_film(const FilmPlanes& film, const FilmFrame& frame, const FilmPass& pass, cudaStream_t stream) {
    const u32 width = film_columns(pass.stage, film), height = film_rows(pass.stage, film);
    const dim3 grid((width + kWide - 1) / kWide, (height + kHigh - 1) / kHigh);
    launch_step<0>(film, frame, pass, width, height, grid, stream);
}

u32 channels_of(FilmLayer layer) {
    return layer == FilmLayer::distance || layer == FilmLayer::samples ? 1 : 3;
}

void launch_read(const FilmPlanes& film, const FilmFrame& frame, FilmLayer layer, float* to, cudaStream_t stream) {
    read_kernel<<<dim3((film.width + 127) / 128, film.height), 128, 0, stream>>>(film, frame, layer, to);
}

void launch_scatter(const u32* staging, const Piece* pieces, u32 count, cudaStream_t stream) {
    if (count) scatter_kernel<<<count, 128, 0, stream>>>(staging, pieces);
}

void launch_fill(float* to, u64 count, float value, cudaStream_t stream) {
    if (count) fill_kernel<<<256, 256, 0, stream>>>(to, count, value);
}

} // namespace vitrail::trace::cuda
