#include "trace/film/stages_impl.h"

namespace vitrail::trace {

FilmStages film_stages_avx2();
FilmStages film_stages_avx512();

FilmVectors best_film_vectors() {
#if defined(__x86_64__)
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512vl") &&
        __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vbmi") &&
        __builtin_cpu_supports("avx512vbmi2"))
        return FilmVectors::avx512;
    if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("bmi2") && __builtin_cpu_supports("lzcnt"))
        return FilmVectors::avx2;
#endif
    return FilmVectors::portable;
}

const FilmStages& film_stages(FilmVectors v) {
#if defined(__x86_64__)
    if (v == FilmVectors::avx512) {
        static const FilmStages stages = film_stages_avx512();
        return stages;
    }
    if (v == FilmVectors::avx2) {
        static const FilmStages stages = film_stages_avx2();
        return stages;
    }
#endif
    (void)v;
    static const FilmStages stages = make_film_stages<int(FilmVectors::portable)>();
    return stages;
}

std::vector<FilmPass> film_order(const FilmFrame& f) {
    if (!f.denoise) return {{FilmStep::mean}};
    std::vector<FilmPass> order{{FilmStep::slope}};
    if (f.spike > 0) order.insert(order.end(), {{FilmStep::spikes}, {FilmStep::spread}});
    if (f.half) order.push_back({FilmStep::fill});
    order.push_back({FilmStep::reproject});
    if (f.history) order.insert(order.end(), {{FilmStep::watch}, {FilmStep::test}});
    order.push_back({FilmStep::respond});
    for (u32 level = 0; level < kFilterLevels; ++level)
        order.push_back({FilmStep::filter, level});
    for (u32 level = 0; level < kAirLevels; ++level)
        order.push_back({FilmStep::air, level});
    order.insert(order.end(), {{FilmStep::merge}, {FilmStep::resolve}});
    return order;
}

} // namespace vitrail::trace
