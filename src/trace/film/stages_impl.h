// Rows of the film's stages; included once a vector set. The tag keeps their instances apart.
#pragma once

#include "trace/film/stages.h"
#include "trace/kernel/resolve.h"

namespace vitrail::trace {

template <int Tag>
struct FilmRows {
    static void mean(const FilmPlanes& p, const FilmFrame& f, u32, u32 y0, u32 y1) {
        for (u32 y = y0; y < y1; ++y)
            for (u32 x = 0; x < p.width; ++x)
                plain_pixel(p, f, i32(x), i32(y));
    }
};

template <int Tag>
FilmStages make_film_stages() {
    using Rows = FilmRows<Tag>;
    FilmStages s;
    s.stages[u32(FilmStep::mean)] = Rows::mean;
    return s;
}

} // namespace vitrail::trace
