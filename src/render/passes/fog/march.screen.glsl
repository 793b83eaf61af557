// How much of the mist along a ray stands in the sun: a march through the shadow maps, at half the picture's size.
// r: the part of all light that scatters once on the way to the eye and meets the sun there; g: blocks to the surface.
#include "common/screen.glsl"
#include "common/frame.glsl"
#include "common/mist.glsl"
#include "shadow/shadow_map.glsl"

layout(binding = 0) uniform sampler2D t_depth;
layout(binding = 1) uniform sampler2D t_light;
layout(binding = 2) uniform usampler2D t_surface;
layout(location = 0) uniform vec2 u_march; // steps, turn of the noise

const float kReach = 192.0; // blocks; beyond, the air stands in the sun

void shade_pixel(ivec2 small) {
    ivec2 pixel = min(small * 2, ivec2(screen.xy) - 1);
    vec2 ndc = (vec2(pixel) + 0.5) * screen.zw * 2.0 - 1.0;
    float depth = texelFetch(t_depth, pixel, 0).r;
    uint number = depth > 0.0 ? texelFetch(t_surface, pixel, 0).z & 7u : 0u;
    ViewData view = views[number];
    vec3 ray = view.ray_forward.xyz + view.ray_right.xyz * ndc.x + view.ray_up.xyz * ndc.y;
    float per_length = inversesqrt(dot(ray, ray));
    vec3 towards = ray * per_length;
    float away = depth > 0.0 ? view.fraction.w / (depth * per_length) : 1.0 / misc.y;
    float sky = depth > 0.0 ? texelFetch(t_light, pixel, 0).a : 1.0;
    float open = max(ambient.w, sky * sky) * 1.442695;

    // Steps grow with distance. Each counts with exactly the light that its stretch takes away, so that all together are
    // what mist_over() would add, however few there are; where in its stretch each looks is noise
    // (interleaved gradient noise, Jimenez 2014).
    float noise = fract(52.9829189 * fract(dot(vec2(small) + u_march.y, vec2(0.06711056, 0.00583715))));
    float reach = min(away, kReach), per_step = 1.0 / u_march.x;
    float before = 1.0, sum = 0.0;
    for (float i = 0.0; i < u_march.x; i += 1.0) {
        float end = (i + 1.0) * per_step, here = (i + noise) * per_step;
        float through = exp2(-open * mist_depth(reach * end * end, towards.y, number));
        float lit = number == 0u ? sun_shaft(towards * (reach * here * here)) : 1.0;
        sum += lit * (before - through);
        before = through;
    }
    if (away > reach) sum += before - exp2(-open * mist_depth(away, towards.y, number));
    put(vec4(sum, min(away, 60000.0), 0.0, 0.0));
}
