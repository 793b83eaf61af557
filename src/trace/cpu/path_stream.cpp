#include "trace/cpu/path_stream.h"

#include "base/assert.h"
#include "trace/cpu/path_stages.h"

#include <algorithm>
#include <vector>

namespace vitrail::trace {

struct PathRoom::Arrays {
    std::vector<PathState> paths;
    std::vector<u32> live;
    std::vector<Ray> rays, light_rays;
    std::vector<u8> media, light_media;
    std::vector<Hit> hits;
    std::vector<float> light_reach;
    std::vector<Lit> lit;
    std::vector<stream::Carried> carried;
    std::vector<stream::WaitingLamp> waiting;

    void make_room(u32 count) {
        if (paths.size() >= count) return;
        const std::size_t lights = std::size_t(count) * stream::kLightsAnEvent;
        paths.resize(count), live.resize(count), rays.resize(count), media.resize(count), hits.resize(count);
        light_rays.resize(lights), light_reach.resize(lights), light_media.resize(lights), lit.resize(lights),
            carried.resize(lights);
        waiting.resize(stream::kBlock);
    }
};

PathRoom::PathRoom()
    : arrays_(std::make_unique<Arrays>()) {}
PathRoom::~PathRoom() = default;
PathRoom::PathRoom(PathRoom&&) noexcept = default;
PathRoom& PathRoom::operator=(PathRoom&&) noexcept = default;

PathRoom::Arrays& PathRoom::arrays(u32 paths) {
    arrays_->make_room(paths);
    return *arrays_;
}

namespace {

const stream::PathStages& stages_of(StreamCode code) {
    static const stream::PathStages portable = stream::make_path_stages<int(StreamCode::scalar)>();
    static const stream::PathStages wide = stream::path_stages_avx512();
    return chosen_stream_code(code) == StreamCode::avx512 ? wide : portable;
}

} // namespace

u64 trace_paths(const SceneView& scene, const SkyView& sky, const Camera& camera, const PathSettings& settings,
                std::span<const PathStart> paths, std::span<PixelSample> sums, PathRoom& room, StreamCode code) {
    VX_ASSERT(paths.size() == sums.size());
    const stream::PathStages& stages = stages_of(code);
    const stream::PathFrame frame{&scene, &sky, &camera, &settings};
    const u32 count = u32(paths.size());
    PathRoom::Arrays& r = room.arrays(count);
    stream::PathArrays a{r.paths.data(), r.live.data(),       r.rays.data(),        r.media.data(),
                         r.hits.data(),  r.light_rays.data(), r.light_reach.data(), r.light_media.data(),
                         r.lit.data(),   r.carried.data(),    r.waiting.data()};
    stages.start(frame, paths.data(), count, sums.data(), a);
    u64 rays = 0;
    while (a.alive > 0) {
        rays += a.alive;
        trace_stream(code, scene, {{a.rays, a.alive}, {}, {a.media, a.alive}}, {a.hits, a.alive});
        stages.events(frame, sums.data(), a);
        rays += a.lights;
        shadow_stream(code, scene, {{a.light_rays, a.lights}, {a.light_reach, a.lights}, {a.light_media, a.lights}},
                      {a.lit, a.lights});
        stages.arrive(frame, sums.data(), a);
    }
    for (PixelSample& sum : sums)
        finish_path(sum);
    return rays;
}

} // namespace vitrail::trace
