#include "trace/reference/reference.h"

#include "trace/kernel/air.h"
#include "trace/kernel/path_event.h"
#include "trace/kernel/sky.h"
#include "trace/kernel/surface.h"
#include "trace/kernel/traverse.h"

namespace vitrail::test {

using namespace trace;

namespace {

constexpr double kPiD = 3.14159265358979;

bool sharp_border(const SurfacePoint& p) {
    return (p.optics == Optics::water || p.optics == Optics::dielectric) && p.roughness < kSharpest;
}
bool sharp_metal(const SurfacePoint& p) {
    return p.optics == Optics::metal && p.roughness < kSharpest;
}

// Unpolarized reflectance by the amplitudes of both polarizations (Fresnel), angles by Snell's law.
double mirrored_share(double cosine, double index) {
    const double in = std::acos(std::min(1.0, cosine)), sine = std::sin(in) / index;
    if (sine >= 1) return 1;
    const double out = std::asin(sine);
    const double s = (std::cos(in) - index * std::cos(out)) / (std::cos(in) + index * std::cos(out)),
                 p = (index * std::cos(in) - std::cos(out)) / (index * std::cos(in) + std::cos(out));
    return (s * s + p * p) / 2;
}

// A lamp as the eye has it: the strongest channel by its logarithm, the colors in the proportion of the picture's.
Vec3 as_seen(const StateRecord& r, Vec3 emission) {
    const double e[3] = {emission.x, emission.y, emission.z};
    double color[3], most = 0, strongest = 0;
    for (int c = 0; c < 3; ++c) {
        color[c] = r.emission[c] ? e[c] / (r.emission[c] * double(StateRecord::kEmissionUnit)) : 0;
        most = std::max(most, color[c]), strongest = std::max(strongest, e[c]);
    }
    if (most <= 0) return {};
    const double bright = std::log1p(strongest) / most;
    return {float(color[0] * bright), float(color[1] * bright), float(color[2] * bright)};
}

Vec3 times(Vec3 a, double s) {
    return a * float(s);
}

// The cell across a face: its neighbor, with the place's coordinates there.
Place beyond(const SurfacePoint& p, Vec3 dir) {
    Place at = p.at;
    float* c[3] = {&at.at.x, &at.at.y, &at.at.z};
    i32* cell[3] = {&at.cell.x, &at.cell.y, &at.cell.z};
    if (p.inner == at.cell) return at;
    const float d[3] = {dir.x, dir.y, dir.z}, n[3] = {p.face.x, p.face.y, p.face.z};
    for (int a = 0; a < 3; ++a) {
        if (std::abs(n[a]) < 0.5f) continue;
        *cell[a] += d[a] > 0 ? 1 : -1;
        *c[a] = d[a] > 0 ? 0.0f : 1.0f;
    }
    return at;
}

} // namespace

Vec3 Reference::direction() { // by rejection
    for (;;) {
        const Vec3 v{2 * unit() - 1, 2 * unit() - 1, 2 * unit() - 1};
        const float l2 = dot(v, v);
        if (l2 > 1e-4f && l2 <= 1) return v * (1 / std::sqrt(l2));
    }
}

double Reference::density(Place at) const {
    const double above = double(at.cell.y - scene_.sky.sea_level) + double(at.at.y);
    return double(scene_.sky.haze) +
           double(scene_.sky.mist) * (above > 0 ? std::exp(-above / double(scene_.sky.mist_height)) : 1);
}

Vec3 Reference::left(const Ray& ray, float length, u32 medium, bool mist) const {
    if (medium) {
        Vec3 a = scene_.media[medium].absorption;
        if (mist) a = a + scene_.media[medium].scattering; // else what floats in it sends on what it takes
        const double l = length;
        return {float(std::exp(-double(a.x) * l)), float(std::exp(-double(a.y) * l)),
                float(std::exp(-double(a.z) * l))};
    }
    if (!mist) return {1, 1, 1};
    const double l = length < kFar ? double(length) : double(scene_.sky.view_distance);
    double depth = 0;
    constexpr int n = 64;
    for (int i = 0; i < n; ++i)
        depth += density(moved(ray.from, ray.dir, float(l * (i + 0.5) / n))) * l / n;
    const float t = float(std::exp(-depth));
    return {t, t, t};
}

// What one place on the way sends here, by a place and a direction at random.
Vec3 Reference::scattered_in(const Ray& ray, float length, u32 medium) {
    Vec3 coefficient;
    float l = length;
    if (medium) {
        if (l > 200) l = 200; // nothing is left of it there
        coefficient = scene_.media[medium].scattering;
    } else {
        if (!(scene_.sky.haze + scene_.sky.mist > 0)) return {};
        if (!(l < kFar)) l = scene_.sky.view_distance;
    }
    const float t = unit() * l;
    const Place at = moved(ray.from, ray.dir, t);
    if (!medium) coefficient = times({1, 1, 1}, density(at));
    const Vec3 dir = direction();
    const double g = 0.6, c = dot(dir, ray.dir);
    const double forward = (1 - g * g) / std::pow(1 + g * g - 2 * g * c, 1.5);
    const double phase = (medium ? 1 : 0.15 + 0.85 * forward) / (4 * kPiD);
    const Vec3 in = straight_light({at, dir}, medium, true, true);
    return times(coefficient * left(ray, t, medium, true) * in, phase * 4 * kPiD * double(l));
}

// Light of sun and lamps (and sky) along a straight ray through borders. first_too: also of what it meets before any.
Vec3 Reference::straight_light(Ray ray, u32 medium, bool sky_too, bool first_too, bool lamps) {
    Vec3 carried{1, 1, 1};
    for (int crossed = 0; crossed < 64; ++crossed) {
        Hit hit;
        const bool met = closest_hit(scene_.view, ray, kFar, medium, hit);
        carried = carried * left(ray, met ? hit.t : kFar, medium, false);
        if (!met) {
            if (crossed == 0 && !first_too) return {};
            Vec3 found = sun_radiance(scene_.sky, ray.dir);
            if (sky_too) found += sky_light(scene_.sky, ray.dir);
            return carried * found;
        }
        const SurfacePoint p = surface_at(scene_.view, ray, hit, 0);
        switch (p.optics) {
        case Optics::thin: {
            // Two faces that mirror the same share, the light between them going to and fro.
            const double f = mirrored_share(std::abs(double(dot(p.normal, ray.dir))), p.ior);
            carried = carried * times(p.albedo, double(1 - p.opacity) * (1 - f) / (1 + f));
            break;
        }
        case Optics::dielectric:
        case Optics::water: {
            const double index = p.ior > 1 ? double(p.ior) : 1 / double(p.ior);
            carried = carried * times(p.albedo, 1 - mirrored_share(std::abs(double(dot(p.face, ray.dir))), index));
            medium = p.medium_behind;
            break;
        }
        default:
            return !lamps || (crossed == 0 && !first_too) ? Vec3{} : carried * p.emission;
        }
        ray.from = beyond(p, ray.dir);
    }
    return {};
}

// One wave of those that are too small to be seen, at random: its normal by the Gaussian of all slopes. seen: how much
// of it is, over the mean of all.
Vec3 Reference::wave_at_random(const SurfacePoint& p, Vec3 eye, float& seen) {
    const double side = p.face.y > 0 ? 1 : -1, ox = side * double(eye.x), oy = side * double(eye.y),
                 oz = side * double(eye.z);
    const double mx = -double(p.normal.x) / double(p.normal.y), mz = -double(p.normal.z) / double(p.normal.y);
    const double xx = p.waves.xx, xz = p.waves.xz, zz = p.waves.zz;
    std::normal_distribution<double> gauss;
    const double a = gauss(random_), b = gauss(random_);
    const double x = mx + std::sqrt(xx) * a, z = mz + xz / std::sqrt(xx) * a + std::sqrt(zz - xz * xz / xx) * b;
    const double mean = oy - ox * mx - oz * mz, deviation = std::sqrt(ox * ox * xx + 2 * ox * oz * xz + oz * oz * zz),
                 c = mean / deviation;
    const double all =
        mean * 0.5 * std::erfc(-c / std::sqrt(2.0)) + deviation * std::exp(-0.5 * c * c) / std::sqrt(2 * kPiD);
    seen = float(std::max(0.0, oy - ox * x - oz * z) / all);
    return normalized(Vec3{float(-side * x), float(side), float(-side * z)});
}

// wide, spread: the eye's cone at the ray's start, in blocks, and what it grows a block.
Vec3 Reference::light_from(const Ray& ray, u32 medium, u32 bounces, u32 events, Way way, bool sharp, bool bent,
                           float before, float wide, float spread) {
    if (events == scene_.settings.events_most) return {};
    Hit hit;
    const bool met = closest_hit(scene_.view, ray, kFar, medium, hit);
    const float length = met ? hit.t : kFar;
    const bool fog = sharp && scene_.settings.fog;
    Vec3 sum = fog ? scattered_in(ray, length, medium) : Vec3{};
    Vec3 carried = left(ray, length, medium, fog);
    const float pixel = 2 * length_of_pixel();
    if (!met) {
        Vec3 found = sharp ? sky_seen(scene_.sky, ray.dir, pixel, unit()) : sky_light(scene_.sky, ray.dir);
        if (sharp ? bent && way != Way::borders : way == Way::next || way == Way::eye)
            found += sun_radiance(scene_.sky, ray.dir);
        return sum + carried * found;
    }
    wide += spread * length;
    // Textures are as fine as they are; waves are filtered, which is as true.
    const SurfacePoint p = surface_at(scene_.view, ray, hit, sharp && hit.quad == kLiquidSurface ? wide : 0.0f);
    const float whole = before + length;
    if (sharp && scene_.sky.open) { // far land fades into the sky
        const double x = double(whole) / double(scene_.sky.view_distance), x2 = x * x;
        const double faded = std::min(1.0, 0.9 * x2 * x2 + 0.12 * x2) * double(scene_.sky.open_air);
        sum += times(carried * sky_dome(scene_.sky, ray.dir), faded);
        carried = times(carried, 1 - faded);
    }
    if (sharp || way != Way::borders)
        sum += carried * (sharp ? as_seen(scene_.view.states[hit.state], p.emission) : p.emission);

    const Vec3 eye = -ray.dir;
    if (p.optics == Optics::water && !sharp_border(p)) {
        // Far water: on by one of its waves, which is seen as sharply as they let it; not counted as a scattering.
        // The sun shines on it straight through borders.
        float seen;
        const Vec3 wave = wave_at_random(p, eye, seen);
        if (!(seen > 0)) return sum;
        const double c = std::min(1.0, double(dot(eye, wave))), index = p.ior;
        const bool through = unit() >= mirrored_share(c, index);
        Vec3 next = ray.dir + times(wave, 2 * c);
        if (through)
            next = normalized(times(ray.dir, 1 / index) +
                              times(wave, c / index - std::sqrt(1 - (1 - c * c) / (index * index))));
        if ((next.y * p.face.y < 0) != through) next.y = -next.y;
        const Ray on{through ? beyond(p, next) : p.at, next};
        const u32 inside = through ? p.medium_behind : medium;
        const float grows = spread + spread_by_waves(p, through);
        const Vec3 found = light_from(on, inside, bounces, events + 1, Way::next, true, true, whole, wide, grows) +
                           straight_light(on, inside, false, false, false);
        return sum + times(carried * found, double(seen));
    }
    // Exact mirrors and passages, one at random.
    if (sharp_border(p) || sharp_metal(p) || (p.optics == Optics::thin && unit() >= p.opacity)) {
        Vec3 next = ray.dir - times(p.normal, 2 * double(dot(ray.dir, p.normal)));
        if (sharp_metal(p)) {
            if (dot(next, p.face) <= 0) return sum;
            const double c = dot(eye, p.normal), s = std::pow(1 - c, 5.0);
            const Vec3 color = times(p.albedo, 1 - s) + times({1, 1, 1}, s);
            return sum + carried * color *
                             light_from({p.at, next}, medium, bounces, events + 1, way == Way::eye ? way : Way::mirrors,
                                        sharp, true, whole, wide, spread);
        }
        const bool thin = p.optics == Optics::thin;
        const double f = mirrored_share(double(dot(eye, p.normal)), p.ior), share = thin ? 2 * f / (1 + f) : f;
        if (unit() < share) {
            if (dot(next, p.face) <= 0) {
                if (thin) return sum;
                next = next - times(p.face, 2 * double(dot(next, p.face)));
            }
            return sum + carried * light_from({p.at, next}, medium, bounces, events + 1,
                                              way == Way::eye ? way : Way::mirrors, sharp, true, whole, wide, spread);
        }
        Vec3 on = ray.dir;
        if (!thin) { // Snell
            const double c = dot(eye, p.normal), index = p.ior, s2 = (1 - c * c) / (index * index);
            on = normalized(times(ray.dir, 1 / index) + times(p.normal, c / index - std::sqrt(1 - s2)));
            if (dot(on, p.face) >= 0) on = on - times(p.face, 2 * double(dot(on, p.face)));
        }
        const Way then = way == Way::eye ? way : way == Way::mirrors ? way : Way::borders;
        return sum + carried * p.albedo *
                         light_from({beyond(p, on), on}, thin ? medium : u32(p.medium_behind), bounces, events + 1,
                                    then, sharp, bent || !thin, whole, wide, spread);
    }
    if (bounces == scene_.settings.bounces) return sum;

    const Vec3 dir = direction();
    const bool through = dot(dir, p.face) < 0;
    Vec3 value = times(eval_bsdf(p, eye, dir), 4 * kPiD);
    if (p.optics == Optics::thin) value = times(value, 1 / double(p.opacity)); // it came out as paint
    if (!(value.x > 0 || value.y > 0 || value.z > 0)) return sum;
    const bool border = p.optics == Optics::dielectric;
    const Ray next{through ? beyond(p, dir) : p.at, dir};
    const u32 inside = border && through ? p.medium_behind : medium;
    // A rough border behind a scattering: the straight ray from there has counted what comes through.
    if (border && through && !sharp && (way == Way::next || way == Way::borders))
        return sum +
               carried * value * light_from(next, inside, bounces + 1, events + 1, Way::borders, false, true, 0, 0, 0);
    return sum + carried * value *
                     (light_from(next, inside, bounces + 1, events + 1, Way::next, false, true, 0, 0, 0) +
                      straight_light(next, inside, false, false));
}

float Reference::length_of_pixel() const {
    return length(scene_.camera.up) / float(scene_.camera.height);
}

Vec3 Reference::sample(u32 x, u32 y) {
    const Vec3 dir = direction_through(scene_.camera, float(x) + unit(), float(y) + unit());
    return light_from({scene_.camera.eye, dir}, scene_.camera.medium, 0, 0, Way::eye, true, false, 0, 0,
                      2 * length_of_pixel());
}

} // namespace vitrail::test
