// What lies behind everything: dome, stars, moon, sun, clouds, from far to near. Stars, moon and sun are infinitely far;
// clouds hang in the world. NIGHT: stars or moon may show; STARS: they are wanted; CLOUDS: 0 none, 1 flat, 2 lit.
#include "common/screen.glsl"
#include "common/frame.glsl"
#include "common/sky.glsl"
#include "common/ambient.glsl"
#include "common/mist.glsl"
#include "water/medium.glsl"

layout(binding = 10) uniform sampler2D t_clouds; // r: wide shapes, g: heaps; repeats
layout(location = 0) uniform vec4 sun_disc;        // rgb: color of the disc
layout(location = 1) uniform vec4 moon_disc;       // w: phase, radians, 0 full
layout(location = 2) uniform vec4 sky_pole;        // xyz: what the sky turns about; w: turn, radians
layout(location = 3) uniform vec4 cloud_light;     // rgb: direct light at the clouds' height
layout(location = 4) uniform vec4 cloud_direction; // xyz: towards it

#include "sky/discs.glsl"
#if defined(NIGHT) && defined(STARS)
#include "sky/stars.glsl"
#endif
#if CLOUDS > 0
#include "sky/clouds.glsl"
#endif

void shade_pixel(ivec2 pixel) {
    ViewData view = views[0];
    vec3 ray = view.ray_forward.xyz + view.ray_right.xyz * v_ndc.x + view.ray_up.xyz * v_ndc.y;
    float per_length = inversesqrt(dot(ray, ray));
    vec3 d = ray * per_length;
    float edge = view.ray_right.w * per_length; // radians of a pixel, about
    float above = clamp(d.y / edge + 0.5, 0.0, 1.0); // the horizon hides what has set
    vec3 color = sky_dome(d);
    // Beyond the land's edge one looks down on hazy ground.
    color = mix(color, sky_irradiance(vec3(0.0, -1.0, 0.0)), smoothstep(-0.02, -0.45, d.y) * 0.8);
#ifdef NIGHT
    vec3 moon;
    float cover = moon_at(d, moon_disc.rgb, moon_disc.w, edge, t_clouds, moon);
#ifdef STARS
    if (sun_direction.w > 0.0 && d.y > -0.01 && cover < 1.0)
        color += stars_at(d, sky_pole.w, edge, t_clouds) * (sun_direction.w * (1.0 - cover));
#endif
    color += moon * above;
#endif
    color += sun_at(d, sun_disc.rgb, edge) * above;
#if CLOUDS > 0
    // Interleaved gradient noise (Jimenez 2014) hides the steps of the march.
    float dither = fract(52.9829189 * fract(dot(vec2(pixel), vec2(0.06711056, 0.00583715))));
    vec4 clouds = clouds_at(d, t_clouds, edge, dither);
    color = color * clouds.a + clouds.rgb;
#endif
    // As land at the edge of view: no seam.
    color = mist_over(color, 1.0 / misc.y, d, 0u, 1.0);
    color = through_medium(color, d, 1e5, 0u);
    put(vec4(mix(color, background.rgb, background.w), 1.0));
}
