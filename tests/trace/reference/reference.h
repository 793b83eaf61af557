// Ground truth for path.h: the same light by brute force. A recursion; directions even over the whole sphere, whatever
// the surface; nothing is aimed at a light, nothing weighted or ended by chance; numbers by a Mersenne twister; media,
// borders and fog by code of its own. It shares with the integrator what has tests of its own: the nearest hit
// (traverse_*), what a surface is (content_*), the value of a BSDF (bsdf_test), and the light of the sky.
//
// What is counted is said at the head of path.h. So from a scattering a straight ray is followed through borders for
// the light of sun and lamps, and the true way for all other light.
#pragma once

#include "trace/kernel/surface_point.h"
#include "trace/scenes.h"

#include <random>

namespace vitrail::test {

class Reference {
public:
    Reference(const TestScene& scene, u32 seed)
        : scene_(scene)
        , random_(seed) {}
    // One estimate of a pixel's radiance.
    Vec3 sample(u32 x, u32 y);

private:
    // How light got here since the last scattering.
    enum class Way { eye, next, borders, mirrors };
    Vec3 light_from(const trace::Ray& ray, u32 medium, u32 bounces, u32 events, Way way, bool sharp, bool bent,
                    float before, float wide, float spread);
    Vec3 wave_at_random(const trace::SurfacePoint& p, Vec3 eye, float& seen);
    Vec3 straight_light(trace::Ray ray, u32 medium, bool sky_too, bool first_too, bool lamps = true);
    Vec3 scattered_in(const trace::Ray& ray, float length, u32 medium);
    Vec3 left(const trace::Ray& ray, float length, u32 medium, bool mist) const;
    double density(trace::Place at) const;
    float length_of_pixel() const;
    float unit() { return std::uniform_real_distribution<float>(0, 1)(random_); }
    Vec3 direction();

    const TestScene& scene_;
    std::mt19937 random_;
};

} // namespace vitrail::test
