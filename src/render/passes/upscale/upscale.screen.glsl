// A smaller picture enlarged: Catmull-Rom, which keeps edges sharp, from five filtered reads (Jimenez 2016: the two middle
// weights of each axis are one read between them, and the corners, which weigh next to nothing, are left out). QUICK: the
// middle one of them alone, for software OpenGL: the same edges, not raised in contrast.
#include "common/screen.glsl"
layout(binding = 0) uniform sampler2D t_picture; // as shown: encoded
layout(location = 0) uniform vec4 u_size;        // of the picture in texels, and one over it

void shade_pixel(ivec2 pixel) {
    vec2 at = (v_ndc * 0.5 + 0.5) * u_size.xy;
    vec2 middle = floor(at - 0.5) + 0.5;
    vec2 f = at - middle;
    vec2 w0 = f * (-0.5 + f * (1.0 - 0.5 * f)), w1 = 1.0 + f * f * (-2.5 + 1.5 * f);
    vec2 w2 = f * (0.5 + f * (2.0 - 1.5 * f)), w3 = f * f * (-0.5 + 0.5 * f);
    vec2 w12 = w1 + w2, t12 = (middle + w2 / w12) * u_size.zw;
#ifdef QUICK
    put(vec4(textureLod(t_picture, t12, 0.0).rgb, 1.0));
#else
    vec2 t0 = (middle - 1.0) * u_size.zw, t3 = (middle + 2.0) * u_size.zw;
    vec3 sum = textureLod(t_picture, t12, 0.0).rgb * (w12.x * w12.y);
    sum += textureLod(t_picture, vec2(t12.x, t0.y), 0.0).rgb * (w12.x * w0.y);
    sum += textureLod(t_picture, vec2(t0.x, t12.y), 0.0).rgb * (w0.x * w12.y);
    sum += textureLod(t_picture, vec2(t3.x, t12.y), 0.0).rgb * (w3.x * w12.y);
    sum += textureLod(t_picture, vec2(t12.x, t3.y), 0.0).rgb * (w12.x * w3.y);
    float weights = w12.x * w12.y + w12.x * (w0.y + w3.y) + w12.y * (w0.x + w3.x);
    put(vec4(clamp(sum / weights, 0.0, 1.0), 1.0));
#endif
}
