// The air and the liquid between the eye and a surface. Needs frame.glsl, sky.glsl and water/medium.glsl.
#include "common/mist.glsl"
// away: blocks; towards: unit direction from the eye; number: the view; sky: its light on the surface, 0..1.
vec3 apply_fog(vec3 color, float away, vec3 towards, uint number, float sky) {
    float x = away * misc.y;
    float x2 = x * x;
    float far = clamp(x2 * x2 * 0.90 + 0.12 * x2, 0.0, 1.0) * (1.0 - background.w);
    // Land fades into the very sky behind it, else hills at the edge of view stand out pale. Below the horizon: its color.
    // Black between the walls of a cave.
    vec3 air = sky_dome(towards) * max(ambient.w, sky * sky);
    color = mix(color, air, far);
#ifndef DRY
    if (views[number].ray_up.w == 0.0) // no mist in water
#endif
        color = mist_over(color, away, towards, number, max(ambient.w, sky * sky));
    return through_medium(color, towards, away, number);
}
