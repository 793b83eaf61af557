// Light on a surface and the air before it, shared by the lighting pass and by translucent surfaces.
// albedo linear; light: block r g b, sky, each 0..1.
vec3 shade(vec3 albedo, vec3 n, vec4 light, float ao, float emission, float roughness, vec3 towards) {
    float sky = light.a * sqrt(light.a);
    // No shadow maps yet: direct light fades where the sky is not quite open, under trees and eaves.
    float open_sky = clamp(light.a * 5.0 - 3.9, 0.0, 1.0);
    open_sky *= open_sky;
    float facing = max(dot(n, light_direction.xyz), 0.0);
    // Light from all of the sky, more from above; a little comes back from the ground in the sun's color.
    float upward = 0.5 + 0.5 * n.y;
    vec3 dome = ambient.rgb * (0.55 + 0.45 * upward) + sun_light.rgb * ((1.0 - upward) * 0.10);
    // Two sides that both turn from the sun must still differ, or edges drown.
    float edge = 1.0 - 0.10 * abs(n.x);
    vec3 sum = (dome * (sky * edge)) * ao + sun_light.rgb * (facing * open_sky * (0.35 + 0.65 * ao));
    // Lamps: between a linear and a square law. Each channel loses one level a block, so far from a lamp only its strongest color
    // would be left: the weaker a light, the nearer to gray it is taken.
    float strongest = max(max(light.r, light.g), light.b);
    float gray = mix(1.15, 0.15, strongest) * strongest;
    vec3 hue = (light.rgb + gray) / max(strongest + gray, 1e-3);
    vec3 block = hue * vec3(1.10, 0.97, 0.84) * (strongest * (0.16 + 1.24 * strongest));
    sum += (block + vec3(0.0200, 0.0210, 0.0240)) * ao; // the last: what eyes used to the dark still see
#ifdef HIGH
    // A gloss for what is smooth: Blinn-Phong with energy kept roughly.
    vec3 halfway = normalize(light_direction.xyz - towards);
    float shine = 1.0 - roughness;
    float power = exp2(1.0 + 8.0 * shine);
    float gloss = pow(max(dot(n, halfway), 0.0), power) * (power + 8.0) * 0.04 * shine * shine;
    vec3 result = albedo * sum + sun_light.rgb * (gloss * facing * open_sky * 0.25);
#else
    vec3 result = albedo * sum;
#endif
    return result + albedo * (emission * 1.9);
}

// away: blocks; towards: unit direction from the eye; underwater 0 or 1; sky: its light on the surface, 0..1.
vec3 apply_fog(vec3 color, float away, vec3 towards, float underwater, float sky) {
    float x = away * misc.y;
    float x2 = x * x;
    float far = clamp(x2 * x2 * 0.90 + 0.12 * x2, 0.0, 1.0) * (1.0 - background.w);
    // Land fades into the very sky behind it, else hills at the edge of view stand out pale. Below the horizon: its color.
    vec3 level = vec3(towards.x, max(towards.y, 0.0), towards.z);
    vec3 air = sky_dome(level * inversesqrt(max(dot(level, level), 1e-6))) * max(ambient.w, sky * sky); // black between the walls of a cave
    color = mix(color, air, far);
    // Water takes red first.
    vec3 through = exp2(-away * vec3(0.13, 0.050, 0.036) * underwater);
    vec3 murk = (ambient.rgb + sun_light.rgb * 0.25) * vec3(0.03, 0.16, 0.22);
    return color * through + murk * (1.0 - through);
}
