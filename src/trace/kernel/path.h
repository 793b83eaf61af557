// One path from the eye: what light it finds, and by which ways. Kernel-safe: one loop, no recursion.
//
// What is meant to be counted, once each (tests/trace/reference/ counts the same by other means):
//   - Light that has scattered at most `bounces` times at matte and glossy surfaces. Mirrors, and straight or bent
//     passages through clear borders, do not count; all events together are bounded by `events_most`.
//   - At each scattering the sun (or moon) and the lamps are sampled directly, and found by chance, and both weighted
//     (Veach and Guibas 1995, power heuristic); the sky is found by chance alone.
//   - Light on its way from sun or lamp to where it scatters goes straight through water, thin glass and other media:
//     it loses what they mirror, tint and absorb, but is not bent. This is the declared approximation; so after a
//     scattering, a lamp or the sun's disc found by chance behind nothing but borders (clear or rough) since that
//     scattering is not counted: the straight ray has counted it. A lamp found by a mirror is counted; the sun's disc
//     is not: light that water or polished metal throws onto walls from so small a source would be nothing but specks.
//   - Water whose waves are too small for the pixel to see is a Gaussian of slopes (bsdf.h): the eye looks on by one of
//     them, as sharply as by water that it sees as it is; but the sun is sampled there as at a scattering, so that its
//     glitter does not come by chance. It does not count as one.
//   - A rough border (frosted glass) scatters for light from all sides when it is the first scattering; later ones
//     leave what comes through them to the straight ray, and take light from their own side alone.
//   - Mist, and what floats in water and other media, scatter light once, on the way that the eye sees sharply: the
//     first stretch, and those behind mirrors and clear borders. Other stretches lose light to a medium's absorption,
//     none to what scatters it.
//   - Land that the eye sees sharply fades into the sky at the end of the view.
//   - The eye sees the discs of sun and moon as they are drawn, in mirrors and water as bright as they are; lamps as
//     they are painted (seen_emission), everywhere that it sees sharply.
#pragma once

#include "trace/kernel/camera.h"
#include "trace/kernel/path_event.h"

namespace vitrail::trace {

// Blocks that a pixel is wide at distance 1.
VX_HD float pixel_width(const Camera& camera) {
    return 2 * length(camera.up) / float(camera.height);
}

// The sampler of a path, before its first draw. sample: of this frame.
VX_HD Sampler sampler_of_path(const PathSettings& settings, u32 x, u32 y, u32 sample) {
    return make_sampler(x, y, settings.first_sample + sample, settings.seed);
}
// inside: where in its pixel the path starts, unless the film holds all at the same place.
VX_HD Vec3 start_direction(const Camera& camera, u32 x, u32 y, Vec2 inside) {
    const bool held = camera.jitter.x != 0 || camera.jitter.y != 0; // the film says where
    return direction_through(camera, float(x) + (held ? 0.5f + camera.jitter.x : inside.x),
                             float(y) + (held ? 0.5f + camera.jitter.y : inside.y));
}

// x, y: the pixel. sum: of the path, empty.
VX_HD PathState start_path(const Camera& camera, const PathSettings& settings, u32 x, u32 y, u32 sample,
                           PixelSample& sum) {
    PathState path;
    path.sampler = sampler_of_path(settings, x, y, sample);
    path.ray = {camera.eye, start_direction(camera, x, y, next_2d(path.sampler))};
    path.medium = camera.medium;
    path.spread = pixel_width(camera);
    sum = {};
    return path;
}

// The whole sum as a sample: its light over the albedo.
VX_HD void finish_path(PixelSample& sum) {
    sum.light = {sum.light.x / sum.albedo.x, sum.light.y / sum.albedo.y, sum.light.z / sum.albedo.z};
}

// A whole path. rays grows by those that were traced. Other orders of the same steps, many paths at once, come to the
// same sums: trace/cpu/path_stream.h.
VX_HD PixelSample trace_path(const SceneView& scene, const SkyView& sky, const Camera& camera,
                             const PathSettings& settings, u32 x, u32 y, u32 sample, u32& rays) {
    PixelSample sum;
    PathState path = start_path(camera, settings, x, y, sample, sum);
    const float pixel = pixel_width(camera);
    const auto send = [&](const LightRay& to) {
        ++rays;
        Vec3 value = to.value;
        if (light_passes(scene, to.ray, to.distance, to.medium, value)) add_arrived(sum, to.counts, value, settings);
    };
    for (bool on = settings.events_most > 0; on;) {
        Hit hit;
        closest_hit(scene, path.ray, kFar, path.medium, hit);
        ++rays;
        on = path_event(scene, sky, settings, pixel, hit, path, sum, send);
    }
    finish_path(sum);
    return sum;
}

} // namespace vitrail::trace
