#include "scene/atmosphere.h"

#include "math/color.h"

#include <algorithm>
#include <array>
#include <vector>

namespace vitrail::scene {

namespace {

// Lengths in kilometers, coefficients a kilometer, for red, green and blue (Hillaire 2020, table 1).
constexpr double kPi = 3.14159265358979;
constexpr double kGround = 6360, kTop = 6460, kEye = 0.25;
constexpr Vec3 kRayleigh{5.802e-3f, 13.558e-3f, 33.1e-3f};
constexpr float kMieScatter = 3.996e-3f, kMieExtinct = 4.440e-3f, kMieForward = 0.80f;
constexpr Vec3 kOzone{0.650e-3f, 1.881e-3f, 0.085e-3f};
constexpr float kRayleighScale = 8.0f, kMieScale = 1.2f;
constexpr float kGroundAlbedo = 0.25f;
// Half the width of the sun's disc as a sine, four times: nothing switches when it touches the horizon, nor where the
// Earth's shadow climbs.
constexpr double kPenumbra = 0.018;

struct Air {
    float rayleigh, mie, ozone; // densities, 1 near the ground (ozone: in its layer)
};
Air air_at(double height) {
    const float h = float(std::max(height, 0.0));
    return {std::exp(-h / kRayleighScale), std::exp(-h / kMieScale), std::max(0.0f, 1 - std::abs(h - 25) / 15)};
}
Vec3 extinction(const Air& a) {
    return kRayleigh * a.rayleigh + kOzone * a.ozone + Vec3{1, 1, 1} * (kMieExtinct * a.mie);
}
Vec3 exp_minus(Vec3 v) {
    return {std::exp(-v.x), std::exp(-v.y), std::exp(-v.z)};
}
double to_top(double r, double mu) {
    return -r * mu + std::sqrt(std::max(r * r * (mu * mu - 1) + kTop * kTop, 0.0));
}
// Below 0 where the ray misses the ground.
double to_ground(double r, double mu) {
    const double d = r * r * (mu * mu - 1) + kGround * kGround;
    return mu < 0 && d >= 0 ? -r * mu - std::sqrt(d) : -1;
}
double height_after(double r, double mu, double t) {
    const double over = (r - kGround) * (r + kGround) + t * t + 2 * r * mu * t; // radius squared less the ground's
    return over / (std::sqrt(over + kGround * kGround) + kGround);
}

// Light left after the way out of the air, by height and the cosine of the zenith angle.
class Transmittance {
public:
    Transmittance() {
        for (u32 j = 0; j < kHeights; ++j)
            for (u32 i = 0; i < kAngles; ++i) {
                const double rho = kHorizon * j / (kHeights - 1), r = std::sqrt(rho * rho + kGround * kGround);
                const double least = kTop - r, most = rho + kHorizon;
                const double d = least + (most - least) * i / (kAngles - 1);
                const double mu =
                    d > 0 ? std::clamp((kHorizon * kHorizon - rho * rho - d * d) / (2 * r * d), -1.0, 1.0) : 1.0;
                Vec3 depth;
                constexpr int steps = 40;
                for (int s = 0; s < steps; ++s) {
                    // Steps grow with the distance from the lower end, where the air is.
                    const double a = double(s) / steps, b = double(s + 1) / steps;
                    const double t = d * 0.5 * (a * a + b * b);
                    depth += extinction(air_at(height_after(r, mu, t))) * float(d * (b * b - a * a));
                }
                texels_[j * kAngles + i] = exp_minus(depth);
            }
    }
    // 0 where the ground is in the way, softly.
    Vec3 at(double r, double mu) const {
        const double rho = std::sqrt(std::max(r * r - kGround * kGround, 0.0));
        const double horizon = -rho / r;
        const float open = smoothstep(float(-kPenumbra), float(kPenumbra), float(mu - horizon));
        if (open <= 0) return {};
        const double least = kTop - r, most = rho + kHorizon;
        const double d = to_top(r, std::max(mu, horizon));
        const float x = float(std::clamp((d - least) / (most - least), 0.0, 1.0)) * (kAngles - 1);
        const float y = float(std::clamp(rho / kHorizon, 0.0, 1.0)) * (kHeights - 1);
        const u32 i = std::min(u32(x), kAngles - 2), j = std::min(u32(y), kHeights - 2);
        const Vec3* p = texels_.data() + j * kAngles + i;
        return lerp(lerp(p[0], p[1], x - float(i)), lerp(p[kAngles], p[kAngles + 1], x - float(i)), y - float(j)) *
               open;
    }

private:
    static constexpr u32 kAngles = 96, kHeights = 32;
    inline static const double kHorizon = std::sqrt(kTop * kTop - kGround * kGround);
    std::array<Vec3, std::size_t(kAngles) * kHeights> texels_;
};

// Light of the second and all further scatterings at a point, for a light of irradiance 1 (Hillaire 2020, section 5.5).
class MultipleScattering {
public:
    explicit MultipleScattering(const Transmittance& through) {
        for (u32 j = 0; j < kHeights; ++j)
            for (u32 i = 0; i < kAngles; ++i) {
                const double r = kGround + 0.02 + (kTop - kGround - 0.04) * squared(double(j) / (kHeights - 1));
                texels_[j * kAngles + i] = compute(through, r, cosine_of(double(i) / (kAngles - 1)));
            }
    }
    Vec3 at(double r, double mu) const {
        const float x = float(0.5 + 0.5 * std::copysign(std::sqrt(std::abs(mu)), mu)) * (kAngles - 1);
        const float y =
            std::sqrt(float(std::clamp((r - kGround - 0.02) / (kTop - kGround - 0.04), 0.0, 1.0))) * (kHeights - 1);
        const u32 i = std::min(u32(x), kAngles - 2), j = std::min(u32(y), kHeights - 2);
        const Vec3* p = texels_.data() + j * kAngles + i;
        return lerp(lerp(p[0], p[1], x - float(i)), lerp(p[kAngles], p[kAngles + 1], x - float(i)), y - float(j));
    }

private:
    static double squared(double v) { return v * v; }
    static double cosine_of(double x) { return std::copysign(squared(2 * x - 1), 2 * x - 1); } // fine at the horizon
    static Vec3 compute(const Transmittance& through, double r, double mu_light) {
        constexpr int rings = 8, sectors = 4, steps = 12;
        const double sin_light = std::sqrt(std::max(1 - mu_light * mu_light, 0.0));
        Vec3 second, again;
        for (int ring = 0; ring < rings; ++ring)
            for (int sector = 0; sector < sectors; ++sector) {
                const double mu = -1 + 2 * (ring + 0.5) / rings, turn = kPi * (sector + 0.5) / sectors;
                const double nu = mu * mu_light + std::sqrt(1 - mu * mu) * sin_light * std::cos(turn);
                const double ground = to_ground(r, mu), d = ground >= 0 ? ground : to_top(r, mu);
                Vec3 left{1, 1, 1};
                for (int s = 0; s < steps; ++s) {
                    const double a = double(s) / steps, b = double(s + 1) / steps;
                    const double t = d * 0.5 * (a * a + b * b), h = height_after(r, mu, t);
                    const Air air = air_at(h);
                    const Vec3 scatter = kRayleigh * air.rayleigh + Vec3{1, 1, 1} * (kMieScatter * air.mie);
                    const Vec3 lost = extinction(air) * float(d * (b * b - a * a));
                    const Vec3 passes = exp_minus(lost);
                    // Scattered along the step and not lost again before its end.
                    const Vec3 e = extinction(air);
                    const Vec3 part = Vec3{(1 - passes.x) / std::max(e.x, 1e-9f), (1 - passes.y) / std::max(e.y, 1e-9f),
                                           (1 - passes.z) / std::max(e.z, 1e-9f)} *
                                      left * scatter;
                    again += part;
                    second +=
                        part * through.at(kGround + h, (r * mu_light + t * nu) / (kGround + h)) * float(1 / (4 * kPi));
                    left = left * passes;
                }
                if (ground >= 0) {
                    const double mu_there = (r * mu_light + d * nu) / kGround;
                    second += left * through.at(kGround + 1e-3, mu_there) *
                              (float(std::max(mu_there, 0.0)) * kGroundAlbedo * float(1 / kPi));
                }
            }
        constexpr float share = 1.0f / (rings * sectors);
        second = second * share, again = again * share;
        return {second.x / (1 - again.x), second.y / (1 - again.y), second.z / (1 - again.z)};
    }
    static constexpr u32 kAngles = 32, kHeights = 12;
    std::array<Vec3, std::size_t(kAngles) * kHeights> texels_;
};

constexpr u32 kSkies = 48;
// Heights of the light in degrees, denser near the horizon where the sky changes fast: -20 .. 0 .. 66.
constexpr float kLowest = 20, kHighest = 66, kBelow = 20, kAbove = float(kSkies - 1) - kBelow, kDense = 1.6f;
float height_of_sky(float k) {
    return k < kBelow ? -kLowest * std::pow((kBelow - k) / kBelow, kDense)
                      : kHighest * std::pow((k - kBelow) / kAbove, kDense);
}
float sky_of_height(float degrees) {
    return degrees < 0 ? kBelow * (1 - std::pow(std::min(-degrees / kLowest, 1.0f), 1 / kDense))
                       : kBelow + kAbove * std::pow(std::min(degrees / kHighest, 1.0f), 1 / kDense);
}

constexpr u32 kTexels = SkyTable::kWidth * SkyTable::kHeight;

struct ClearSkies {
    struct Sky {
        std::array<Vec3, kTexels> pattern; // mean luminance 1
        float brightness = 0;
    };
    Transmittance through;
    std::vector<Sky> skies;
    std::array<float, kTexels> solid_angle;
    ClearSkies();
};

// What a ray of one row meets at one step, the same for every light and azimuth.
struct Step {
    double t, r;
    Vec3 rayleigh, all; // scattered at the step and seen by the eye
    float mie;          // over `all`'s Mie part: kept apart for its phase function
    Vec3 seen;
};

std::vector<Step> steps_of_row(double mu) {
    constexpr int steps = 24;
    const double r = kGround + kEye, d = to_top(r, mu);
    std::vector<Step> out;
    Vec3 depth;
    for (int s = 0; s < steps; ++s) {
        const double a = double(s) / steps, b = double(s + 1) / steps;
        const double length = d * (b * b - a * a);
        Step step;
        step.t = d * 0.5 * (a * a + b * b);
        step.r = kGround + height_after(r, mu, step.t);
        const Air air = air_at(step.r - kGround);
        const Vec3 e = extinction(air), lost = e * float(length), left = exp_minus(depth), passes = exp_minus(lost);
        const Vec3 share = left * Vec3{(1 - passes.x) / std::max(e.x, 1e-9f), (1 - passes.y) / std::max(e.y, 1e-9f),
                                       (1 - passes.z) / std::max(e.z, 1e-9f)};
        step.rayleigh = share * kRayleigh * air.rayleigh;
        step.mie = kMieScatter * air.mie;
        step.seen = share;
        step.all = step.rayleigh + share * step.mie;
        depth += lost;
        out.push_back(step);
    }
    return out;
}

float rayleigh_phase(double nu) {
    return float(3 / (16 * kPi) * (1 + nu * nu));
}
float mie_phase(double nu) { // Cornette and Shanks 1992
    const double g = kMieForward, k = 3 / (8 * kPi) * (1 - g * g) / (2 + g * g);
    return float(k * (1 + nu * nu) / std::pow(1 + g * g - 2 * g * nu, 1.5));
}

double row_sine(u32 row) {
    const double v = double(row) / (SkyTable::kHeight - 1);
    return v * v;
}
double column_cosine(u32 column) { // of the azimuth from the light
    const double s = double(column) / (SkyTable::kWidth - 1);
    return 1 - 2 * s * s;
}

ClearSkies::ClearSkies()
    : skies(kSkies) {
    // Texels stand for what is nearer to them than to others; both halves of azimuth.
    for (u32 row = 0; row < SkyTable::kHeight; ++row)
        for (u32 column = 0; column < SkyTable::kWidth; ++column) {
            const auto border = [](double v, u32 last) { return std::clamp(v, 0.0, double(last)) / last; };
            const double y0 = border(row - 0.5, SkyTable::kHeight - 1), y1 = border(row + 0.5, SkyTable::kHeight - 1);
            const double s0 = border(column - 0.5, SkyTable::kWidth - 1),
                         s1 = border(column + 0.5, SkyTable::kWidth - 1);
            solid_angle[row * SkyTable::kWidth + column] =
                float((y1 * y1 - y0 * y0) * 4 * (std::asin(s1) - std::asin(s0)));
        }
    const MultipleScattering further(through);
    std::vector<std::vector<Step>> rows;
    for (u32 row = 0; row < SkyTable::kHeight; ++row)
        rows.push_back(steps_of_row(row_sine(row)));
    for (u32 k = 0; k < kSkies; ++k) {
        Sky& sky = skies[k];
        const double mu_light = std::sin(double(height_of_sky(float(k))) * kPi / 180);
        const double flat_light = std::sqrt(1 - mu_light * mu_light);
        double sum = 0;
        for (u32 row = 0; row < SkyTable::kHeight; ++row) {
            const double mu = row_sine(row), flat = std::sqrt(1 - mu * mu);
            for (u32 column = 0; column < SkyTable::kWidth; ++column) {
                const double nu = mu * mu_light + flat * flat_light * column_cosine(column);
                const float phase_r = rayleigh_phase(nu), phase_m = mie_phase(nu);
                Vec3 color;
                for (const Step& step : rows[row]) {
                    const double mu_there = ((kGround + kEye) * mu_light + step.t * nu) / step.r;
                    color +=
                        (step.rayleigh * phase_r + step.seen * (step.mie * phase_m)) * through.at(step.r, mu_there);
                    color += step.all * further.at(step.r, mu_there);
                }
                const u32 texel = row * SkyTable::kWidth + column;
                sky.pattern[texel] = color;
                sum += double(luminance_of(color)) * mu * solid_angle[texel];
            }
        }
        sky.brightness = float(sum / kPi);
        for (Vec3& c : sky.pattern)
            c = c * (1 / sky.brightness);
    }
}

const ClearSkies& clear_skies() {
    static const ClearSkies made;
    return made;
}

struct Between {
    u32 first;
    float share;
};
Between skies_around(float sine) {
    const float k = sky_of_height(std::asin(clamp(sine, -1.0f, 1.0f)) * float(180 / kPi));
    const u32 first = std::min(u32(std::max(k, 0.0f)), kSkies - 2);
    return {first, clamp(k - float(first), 0.0f, 1.0f)};
}

} // namespace

Vec3 light_through_air(float sine) {
    return clear_skies().through.at(kGround + kEye, double(sine));
}

float clear_sky_brightness(float sine) {
    const auto [first, share] = skies_around(sine);
    const auto& skies = clear_skies().skies;
    return std::exp(lerp(std::log(skies[first].brightness), std::log(skies[first + 1].brightness), share));
}

void add_clear_sky(SkyTable& table, float sine, bool opposite, SkyBands bands, Vec3 tint) {
    const auto [first, share] = skies_around(sine);
    const auto& skies = clear_skies().skies;
    const Vec3 *a = skies[first].pattern.data(), *b = skies[first + 1].pattern.data();
    SkyTable pattern;
    for (u32 i = 0; i < kTexels; ++i)
        pattern.texels[i] = lerp(a[i], b[i], share) * tint;
    for (u32 row = 0; row < SkyTable::kHeight; ++row) {
        const float v = float(row) / float(SkyTable::kHeight - 1);
        const float y = bands.lowest + (1 - bands.lowest) * v * (bands.stretch + (1 - bands.stretch) * v * v);
        for (u32 column = 0; column < SkyTable::kWidth; ++column) {
            const float s = float(column) / float(SkyTable::kWidth - 1);
            // Seen from the other end the sine of half the angle is its cosine.
            const float x = opposite ? std::sqrt(1 - s * s) : s;
            table.texels[row * SkyTable::kWidth + column] += sky_table_at(pattern, {x, y});
        }
    }
}

float sky_texel_solid_angle(u32 column, u32 row) {
    return clear_skies().solid_angle[row * SkyTable::kWidth + column];
}

} // namespace vitrail::scene
