// Rows of the film's stages; included once a vector set. The tag keeps their instances apart.
#pragma once

#include "trace/film/stages.h"
#include "trace/kernel/change.h"
#include "trace/kernel/resolve.h"

namespace vitrail::trace {

#ifdef __clang__
#pragma clang diagnostic ignored "-Wpass-failed" // sanitizers keep loops as they are
#endif

// Pixels of a row do not read what others of the stage write.
#ifdef __clang__
#define VX_ROW _Pragma("clang loop vectorize(assume_safety)")
#else
#define VX_ROW _Pragma("GCC ivdep")
#endif

template <int Tag>
struct FilmRows {
    // Filters also run over a little of the margin, to the next full vector.
    static i32 wide(const FilmPlanes& p) { return (i32(p.width) + 15) / 16 * 16; }
    static i32 step(const FilmFrame& f) { return f.half ? 2 : 1; }

    static void mean(const FilmPlanes& p, const FilmFrame&, u32, u32 y0, u32 y1) {
        for (u32 y = y0; y < y1; ++y)
            for (u32 x = 0; x < p.width; ++x)
                plain_pixel(p, i32(x), i32(y));
    }
    static void slope(const FilmPlanes& p, const FilmFrame&, u32, u32 y0, u32 y1) {
        const i32 end = wide(p);
        for (u32 y = y0; y < y1; ++y) {
            VX_ROW for (i32 x = 0; x < end; ++x) find_slope(p, x, i32(y));
        }
    }
    static void spikes(const FilmPlanes& p, const FilmFrame& f, u32, u32 y0, u32 y1) {
        const float most = f.spike;
        const i32 s = step(f);
        const i32 end = wide(p);
        for (u32 y = y0; y < y1; ++y) {
            VX_ROW for (i32 x = 0; x < end; ++x) find_spike(p, most, s, x, i32(y));
        }
    }
    static void spread(const FilmPlanes& p, const FilmFrame& f, u32, u32 y0, u32 y1) {
        const i32 s = step(f);
        const i32 end = wide(p);
        for (u32 y = y0; y < y1; ++y) {
            VX_ROW for (i32 x = 0; x < end; ++x) spread_spikes(p, s, x, i32(y));
        }
    }
    static void fill(const FilmPlanes& p, const FilmFrame& f, u32, u32 y0, u32 y1) {
        const Framed3 from = fresh_light(p, f);
        const i32 end = wide(p);
        for (u32 y = y0; y < y1; ++y) {
            VX_ROW for (i32 x = 0; x < end; ++x) fill_gap(p, from, x, i32(y));
        }
    }
    static void reproject(const FilmPlanes& p, const FilmFrame& f, u32, u32 y0, u32 y1) {
        for (u32 y = y0; y < y1; ++y)
            for (u32 x = 0; x < p.width; ++x)
                reproject_pixel(p, f, i32(x), i32(y));
    }
    static void watch(const FilmPlanes& p, const FilmFrame&, u32, u32 y0, u32 y1) {
        for (u32 y = y0; y < y1; ++y)
            for (u32 x = 0; x < p.tiles_wide; ++x)
                watch_tile(p, i32(x), i32(y));
    }
    static void test(const FilmPlanes& p, const FilmFrame&, u32, u32 y0, u32 y1) {
        for (u32 y = y0; y < y1; ++y)
            for (u32 x = 0; x < p.tiles_wide; ++x)
                test_tile(p, i32(x), i32(y));
    }
    static void respond(const FilmPlanes& p, const FilmFrame& f, u32, u32 y0, u32 y1) {
        for (u32 y = y0; y < y1; ++y)
            for (u32 x = 0; x < p.width; ++x)
                respond_pixel(p, f, i32(x), i32(y));
    }
    static void filter(const FilmPlanes& p, const FilmFrame&, u32 level, u32 y0, u32 y1) {
        const Framed4 from = level % 2 ? p.even : p.odd, to = level % 2 ? p.odd : p.even;
        const i32 s = 1 << level;
        const i32 end = wide(p);
        for (u32 y = y0; y < y1; ++y) {
            VX_ROW for (i32 x = 0; x < end; ++x) filter_light(p, from, to, s, x, i32(y));
        }
    }
    static void air(const FilmPlanes& p, const FilmFrame&, u32 level, u32 y0, u32 y1) {
        const Framed3 from = level % 2 ? p.air_even : p.air_odd, to = level % 2 ? p.air_odd : p.air_even;
        const i32 s = 1 << level;
        const i32 end = wide(p);
        for (u32 y = y0; y < y1; ++y) {
            VX_ROW for (i32 x = 0; x < end; ++x) filter_air(p, from, to, s, x, i32(y));
        }
    }
    static void merge(const FilmPlanes& p, const FilmFrame&, u32, u32 y0, u32 y1) {
        const Framed4 light = kFilterLevels % 2 ? p.even : p.odd;
        const Framed3 mist = kAirLevels % 2 ? p.air_even : p.air_odd;
        for (u32 y = y0; y < y1; ++y)
            for (u32 x = 0; x < p.width; ++x)
                merge_pixel(p, light, mist, i32(x), i32(y));
    }
    static void resolve(const FilmPlanes& p, const FilmFrame& f, u32, u32 y0, u32 y1) {
        for (u32 y = y0; y < y1; ++y)
            for (u32 x = 0; x < p.width; ++x)
                resolve_pixel(p, f, i32(x), i32(y));
    }
};

template <int Tag>
FilmStages make_film_stages() {
    using Rows = FilmRows<Tag>;
    FilmStages s;
    const auto set = [&](FilmStep step, FilmStage stage) { s.stages[u32(step)] = stage; };
    set(FilmStep::mean, Rows::mean);
    set(FilmStep::slope, Rows::slope);
    set(FilmStep::spikes, Rows::spikes);
    set(FilmStep::spread, Rows::spread);
    set(FilmStep::fill, Rows::fill);
    set(FilmStep::reproject, Rows::reproject);
    set(FilmStep::watch, Rows::watch);
    set(FilmStep::test, Rows::test);
    set(FilmStep::respond, Rows::respond);
    set(FilmStep::filter, Rows::filter);
    set(FilmStep::air, Rows::air);
    set(FilmStep::merge, Rows::merge);
    set(FilmStep::resolve, Rows::resolve);
    return s;
}

} // namespace vitrail::trace
