// The picture in linear light as the eye and the screen have it: bloom, exposure, filmic curve, sRGB, dithering.
// AUTO: "exposure" counts. BLOOM, DITHER.
#include "common/screen.glsl"
#include "common/frame.glsl"
#include "common/tone.glsl"
layout(binding = 0) uniform sampler2D t_color;
layout(binding = 1) uniform sampler2D t_bloom;
layout(binding = 13) uniform sampler2D t_exposure;
layout(location = 0) uniform vec2 u_exposure_bloom; // factor, share that spreads

// Interleaved gradient noise (Jimenez 2014): neighbors differ much, so that the eye averages them.
vec3 noise(vec2 pixel) {
    vec3 base = vec3(0.0, 5.588238, 11.176476) * 0.6180339887;
    return fract(52.9829189 * fract(dot(pixel, vec2(0.06711056, 0.00583715)) + base));
}
// Even 0..1 to a triangle -1..1: with it neither mean nor variance of the rounded value depends on the value
// (Lipshitz, Wannamaker and Vanderkooy 1992).
vec3 triangular(vec3 n) {
    n = n * 2.0 - 1.0;
    return sign(n) * (1.0 - sqrt(1.0 - abs(n)));
}

void shade_pixel(ivec2 pixel) {
    vec3 color = texelFetch(t_color, pixel, 0).rgb;
    vec3 x = color;
#ifdef BLOOM
    vec2 half_size = vec2(textureSize(t_bloom, 0));
    x = mix(x, textureLod(t_bloom, pixel_middle() * 0.5 / half_size, 0.0).rgb, u_exposure_bloom.y);
#endif
    float exposure = u_exposure_bloom.x;
#ifdef AUTO
    exposure *= texelFetch(t_exposure, ivec2(0), 0).r;
#endif
    // Tests read the color they asked for.
    vec3 mapped = background.w > 0.5 ? clamp(color, 0.0, 1.0) : filmic(max(x * exposure, vec3(0.0)));
    vec3 encoded = srgb_from_linear(mapped);
#ifdef DITHER
    encoded += triangular(noise(vec2(pixel))) * ((1.0 - background.w) / 255.0);
#endif
    put(vec4(encoded, 1.0));
}
