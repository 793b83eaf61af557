// Brings the half-size march to every pixel: of the four values around, those count that belong to the same distance.
#include "common/screen.glsl"
#include "common/frame.glsl"
#include "common/mist.glsl"

layout(binding = 0) uniform sampler2D t_depth;
layout(binding = 1) uniform sampler2D t_shaft;
layout(binding = 2) uniform usampler2D t_surface;

void shade_pixel(ivec2 pixel) {
    float depth = texelFetch(t_depth, pixel, 0).r;
    ViewData view = views[depth > 0.0 ? texelFetch(t_surface, pixel, 0).z & 7u : 0u];
    vec3 ray = view.ray_forward.xyz + view.ray_right.xyz * v_ndc.x + view.ray_up.xyz * v_ndc.y;
    float per_length = inversesqrt(dot(ray, ray));
    float away = depth > 0.0 ? view.fraction.w / (depth * per_length) : 1.0 / misc.y;
    // A half-size value stands at the corner pixel of its four.
    vec2 at = vec2(pixel) * 0.5, f = fract(at);
    ivec2 corner = ivec2(at), last = textureSize(t_shaft, 0) - 1;
    float sum = 0.0, weights = 0.0;
    for (int i = 0; i < 4; ++i) {
        ivec2 side = ivec2(i & 1, i >> 1);
        vec2 shaft = texelFetch(t_shaft, min(corner + side, last), 0).rg;
        vec2 near = mix(1.0 - f, f, vec2(side));
        float unlike = abs(shaft.g - away) / (0.04 * away + 0.1);
        float w = (near.x * near.y + 0.02) / (1.0 + unlike * unlike);
        sum += shaft.r * w;
        weights += w;
    }
    put(vec4(mist_sun(ray * per_length) * (sum / weights), 0.0));
}
