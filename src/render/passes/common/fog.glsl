// The air between the eye and a surface. Needs frame.glsl and sky.glsl.
#include "common/mist.glsl"
// away: blocks; towards: unit direction from the eye; underwater 0 or 1; sky: its light on the surface, 0..1.
vec3 apply_fog(vec3 color, float away, vec3 towards, float underwater, float sky) {
    float x = away * misc.y;
    float x2 = x * x;
    float far = clamp(x2 * x2 * 0.90 + 0.12 * x2, 0.0, 1.0) * (1.0 - background.w);
    // Land fades into the very sky behind it, else hills at the edge of view stand out pale. Below the horizon: its color.
    // Black between the walls of a cave.
    vec3 air = sky_dome(towards) * max(ambient.w, sky * sky);
    color = mist_over(mix(color, air, far), away, towards, 0u, max(ambient.w, sky * sky));
    // Water takes red first.
    vec3 through = exp2(-away * vec3(0.13, 0.050, 0.036) * underwater);
    vec3 murk = (ambient.rgb + sun_light.rgb * 0.25) * vec3(0.03, 0.16, 0.22);
    return color * through + murk * (1.0 - through);
}
