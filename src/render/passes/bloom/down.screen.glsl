// Half the size: 13 bilinear taps as five overlapping boxes (Jimenez 2014, "Next Generation Post Processing in Call of
// Duty: Advanced Warfare"). Every texel of the source counts the same in sum, so that light is kept.
// FIRST: reads the picture itself, where single texels may be blinding.
#include "common/screen.glsl"

layout(binding = 0) uniform sampler2D t_from;

// A glint of one texel that comes and goes would flicker over half the screen. Held (four texels at a time) by its strongest
// channel, so that no hue weighs more than another and none shifts. Written so that NaN gives black.
const float kBrightest = 64.0;

vec3 tap(vec2 at) {
    vec3 c = textureLod(t_from, at, 0.0).rgb;
#ifdef FIRST
    float strongest = max(max(c.r, c.g), c.b);
    if (!(strongest > 0.0 && strongest < 6.0e4)) return strongest >= 6.0e4 ? vec3(kBrightest) : vec3(0.0);
    c = max(c, vec3(0.0)) * min(kBrightest / strongest, 1.0);
#endif
    return c;
}

void shade_pixel(ivec2 pixel) {
    // The place in the source, not in the target: an odd size has half a texel more.
    vec2 texel = 1.0 / vec2(textureSize(t_from, 0));
    vec2 at = vec2(pixel) * 2.0 * texel + texel;
    vec3 middle = tap(at);
    vec3 inner = tap(at + texel * vec2(-1, -1)) + tap(at + texel * vec2(1, -1)) + tap(at + texel * vec2(-1, 1)) + tap(at + texel * vec2(1, 1));
    vec3 sides = tap(at + texel * vec2(-2, 0)) + tap(at + texel * vec2(2, 0)) + tap(at + texel * vec2(0, -2)) + tap(at + texel * vec2(0, 2));
    vec3 corners = tap(at + texel * vec2(-2, -2)) + tap(at + texel * vec2(2, -2)) + tap(at + texel * vec2(-2, 2)) + tap(at + texel * vec2(2, 2));
    // Inner box 1/2, four outer boxes 1/8 each, every box the mean of its four taps.
    put(vec4(inner * 0.125 + middle * 0.125 + sides * 0.0625 + corners * 0.03125, 1.0));
}
