#include "scene/sky.h"

namespace vitrail::scene {

namespace {

// Sine by our own polynomial is not needed here: the sky may differ by rounding between devices.
constexpr float kTurn = 6.2831853f;
constexpr float kTilt = 0.45f; // of the sun's path towards the south, radians: shadows never fall straight down

Vec3 on_path(float angle) {
    return normalized({std::cos(angle), std::sin(angle) * std::cos(kTilt), std::sin(angle) * std::sin(kTilt)});
}

} // namespace

SkyState sky_at(float time) {
    SkyState sky;
    float t = std::fmod(time, 24000.0f);
    if (t < 0) t += 24000.0f;
    sky.time = t;
    const float angle = t / 24000.0f * kTurn;
    sky.sun_direction = on_path(angle);
    sky.moon_direction = -sky.sun_direction;
    const float up = sky.sun_direction.y;
    const float day = smoothstep(-0.12f, 0.28f, up);
    const float night = smoothstep(0.02f, -0.22f, up);
    const float dusk = smoothstep(0.42f, 0.04f, up) * smoothstep(-0.30f, -0.02f, up);
    // The sun grows white as it climbs; both lights are gone at the horizon, where they take over from each other.
    const Vec3 sun = lerp(Vec3{1.0f, 0.38f, 0.10f}, Vec3{1.0f, 0.91f, 0.76f}, smoothstep(0.0f, 0.45f, up));
    const float sun_strength = 1.95f * smoothstep(-0.02f, 0.30f, up);
    const Vec3 moon{0.32f, 0.44f, 0.75f};
    const float moon_strength = 0.30f * smoothstep(0.02f, 0.30f, -up);
    sky.sun_light = sun * sun_strength + moon * moon_strength;
    const Vec3 ambient_day{0.62f, 0.76f, 1.0f}, ambient_night{0.050f, 0.066f, 0.112f};
    sky.ambient = lerp(ambient_night, ambient_day * 0.58f, day) + Vec3{0.16f, 0.075f, 0.06f} * dusk;
    sky.zenith =
        lerp(Vec3{0.0028f, 0.0050f, 0.0150f}, Vec3{0.085f, 0.235f, 0.680f}, day) + Vec3{0.012f, 0.004f, 0.030f} * dusk;
    sky.horizon =
        lerp(Vec3{0.0100f, 0.0160f, 0.0360f}, Vec3{0.36f, 0.56f, 0.86f}, day) + Vec3{0.20f, 0.055f, 0.010f} * dusk;
    sky.glow = Vec3{1.10f, 0.36f, 0.08f} * dusk + Vec3{0.30f, 0.26f, 0.18f} * (day * (1.0f - dusk));
    // More from above; a little comes back from the ground in the sun's color.
    sky.irradiance[0] = sky.ambient * 0.775f + sky.sun_light * 0.05f;
    sky.irradiance[1] = sky.ambient * 0.225f - sky.sun_light * 0.05f;
    sky.fog = sky.horizon;
    sky.stars = night;
    return sky;
}

Vec3 sky_irradiance(const SkyState& sky, Vec3 n) {
    const Vec3* c = sky.irradiance;
    const Vec3 sum = c[0] + c[1] * n.y + c[2] * n.z + c[3] * n.x + c[4] * (n.x * n.y) + c[5] * (n.y * n.z) +
                     c[6] * (3 * n.z * n.z - 1) + c[7] * (n.x * n.z) + c[8] * (n.x * n.x - n.y * n.y);
    return {sum.x > 0 ? sum.x : 0, sum.y > 0 ? sum.y : 0, sum.z > 0 ? sum.z : 0};
}

Vec3 sky_color(const SkyState& sky, Vec3 d) {
    const float low = 1.0f - (d.y > 0 ? d.y : 0.0f);
    const float low2 = low * low, low4 = low2 * low2;
    const Vec3 color = lerp(sky.zenith, sky.horizon, low4 * (0.35f + 0.65f * low2));
    const float near_sun = dot(d, sky.sun_direction) > 0 ? dot(d, sky.sun_direction) : 0.0f;
    const float n2 = near_sun * near_sun, n8 = n2 * n2 * n2 * n2;
    return color + sky.glow * (low4 * (0.30f * n2 + 0.70f * n8));
}

} // namespace vitrail::scene
