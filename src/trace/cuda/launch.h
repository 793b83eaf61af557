// What the host's files of this folder share with those that nvcc compiles: the launches. All pointers are of the
// device that is current, and so is the stream.
#pragma once

#include "trace/film/stages.h"
#include "trace/kernel/film.h"
#include "trace/kernel/path_settings.h"
#include "trace/kernel/scene_view.h"
#include "trace/kernel/sky_view.h"

#include <functional>

struct CUstream_st; // cudaStream_t points to it
struct CUevent_st;  // cudaEvent_t does

namespace vitrail::trace::cuda {

// Loads the film's kernels onto the current device: 0, or the cudaError_t that says why they do not run there.
int load_kernels();

// Words from one place of staging memory to where they belong.
struct Piece {
    u32* to = nullptr;
    u32 from = 0, words = 0; // of staging
};
inline constexpr u32 kPieceWords = 4096; // at most
void launch_scatter(const u32* staging, const Piece* pieces, u32 count, CUstream_st* stream);

void launch_fill(float* to, u64 count, float value, CUstream_st* stream);

// Sums over a frame's paths, in device memory.
struct PathCounts {
    unsigned long long rays = 0, paths = 0, dropped = 0;
};

// Rows of the picture are dealt out to devices in bands of so many.
inline constexpr u32 kBand = 16;

// Every pixel of the bands `band`, `band + bands`, ... of the picture. Where the frame wants light for a quarter of the
// pixels (FilmFrame::half) the others get one sample without scattering.
struct PathJob {
    SceneView scene;
    SkyView sky;
    PathSettings settings;
    FilmPlanes film; // `width` and `height` alone where means are wanted
    FilmFrame frame;
    u32 samples = 1;
    u32 band = 0, bands = 1;
    SampleMean* means = nullptr; // instead of the film: row by row, the rows of the bands alone
    PathCounts* counts = nullptr;
};
struct Wave;
struct WavePlan;
// Called after the launches of a stage. items: of the device, how much they have to do.
using StageMark = std::function<void(const char* stage, u32 round, const u32* items)>;
// Rays to lights go through `lights`, beside the next round's other rays; the events order the two. lights may be main.
struct WaveStreams {
    CUstream_st *main = nullptr, *lights = nullptr;
    CUevent_st *sent = nullptr, *arrived = nullptr;
};
// All of a job's paths; wave_memory.h makes plan and memory. mark: may be empty; what it is told is of the main stream.
// Nothing waits for the device; the main stream ends after all.
void launch_paths(const PathJob& job, const WavePlan& plan, const Wave& wave, const StageMark& mark,
                  const WaveStreams& streams);
// Means of another device's bands, into the film. The job is that device's, with this device's film.
void launch_put_means(const PathJob& job, CUstream_st* stream);
// Rows of the bands, whole bands alone: the last one may lie outside of the picture in part.
inline u32 rows_of_bands(u32 height, u32 band, u32 bands) {
    const u32 all = (height + kBand - 1) / kBand;
    return (all > band ? (all - band - 1) / bands + 1 : 0) * kBand;
}

void launch_film(const FilmPlanes& film, const FilmFrame& frame, const FilmPass& pass, CUstream_st* stream);

// What Tracer::read gives, `channels` floats a pixel.
enum class FilmLayer : u8 { color, albedo, normal, distance, samples };
u32 channels_of(FilmLayer layer);
void launch_read(const FilmPlanes& film, const FilmFrame& frame, FilmLayer layer, float* to, CUstream_st* stream);

struct Word4;
// Rays by themselves, in a medium: to what they meet, or whether nothing opaque lies before kFar (panes are passed).
struct RayJob {
    SceneView scene;
    const Word4* rays = nullptr; // words.h: planes of `count`
    u32 count = 0, medium = 0;
    bool alike = false;      // neighbors go similar ways, so that warps need not look for work
    Word4* hits = nullptr;   // of launch_closest: likewise
    u8* lit = nullptr;       // of launch_shadows: 1 or 0
    u32* hard = nullptr;     // room for `count` numbers, and
    u32* counters = nullptr; // kRayCounters
};
inline constexpr u32 kRayCounters = 2;
void launch_closest(const RayJob& job, CUstream_st* stream);
void launch_shadows(const RayJob& job, CUstream_st* stream);

} // namespace vitrail::trace::cuda
