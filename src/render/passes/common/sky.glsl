// The clear dome without sun, moon, stars and clouds: a small table that the CPU fills (scene/sky_table.h says how it is
// laid out; scene::sky_color is the same in C++ and a test compares them). Needs frame.glsl. d: any length.
layout(binding = 9) uniform sampler2D t_sky;
vec3 sky_dome(vec3 d) {
    float along = dot(d.xz, sky_azimuth.xy) * inversesqrt(max(dot(d.xz, d.xz), 1e-8));
    vec2 place = sqrt(clamp(vec2(0.5 - 0.5 * along, d.y), 0.0, 1.0));
    return textureLod(t_sky, place * vec2(47.0 / 48.0, 31.0 / 32.0) + vec2(0.5 / 48.0, 0.5 / 32.0), 0.0).rgb;
}
