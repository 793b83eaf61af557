// What lies behind everything: dome, sun, moon, stars, clouds. Only directions count, so every place has the same sky.
// NIGHT: stars may show. Clouds come from a small tiling noise texture.
#include "common/frame.glsl"
#include "common/sky.glsl"

layout(location = 0) in vec2 v_ndc;
layout(binding = 10) uniform sampler2D t_noise;
layout(location = 0) out vec4 o_color;

vec3 turned(vec3 d, float angle) { // about the axis of the sun's path, z
    float s = sin(angle), c = cos(angle);
    return vec3(d.x * c + d.y * s, d.y * c - d.x * s, d.z);
}

#ifdef NIGHT
float hash(vec3 p) {
    p = fract(p * vec3(0.1031, 0.1030, 0.0973));
    p += dot(p, p.yxz + 33.33);
    return fract((p.x + p.y) * p.z);
}
float stars_at(vec3 d) {
    vec3 p = d * 90.0;
    vec3 cell = floor(p);
    float h = hash(cell);
    if (h < 0.985) return 0.0;
    vec3 inside = p - cell - 0.5 - 0.3 * (vec3(hash(cell + 7.0), hash(cell + 13.0), hash(cell + 29.0)) - 0.5);
    float r2 = dot(inside, inside);
    float bright = (h - 0.985) * 66.0;
    float twinkle = 0.8 + 0.2 * sin(misc.x * 2.0 + h * 4000.0);
    return max(1.0 - r2 * 14.0, 0.0) * (0.25 + bright * bright) * twinkle;
}
#endif

void main() {
    ViewData view = views[0];
    vec3 d = normalize(view.ray_forward.xyz + view.ray_right.xyz * v_ndc.x + view.ray_up.xyz * v_ndc.y);
    vec3 color = sky_dome(d);
    float above = clamp(d.y * 12.0 + 0.6, 0.0, 1.0);
    float to_sun = dot(d, sun_direction.xyz);
    float halo = max(to_sun, 0.0);
    float h8 = halo * halo;
    h8 *= h8;
    h8 *= h8;
    float h64 = h8 * h8;
    h64 *= h64;
    h64 *= h64;
    float sun_up = clamp(sun_direction.y * 8.0 + 0.9, 0.0, 1.0);
    vec3 sun_color = mix(vec3(1.0, 0.42, 0.12), vec3(1.0, 0.93, 0.78), clamp(sun_direction.y * 2.5, 0.0, 1.0));
    color += sun_color * (sun_up * (0.07 * h8 + 0.30 * h64));
    float disc = smoothstep(0.99895, 0.99925, to_sun) * sun_up * above;
#ifdef NIGHT
    float to_moon = dot(d, moon_direction.xyz);
    float night = sun_direction.w;
    color += vec3(0.55, 0.65, 0.9) * (stars_at(turned(d, misc.w)) * night * above);
    float m = max(to_moon, 0.0);
    float m64 = m * m;
    m64 *= m64;
    m64 *= m64;
    m64 *= m64;
    m64 *= m64;
    m64 *= m64;
    color += vec3(0.10, 0.13, 0.20) * (0.8 * m64 * night);
    float moon = smoothstep(0.99910, 0.99935, to_moon);
    // Seas of the moon, from the cloud noise laid on its disc.
    vec3 across = normalize(cross(moon_direction.xyz, vec3(0.0, 0.0, 1.0)));
    vec2 on_moon = vec2(dot(d, across), d.z - moon_direction.z) * 6.0;
    float seas = texture(t_noise, on_moon).r;
    color = mix(color, vec3(0.85, 0.88, 0.95) * (0.45 + 0.75 * seas), moon * above * clamp(moon_direction.y * 8.0 + 0.9, 0.0, 1.0));
#endif
    color += sun_color * (disc * 9.0);
    // Clouds: a flat layer seen in perspective, thinning towards the horizon.
    float height = max(d.y, 0.02) + 0.06;
    vec2 at = d.xz / height;
    vec2 drift = vec2(misc.x * 0.0011, misc.x * 0.0004);
    float coarse = texture(t_noise, at * 0.060 + drift).r;
    float fine = texture(t_noise, at * 0.23 + drift * 2.3).r;
    float amount = coarse * 0.66 + fine * 0.34;
    float cover = smoothstep(0.53, 0.70, amount) * smoothstep(0.02, 0.22, d.y);
    // Thick parts are grayer below; thin rims next to the sun shine.
    float thick = smoothstep(0.60, 0.85, amount);
    vec3 lit = ambient.rgb * 0.85 + sun_light.rgb * (0.42 - 0.20 * thick) + glow.rgb * (0.35 * h8 + 0.10);
    lit += sun_color * (sun_up * 0.5 * h64 * (1.0 - thick));
    color = mix(color, lit, cover * 0.82);
    // Under water one sees murk.
    vec3 murk = (ambient.rgb + sun_light.rgb * 0.25) * vec3(0.03, 0.16, 0.22);
    color = mix(color, murk, view.ray_up.w);
    o_color = vec4(mix(color, background.rgb, background.w), 1.0);
}
