// The dome; scene::sky_color is the same in C++ (a test compares them).
vec3 sky_dome(vec3 d) {
    float low = 1.0 - max(d.y, 0.0);
    float low2 = low * low;
    float low4 = low2 * low2;
    vec3 color = mix(zenith.rgb, horizon.rgb, low4 * (0.35 + 0.65 * low2));
    float near_sun = max(dot(d, sun_direction.xyz), 0.0);
    float n2 = near_sun * near_sun;
    float n8 = n2 * n2 * n2 * n2;
    return color + glow.rgb * (low4 * (0.30 * n2 + 0.70 * n8));
}
