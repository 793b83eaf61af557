// The film's stages, one function for all: what a CPU runs over rows and a CUDA kernel over a picture. Kernel-safe.
//
//     template <FilmStep S> __global__ void stage(FilmPlanes p, FilmFrame f, u32 level) {
//         ... if (x < film_columns(S, p) && y < film_rows(S, p)) film_pixel<S>(p, f, level, x, y);
//     }
//
// film/stages.h has their order. Each launch needs the one before to be done everywhere.
#pragma once

#include "trace/kernel/change.h"
#include "trace/kernel/resolve.h"

namespace vitrail::trace {

enum class FilmStep : u8 {
    mean,      // without denoising: all there is
    slope,     // of depth
    spikes,    // found
    spread,    //
    fill,      // half mode
    reproject, // history
    watch,     // tiles
    test,      // tiles: changes of light
    respond,   // to them; variance
    filter,    // light, levels 0 to kFilterLevels - 1
    air,       // levels 0 to kAirLevels - 1
    merge,     // light on albedo
    resolve,   // antialiasing in time
    count
};

VX_HD constexpr bool over_tiles(FilmStep s) {
    return s == FilmStep::watch || s == FilmStep::test;
}
VX_HD u32 film_columns(FilmStep s, const FilmPlanes& p) {
    return over_tiles(s) ? p.tiles_wide : p.width;
}
VX_HD u32 film_rows(FilmStep s, const FilmPlanes& p) {
    return over_tiles(s) ? p.tiles_high : p.height;
}
// Stages without a branch, which may also run over the margin up to a multiple of 16 columns.
VX_HD constexpr bool straight(FilmStep s) {
    return s == FilmStep::slope || s == FilmStep::spikes || s == FilmStep::spread || s == FilmStep::fill ||
           s == FilmStep::filter || s == FilmStep::air;
}

template <FilmStep S>
VX_HD void film_pixel(const FilmPlanes& p, const FilmFrame& f, u32 level, i32 x, i32 y) {
    const i32 step = f.half ? 2 : 1; // between samples
    if constexpr (S == FilmStep::mean)
        plain_pixel(p, x, y);
    else if constexpr (S == FilmStep::slope)
        find_slope(p, x, y);
    else if constexpr (S == FilmStep::spikes)
        find_spike(p, f.spike, step, x, y);
    else if constexpr (S == FilmStep::spread)
        spread_spikes(p, step, x, y);
    else if constexpr (S == FilmStep::fill)
        fill_gap(p, fresh_light(p, f), x, y);
    else if constexpr (S == FilmStep::reproject)
        reproject_pixel(p, f, x, y);
    else if constexpr (S == FilmStep::watch)
        watch_tile(p, x, y);
    else if constexpr (S == FilmStep::test)
        test_tile(p, x, y);
    else if constexpr (S == FilmStep::respond)
        respond_pixel(p, f, x, y);
    else if constexpr (S == FilmStep::filter)
        filter_light(p, level % 2 ? p.even : p.odd, level % 2 ? p.odd : p.even, 1 << level, x, y);
    else if constexpr (S == FilmStep::air)
        filter_air(p, level % 2 ? p.air_even : p.air_odd, level % 2 ? p.air_odd : p.air_even, 1 << level, x, y);
    else if constexpr (S == FilmStep::merge)
        merge_pixel(p, kFilterLevels % 2 ? p.even : p.odd, kAirLevels % 2 ? p.air_even : p.air_odd, x, y);
    else
        resolve_pixel(p, f, x, y);
}

} // namespace vitrail::trace
