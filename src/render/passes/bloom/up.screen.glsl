// Twice the size: a 3 x 3 tent over the smaller level (Jimenez 2014), blended over the level that is there.
#include "common/screen.glsl"

layout(binding = 0) uniform sampler2D t_from;

void shade_pixel(ivec2 pixel) {
    vec2 t = 1.0 / vec2(textureSize(t_from, 0));
    vec2 at = pixel_middle() * 0.5 * t;
    vec3 sum = textureLod(t_from, at, 0.0).rgb * 4.0;
    sum += (textureLod(t_from, at + vec2(-t.x, 0), 0.0).rgb + textureLod(t_from, at + vec2(t.x, 0), 0.0).rgb + textureLod(t_from, at + vec2(0, -t.y), 0.0).rgb + textureLod(t_from, at + vec2(0, t.y), 0.0).rgb) * 2.0;
    sum += textureLod(t_from, at - t, 0.0).rgb + textureLod(t_from, at + t, 0.0).rgb + textureLod(t_from, at + vec2(t.x, -t.y), 0.0).rgb + textureLod(t_from, at + vec2(-t.x, t.y), 0.0).rgb;
    put(vec4(sum * (1.0 / 16.0), 1.0));
}
