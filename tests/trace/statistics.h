// Means with their error, of pictures made by two ways.
#pragma once

#include "math/color.h"
#include "trace/reference/reference.h"

namespace vitrail::test {

struct Tally {
    double sum = 0, sum2 = 0, count = 0;
    void add(double v) { sum += v, sum2 += v * v, count += 1; }
    double mean() const { return sum / count; }
    double variance_of_mean() const { return std::max(0.0, sum2 / count - mean() * mean()) / count; }
};

// Colors of a picture's blocks of pixels, and of the whole.
struct PictureTally {
    static constexpr u32 kAcross = 4, kDown = 3;
    Tally blocks[kAcross * kDown]; // luminance
    Tally whole[3];                // red, green, blue
    void add(const trace::Camera& c, u32 x, u32 y, Vec3 v) {
        blocks[x * kAcross / c.width + y * kDown / c.height * kAcross].add(double(luminance_of(v)));
        whole[0].add(double(v.x)), whole[1].add(double(v.y)), whole[2].add(double(v.z));
    }
};

inline PictureTally tally_paths(const TestScene& s, u32 samples) {
    PictureTally t;
    u32 rays = 0;
    for (u32 y = 0; y < s.camera.height; ++y)
        for (u32 x = 0; x < s.camera.width; ++x)
            for (u32 i = 0; i < samples; ++i)
                t.add(s.camera, x, y, trace::radiance_of(s.sample(x, y, i, rays)));
    return t;
}

inline PictureTally tally_reference(const TestScene& s, u32 samples, u32 seed = 1) {
    PictureTally t;
    Reference reference(s, seed);
    for (u32 y = 0; y < s.camera.height; ++y)
        for (u32 x = 0; x < s.camera.width; ++x)
            for (u32 i = 0; i < samples; ++i)
                t.add(s.camera, x, y, reference.sample(x, y));
    return t;
}

// How many standard errors two means are apart.
inline double apart(const Tally& a, const Tally& b) {
    const double sigma = std::sqrt(a.variance_of_mean() + b.variance_of_mean());
    return sigma > 0 ? std::abs(a.mean() - b.mean()) / sigma : a.mean() == b.mean() ? 0 : 1e9;
}
inline double relative_error(const Tally& a, const Tally& b) {
    return std::sqrt(a.variance_of_mean() + b.variance_of_mean()) / std::max(1e-9, b.mean());
}

} // namespace vitrail::test
