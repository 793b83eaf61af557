#include "trace/cpu/ray_stream.h"

#include "base/assert.h"
#include "trace/cpu/ray_stream_scalar.h"

namespace vitrail::trace {

namespace {

bool avx512_cpu() {
    return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
           __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512dq") &&
           __builtin_cpu_supports("avx512vbmi") && __builtin_cpu_supports("avx512vbmi2");
}

stream::Rays plain(const RayStream& r) {
    VX_ASSERT(r.t_max.empty() || r.t_max.size() == r.rays.size());
    VX_ASSERT(r.media.empty() || r.media.size() == r.rays.size());
    return {r.rays.data(), r.t_max.empty() ? nullptr : r.t_max.data(), r.media.empty() ? nullptr : r.media.data(),
            u32(r.rays.size())};
}

} // namespace

StreamCode chosen_stream_code(StreamCode code) {
    if (code != StreamCode::best) return code;
    static const bool wide = avx512_cpu();
    return wide ? StreamCode::avx512 : StreamCode::scalar;
}

bool stream_code_available(StreamCode code) {
    return code != StreamCode::avx512 || avx512_cpu();
}

void trace_stream(StreamCode code, const SceneView& scene, const RayStream& rays, std::span<Hit> hits) {
    VX_ASSERT(hits.size() == rays.rays.size());
    const stream::Rays r = plain(rays);
    if (chosen_stream_code(code) == StreamCode::avx512 && scene.grid.skips)
        return stream::trace_avx512(scene, r, hits.data());
    for (u32 i = 0; i < r.count; ++i)
        stream::trace_one(scene, r, i, hits.data());
}

void shadow_stream(StreamCode code, const SceneView& scene, const RayStream& rays, std::span<Lit> lit) {
    VX_ASSERT(lit.size() == rays.rays.size());
    const stream::Rays r = plain(rays);
    if (chosen_stream_code(code) == StreamCode::avx512 && scene.grid.skips)
        return stream::shadow_avx512(scene, r, lit.data());
    for (u32 i = 0; i < r.count; ++i)
        stream::shadow_one(scene, r, i, lit.data());
}

void trace_stream(const SceneView& scene, const RayStream& rays, std::span<Hit> hits) {
    trace_stream(StreamCode::best, scene, rays, hits);
}
void shadow_stream(const SceneView& scene, const RayStream& rays, std::span<Lit> lit) {
    shadow_stream(StreamCode::best, scene, rays, lit);
}

} // namespace vitrail::trace
