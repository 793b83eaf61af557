// Light on a surface, shared by the lighting pass and translucent surfaces.
// Needs frame.glsl, common/surface.glsl, common/ambient.glsl, shadow/shadow.glsl, water/medium.glsl,
// lighting/lamp_light.glsl.
// CAUSTICS: with the eye under water its waves gather the sun on what lies below (needs water/caustics.glsl).
// place: camera-relative; towards: unit direction from the eye.
vec3 shade(Surface s, vec3 place, vec3 towards, uint view) {
    float facing = s.plant ? 0.45 + 0.45 * max(light_direction.y, 0.0) : max(dot(s.normal, light_direction.xyz), 0.0);
    float sky_level = s.light.a, below;
    vec3 down = light_in_medium(place, view, sky_level, below);
    // What grows as crossed sheets would cast its own shadow on itself in stripes: it is asked for a little nearer to the
    // light, and has no side.
    vec3 side = s.plant ? light_direction.xyz : s.face;
    vec3 asked = s.plant ? place + side * 0.3 : place;
    vec3 sun = sun_light.rgb * sun_visibility(asked, side, facing, sky_level, view);
#ifdef CAUSTICS
    if (below > 0.0 && views[view].ray_up.w > 0.0)
        sun *= caustics(vec2(views[view].eye_block.xz & 255) + views[view].fraction.xz + place.xz, below, misc.x);
#endif
#ifndef SHADOW_COLOR
    sun *= down; // shadow maps with color know the water
#endif
    // Two sides that both turn from the sun must still differ, or edges drown.
    float edge = 1.0 - 0.10 * abs(s.normal.x);
    float sky = sky_level * sqrt(sky_level);
#ifdef SSAO
    // The mesh's corners are the same light told once more, known also off the screen: the darker counts. The sun is left to
    // its shadows, but for a touch in the corners, whose texture has more relief than its normals.
    float open = min(s.ao, s.screen_ao), sunlit = 0.6 + 0.4 * s.ao;
#else
    float open = s.ao, sunlit = 0.35 + 0.65 * s.ao;
#endif
    vec3 sum = sky_irradiance(s.normal) * down * (sky * edge * open) + sun * (facing * sunlit);
    vec3 block = lamp_light(s.light.rgb);
    sum += (block + vec3(0.0200, 0.0210, 0.0240)) * open; // the last: what eyes used to the dark still see
    if (below > 0.0) sum += views[view].murk.rgb * (1.2 * open); // the glimmer of the water around
    vec3 result = s.albedo * sum;
#ifdef GLOSS
    // A gloss for what is smooth: Blinn-Phong with energy kept roughly.
    vec3 halfway = normalize(light_direction.xyz - towards);
    float shine = 1.0 - s.roughness;
    float power = exp2(1.0 + 8.0 * shine);
    float gloss = pow(max(dot(s.normal, halfway), 0.0), power) * (power + 8.0) * 0.04 * shine * shine;
    result += sun * (gloss * facing * 0.25);
#endif
    return result + s.albedo * (s.emission * 1.9);
}
