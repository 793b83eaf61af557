// Rows of the film's stages; included once a vector set. The tag keeps their instances apart.
#pragma once

#include "trace/cpu/row.h"
#include "trace/film/stages.h"

#include <utility>

namespace vitrail::trace {

template <int Tag, FilmStep S>
void run_rows(const FilmPlanes& planes, const FilmFrame& frame, u32 level, u32 y0, u32 y1) {
    const FilmPlanes p = planes; // in this function's hands: nothing written changes them
    const FilmFrame f = frame;
    if constexpr (straight(S)) {
        const i32 end = (i32(p.width) + 15) / 16 * 16; // a little of the margin, to the next full vector
        for (u32 y = y0; y < y1; ++y) {
            VX_ROW for (i32 x = 0; x < end; ++x) film_pixel<S>(p, f, level, x, i32(y));
        }
    } else {
        const i32 end = i32(film_columns(S, p));
        for (u32 y = y0; y < y1; ++y)
            for (i32 x = 0; x < end; ++x)
                film_pixel<S>(p, f, level, x, i32(y));
    }
}

template <int Tag>
FilmStages make_film_stages() {
    FilmStages s;
    [&]<std::size_t... I>(std::index_sequence<I...>) {
        ((s.stages[I] = run_rows<Tag, FilmStep(I)>), ...);
    }
    (std::make_index_sequence<std::size_t(FilmStep::count)>{});
    return s;
}

} // namespace vitrail::trace
