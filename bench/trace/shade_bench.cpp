// What a path pays at a hit and at a miss, one core, scalar: numbers, surfaces, sky, air.
#include "bench/trace/benches.h"
#include "scene/sky.h"
#include "trace/kernel/air.h"
#include "trace/kernel/bsdf.h"
#include "trace/kernel/sampler.h"
#include "trace/sky_source.h"

#include <fmt/format.h>

namespace vitrail {

namespace {

using namespace trace;

constexpr u32 kCount = 1 << 14;

// Calls one(i) for many i; it returns a number, so that nothing is left out.
template <class F>
void measure(bench::Context& c, F&& one) {
    c.measure(kCount, [&] {
        float sum = 0;
        for (u32 i = 0; i < kCount; ++i)
            sum += one(i);
        bench::keep(sum);
    });
}

Vec3 upwards(u32 i) { // over the sky, the horizon more than the zenith
    return normalized({float(i % 128) / 64 - 1, float(i / 128) / 100 + 0.01f, 1});
}
SurfacePoint surface(Optics optics, float roughness) {
    SurfacePoint p{};
    p.face = p.normal = {0, 1, 0};
    p.optics = optics;
    p.roughness = roughness;
    p.albedo = {0.5f, 0.4f, 0.3f};
    return p;
}

void add_bsdf(bench::Suite& suite, const char* name, Optics optics, float roughness) {
    const Vec3 eye = normalized({0.6f, 0.8f, 0.1f});
    suite.add(fmt::format("trace.bsdf.sample.{}", name), "ns", "a direction with weight and pdf",
              [=](bench::Context& c) {
                  const SurfacePoint p = surface(optics, roughness);
                  measure(c, [&](u32 i) {
                      const float u = float(i) / kCount;
                      return sample_bsdf(p, eye, u, {u, 0.3f}).weight.x;
                  });
              });
    suite.add(fmt::format("trace.bsdf.eval.{}", name), "ns", "value and pdf together", [=](bench::Context& c) {
        const SurfacePoint p = surface(optics, roughness);
        measure(c, [&](u32 i) {
            const float u = 0.5f * float(i) / kCount;
            return bsdf_at(p, eye, {u, std::sqrt(1 - u * u), 0}).value.x;
        });
    });
}

void add_sky(bench::Suite& suite, const char* name, float time) {
    suite.add(fmt::format("trace.sky.seen.{}", name), "ns", "clouds in it", [=](bench::Context& c) {
        scene::FrameView frame;
        frame.views.resize(1);
        frame.sky = scene::sky_at(time);
        const SkyView sky = sky_view_of(frame);
        measure(c, [&](u32 i) { return sky_seen(sky, upwards(i), 0.0015f, 0.3f).x; });
    });
}

} // namespace

void register_shade_benches(bench::Suite& suite) {
    for (const auto& [name, first] : {std::pair{"first", 0u}, {"later", kDithered}})
        suite.add(fmt::format("trace.sampler.{}", name), "ns",
                  "a pair of numbers; the first are dithered over the screen", [from = first](bench::Context& c) {
                      measure(c, [&](u32 i) {
                          Sampler s = make_sampler(i & 127, i >> 7, 5, 1);
                          s.drawn = from;
                          float sum = 0;
                          for (u32 k = 0; k < kDithered; ++k)
                              sum += next_2d(s).x;
                          return sum;
                      });
                      for (double& t : c.seconds_an_item)
                          t /= kDithered;
                  });
    add_bsdf(suite, "matte", Optics::matte, 0.7f);
    add_bsdf(suite, "metal", Optics::metal, 0.3f);
    add_bsdf(suite, "leaf", Optics::leaf, 1);
    add_bsdf(suite, "ice", Optics::dielectric, 0.4f);
    add_sky(suite, "noon", 6000);
    add_sky(suite, "night", 18000);
    suite.add("trace.sky.light", "ns", "the dome alone", [](bench::Context& c) {
        scene::FrameView frame;
        frame.sky = scene::sky_at(6000);
        const SkyView sky = sky_view_of(frame);
        measure(c, [&](u32 i) { return sky_light(sky, upwards(i)).x; });
    });
    suite.add("trace.air", "ns", "a stretch, what passes, a scattering place", [](bench::Context& c) {
        scene::FrameView frame;
        frame.sky = scene::sky_at(500);
        const SkyView sky = sky_view_of(frame);
        measure(c, [&](u32 i) {
            const AirStretch a = air_stretch(sky, {{0, 70, 0}, {0.5f, 0.5f, 0.5f}}, upwards(i), 60);
            return sample_air_point(a, float(i) / kCount).weight + air_passes(a);
        });
    });
}

} // namespace vitrail
