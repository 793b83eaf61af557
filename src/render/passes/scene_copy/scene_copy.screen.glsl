// The picture as it is, and beside it which view and face each pixel shows.
#include "common/screen.glsl"

layout(binding = 0) uniform sampler2D t_color;
layout(binding = 2) uniform usampler2D t_surface;
layout(binding = 3) uniform sampler2D t_depth;

void shade_pixel(ivec2 pixel) {
    // Where nothing was drawn the G-buffer holds what an older frame left.
    bool drawn = texelFetch(t_depth, pixel, 0).r > 0.0;
    put(vec4(texelFetch(t_color, pixel, 0).rgb, drawn ? float(texelFetch(t_surface, pixel, 0).z) : 0.0));
}
