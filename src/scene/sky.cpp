#include "scene/sky.h"

#include "math/color.h"
#include "scene/atmosphere.h"

#include <algorithm>
#include <array>

namespace vitrail::scene {

namespace {

constexpr float kTurn = 6.2831853f;
constexpr float kTilt = 0.45f; // of the sun's path towards the south, radians: shadows never fall straight down

// ---- What eyes want: everything that is not physics stands here. ----

// What white sends back at noon (the unit of sky.h); all other numbers here are shares of it.
constexpr float kNoonWhite = 2;
// Mean radiance of the dome by the sun's height in degrees. The pattern and its colors are the air's; only how bright
// it is as a whole falls slower than in nature.
struct Brightness {
    float degrees, value;
};
constexpr std::array<Brightness, 11> kDome{{{-20, 0.0001f},
                                            {-15, 0.0020f},
                                            {-11, 0.0080f},
                                            {-8, 0.019f},
                                            {-5, 0.044f},
                                            {-2, 0.088f},
                                            {3, 0.140f},
                                            {9, 0.180f},
                                            {20, 0.205f},
                                            {40, 0.230f},
                                            {66, 0.240f}}};
// Towards the low sun the air is a hundred times brighter than opposite, more than a picture holds: radiance over the
// mean, L, becomes L (1 + low L) / (1 + high L).
constexpr float kGlareLow = 0.020f, kGlareHigh = 0.42f, kGlareHighByDay = 0.10f;
// At dusk the bands over the horizon are drawn higher (SkyBands) and their colors purer.
constexpr float kDuskStretch = 0.55f, kDuskSaturation = 1.18f;
// By day the whitest haze stays below the horizon, and blue is a little bluer.
constexpr float kDayLowest = 0.28f, kDaySaturation = 1.12f;
constexpr Vec3 kDuskTint{1.12f, 0.90f, 0.94f};
// Direct light reddens less than in nature, by this power of what the air lets through: orange, not blood.
constexpr float kReddening = 0.70f;
constexpr float kSunLight = 0.93f;
constexpr float kCloudsFadeFrom = -7.0f, kCloudsFadeTo = 1.5f;
constexpr float kSunFadesFrom = -0.8f, kSunFadesTo = 4.5f; // degrees; long before shadows grow endless
// The moon: a sun of this light and color. Real moonlight is no bluer than sunlight, but night is blue to eyes.
constexpr Vec3 kMoonLight{0.0105f, 0.0150f, 0.0275f};
constexpr float kMoonDome = 0.0032f;
constexpr Vec3 kMoonDomeTint{0.80f, 0.95f, 1.35f};
constexpr float kMoonRisesFrom = 5.0f, kMoonRisesTo = 14.0f; // degrees
constexpr float kNewMoon = 0.30f;                            // light of a new moon, of a full one's
// Airglow and the light of all stars together: never quite black.
constexpr Vec3 kStarlight{0.0009f, 0.0013f, 0.0028f};
constexpr Vec3 kGround{0.20f, 0.19f, 0.15f}; // albedo of the land all around

// ----

Vec3 on_path(float angle) {
    return normalized({std::cos(angle), std::sin(angle) * std::cos(kTilt), std::sin(angle) * std::sin(kTilt)});
}

float degrees_up(float sine) {
    return std::asin(clamp(sine, -1.0f, 1.0f)) * (360 / kTurn);
}

// Through the points of kDome, smooth in the logarithm (cubic Hermite with slopes of the neighbors).
float dome_brightness(float degrees) {
    const auto& t = kDome;
    if (degrees <= t.front().degrees) return t.front().value;
    if (degrees >= t.back().degrees) return t.back().value;
    u32 i = 0;
    while (degrees > t[i + 1].degrees)
        ++i;
    const auto log_of = [&](u32 k) { return std::log(t[k].value); };
    const auto slope = [&](u32 k) {
        const u32 a = k > 0 ? k - 1 : 0, b = std::min(k + 1, u32(t.size()) - 1);
        return (log_of(b) - log_of(a)) / (t[b].degrees - t[a].degrees);
    };
    const float width = t[i + 1].degrees - t[i].degrees, x = (degrees - t[i].degrees) / width, x2 = x * x, x3 = x2 * x;
    return std::exp(log_of(i) * (2 * x3 - 3 * x2 + 1) + log_of(i + 1) * (3 * x2 - 2 * x3) +
                    width * (slope(i) * (x3 - 2 * x2 + x) + slope(i + 1) * (x3 - x2)));
}

Vec3 power(Vec3 v, float p) {
    return {std::pow(v.x, p), std::pow(v.y, p), std::pow(v.z, p)};
}

void soften_glare(SkyTable& dome, float high, float saturation, float brightness) {
    for (Vec3& c : dome.texels) {
        const float l = luminance_of(c), softer = brightness * (1 + kGlareLow * l) / (1 + high * l);
        const Vec3 pure = Vec3{l, l, l} + (c - Vec3{l, l, l}) * saturation;
        c = Vec3{std::max(pure.x, 0.1f * c.x), std::max(pure.y, 0.1f * c.y), std::max(pure.z, 0.1f * c.z)} * softer;
    }
}

// How much of the moon is lit, 0..1.
float moon_lit(u32 phase) {
    return 0.5f + 0.5f * std::cos(float(phase) / 8 * kTurn);
}

// The direction of a texel's middle.
struct Directions {
    std::array<Vec2, SkyTable::kWidth> columns; // along and across the sun's azimuth
    std::array<Vec2, SkyTable::kHeight> rows;   // flat length and height
};
const Directions& directions() {
    static const Directions made = [] {
        Directions d;
        for (u32 c = 0; c < SkyTable::kWidth; ++c) {
            const float s = float(c) / float(SkyTable::kWidth - 1), along = 1 - 2 * s * s;
            d.columns[c] = {along, std::sqrt(std::max(1 - along * along, 0.0f))};
        }
        for (u32 r = 0; r < SkyTable::kHeight; ++r) {
            const float v = float(r) / float(SkyTable::kHeight - 1), y = v * v;
            d.rows[r] = {std::sqrt(1 - y * y), y};
        }
        return d;
    }();
    return made;
}

// Light of the level ground, the same in every direction: what dome and direct light send to it, times its albedo.
Vec3 ground_light(Vec3 dome_on_ground, const SkyState& sky) {
    const float up = std::max(sky.sun_direction.y >= 0 ? sky.sun_direction.y : sky.moon_direction.y, 0.0f);
    return (dome_on_ground + sky.sun_light * up) * kGround;
}

void gather_irradiance(SkyState& sky) {
    const Directions& to = directions();
    // In the sun's own frame (x towards it) both halves of azimuth are alike: terms odd in z are 0.
    Irradiance sum{};
    Vec3 on_ground;
    for (u32 r = 0; r < SkyTable::kHeight; ++r)
        for (u32 c = 0; c < SkyTable::kWidth; ++c) {
            const float share = sky_texel_solid_angle(c, r);
            const Vec3 light = sky.dome.texels[r * SkyTable::kWidth + c];
            const Vec3 d{to.rows[r].x * to.columns[c].x, to.rows[r].y, to.rows[r].x * to.columns[c].y};
            add_light(sum, d, light, share * 0.5f);
            add_light(sum, {d.x, d.y, -d.z}, light, share * 0.5f);
            on_ground += light * (share * d.y * (2 / kTurn));
        }
    sky.ambient = on_ground;
    // A lower half of even light: band 0 half the full sphere's, band 1 straight down, band 2 nothing.
    const Vec3 ground = ground_light(on_ground, sky);
    sum.c[0] += ground * 0.5f;
    sum.c[1] += ground * -0.5f;
    // Turned about y to where the sun stands: x' = (a, b) there.
    const float a = sky.sun_azimuth.x, b = sky.sun_azimuth.y;
    const auto& s = sum.c;
    Irradiance& out = sky.irradiance;
    out.c[0] = s[0];
    out.c[1] = s[1];
    out.c[2] = s[3] * b + s[2] * a;
    out.c[3] = s[3] * a - s[2] * b;
    out.c[4] = s[4] * a - s[5] * b;
    out.c[5] = s[4] * b + s[5] * a;
    // In the plane of x and z: xx-yy and 3zz-1 hold yy, zz-xx and xz; only the latter two turn into each other.
    // f = c6 (3zz-1) + c8 (xx-yy), on the sphere with yy = 1-xx-zz: = (2 c8 + c6... written out below.
    const Vec3 p = s[8] * 2.0f, q = s[6] * 3.0f + s[8]; // f = p xx + q zz + m xz + constant (yy put away)
    const Vec3 m = s[7], constant = -s[6] - s[8];
    // x = a x' + b z', z = -b x' + a z' (x, z in the sun's frame; x', z' in the world's)
    const Vec3 pw = p * (a * a) + q * (b * b) - m * (a * b);
    const Vec3 qw = p * (b * b) + q * (a * a) + m * (a * b);
    out.c[7] = (p - q) * (2 * a * b) + m * (a * a - b * b);
    // Back: c8 = pw / 2, 3 c6 + c8 = qw; the constant is the same.
    out.c[8] = pw * 0.5f;
    out.c[6] = (qw - out.c[8]) * (1.0f / 3);
    out.c[0] += constant + out.c[6] + out.c[8];
}

} // namespace

SkyState sky_at(float time, u64 day) {
    SkyState sky;
    float t = std::fmod(time, 24000.0f);
    if (t < 0) t += 24000.0f;
    sky.time = t;
    const float angle = t / 24000.0f * kTurn;
    sky.star_turn = angle;
    sky.sun_direction = on_path(angle);
    sky.moon_direction = -sky.sun_direction;
    sky.pole = {0, -std::sin(kTilt), std::cos(kTilt)};
    sky.moon_phase = u32((t < 6000 ? day + 7 : day) % 8);
    const float sine = sky.sun_direction.y, height = degrees_up(sine);
    const float flat =
        1 / std::sqrt(sky.sun_direction.x * sky.sun_direction.x + sky.sun_direction.z * sky.sun_direction.z);
    sky.sun_azimuth = {sky.sun_direction.x * flat, sky.sun_direction.z * flat};

    const Vec3 sun_color = power(light_through_air(sine), kReddening);
    const Vec3 moon_color = power(light_through_air(-sine), kReddening);
    const float moon = lerp(kNewMoon, 1.0f, moon_lit(sky.moon_phase));
    const float moon_up = smoothstep(kMoonRisesFrom, kMoonRisesTo, -height);
    sky.sun_light = (sun_color * (kSunLight * smoothstep(kSunFadesFrom, kSunFadesTo, height)) +
                     moon_color * kMoonLight * (moon * moon_up * 3)) *
                    kNoonWhite;
    sky.sun_disc = sun_color * kNoonWhite;
    sky.moon_disc = moon_color * kNoonWhite;
    // High up the sun rises sooner and sets later, and colors clouds from below.
    const float at_clouds = smoothstep(kCloudsFadeFrom, kCloudsFadeTo, height);
    sky.cloud_light = (power(light_through_air(std::max(sine, 0.0f) + 0.022f), kReddening) * (kSunLight * at_clouds) +
                       moon_color * kMoonLight * (moon * moon_up * 3)) *
                      kNoonWhite;
    sky.cloud_direction = height > kCloudsFadeFrom ? sky.sun_direction : sky.moon_direction;
    sky.stars = smoothstep(-4.0f, -14.0f, height);

    const float brightness = dome_brightness(height);
    sky.dome = {};
    const float dusk = smoothstep(16.0f, 2.0f, height);
    add_clear_sky(sky.dome, sine, false, {lerp(1.0f, kDuskStretch, dusk), lerp(kDayLowest, 0.0f, dusk)},
                  lerp(Vec3{1, 1, 1}, kDuskTint, dusk));
    soften_glare(sky.dome, lerp(kGlareHighByDay, kGlareHigh, dusk), lerp(kDaySaturation, kDuskSaturation, dusk),
                 brightness);
    if (height < 0) add_clear_sky(sky.dome, -sine, true, {1, kDayLowest}, kMoonDomeTint * (kMoonDome * moon * moon_up));
    for (u32 r = 0; r < SkyTable::kHeight; ++r) {
        const float y = directions().rows[r].y, near_horizon = 1 + 0.8f * (1 - y) * (1 - y);
        for (u32 c = 0; c < SkyTable::kWidth; ++c) {
            Vec3& texel = sky.dome.texels[r * SkyTable::kWidth + c];
            texel = (texel + kStarlight * near_horizon) * kNoonWhite;
        }
    }
    gather_irradiance(sky);
    return sky;
}

Vec3 sky_color(const SkyState& sky, Vec3 d) {
    return sky_table_at(sky.dome, sky_table_place(d, sky.sun_azimuth));
}

Vec3 sky_irradiance(const SkyState& sky, Vec3 n) {
    const Vec3 sum = irradiance_of(sky.irradiance, n);
    return {std::max(sum.x, 0.0f), std::max(sum.y, 0.0f), std::max(sum.z, 0.0f)};
}

Vec3 surrounding_light(const SkyState& sky, Vec3 d) {
    return d.y >= 0 ? sky_color(sky, d) : ground_light(sky.ambient, sky);
}

} // namespace vitrail::scene
