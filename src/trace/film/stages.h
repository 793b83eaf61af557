// The film's stages over rows of pixels, built for three vector sets; and their order in a frame.
#pragma once

#include "trace/kernel/film_stage.h"

#include <vector>

namespace vitrail::trace {

// One launch of film_pixel<stage>, after the one before is done everywhere.
struct FilmPass {
    FilmStep stage;
    u32 level = 0; // filter, air: 0.. widening
};
std::vector<FilmPass> film_order(const FilmFrame& frame);

// Rows y0 <= y < y1.
using FilmStage = void (*)(const FilmPlanes&, const FilmFrame&, u32 level, u32 y0, u32 y1);
struct FilmStages {
    FilmStage stages[u32(FilmStep::count)] = {};
};

enum class FilmVectors : u8 { portable, avx2, avx512 };
FilmVectors best_film_vectors();
const FilmStages& film_stages(FilmVectors v); // the CPU must have them

} // namespace vitrail::trace
