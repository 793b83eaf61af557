// Where the film's planes lie in one block of memory; and what a frame is told (host side, CPU and CUDA alike).
#pragma once

#include "trace/kernel/film_planes.h"

namespace vitrail::trace {

// Bytes that planes of this size take.
u64 film_bytes(u32 width, u32 height);
// Pointers into `memory` (film_bytes, aligned to 64; of any device). Contents are undefined: prepare_film next.
FilmPlanes film_planes(u32 width, u32 height, void* memory);
// The framed planes that must be filled once with kNothing: whole, margin and all. Each has film_framed_floats floats
// from its pointer minus framed_margin(planes) on; the other framed planes are filled with 0.
u64 film_framed_floats(const FilmPlanes& p);
u64 framed_margin(const FilmPlanes& p);
// What the last frame left becomes the past.
void turn_film(FilmPlanes& p);

struct FilmSettings {
    bool denoise = true;
    bool accumulate = true;   // false: each frame stands for itself at rest, too (denoised frames keep their history)
    bool half = false;        // light for a quarter of the pixels (light_wanted), guides and base for all
    float spread_spikes = 12; // denoised: light of a sample over so many times its neighborhood's is spread over the
                              // neighborhood, which keeps the energy; 0: never
    u32 samples = 1;          // a pixel and frame, for samples()
};

// The next frame of a film. last: its last frame; frames: since it was forgotten; samples: a pixel at rest until now.
FilmFrame next_film_frame(const FilmFrame& last, u32 frames, u32& samples, const Camera& now,
                          const FilmSettings& settings, bool changed);

} // namespace vitrail::trace
