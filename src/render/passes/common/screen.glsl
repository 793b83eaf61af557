// A pass over every pixel of its targets, written once and run in either of two ways (ScreenProgram in screen_pass.h): as
// fragments of a triangle, or, with COMPUTE, as groups of 8 x 8 threads. The shader includes this, defines
//
//     void shade_pixel(ivec2 pixel)
//
// and in it calls put() once, before it, where there is a second target, put_second(). v_ndc: the pixel's middle, -1..1.
// Derivatives only where ScreenShader::derivatives says so: threads have none. From the C++ side come OUT0, OUT1: formats of the targets; AREA: 1 surfaces, 2
// background (threads look the depth up; fragments have the depth test); BLEND: shares come from u_shares.
#include "common/pixel.glsl"

void shade_pixel(ivec2 pixel);

#ifdef COMPUTE
layout(local_size_x = 8, local_size_y = 8) in;
#ifdef BLEND
layout(binding = 0, OUT0) uniform image2D i_out0;
layout(location = 31) uniform vec2 u_shares; // of what was there, of what is put
#else
layout(binding = 0, OUT0) writeonly uniform image2D i_out0;
#endif
#ifdef OUT1
layout(binding = 1, OUT1) writeonly uniform image2D i_out1;
void put_second(vec4 value) { imageStore(i_out1, ivec2(gl_GlobalInvocationID.xy), value); }
#endif
#ifdef AREA
layout(binding = 3) uniform sampler2D t_area_depth;
#endif
vec2 v_ndc;

void put(vec4 value) {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
#ifdef BLEND
    value = imageLoad(i_out0, pixel) * u_shares.x + value * u_shares.y;
#endif
    imageStore(i_out0, pixel, value);
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy), size = imageSize(i_out0);
    if (any(greaterThanEqual(pixel, size))) return;
#ifdef AREA
    if ((texelFetch(t_area_depth, pixel, 0).r > 0.0) != (AREA == 1)) return;
#endif
    v_ndc = (vec2(pixel) + 0.5) / vec2(size) * 2.0 - 1.0;
    shade_pixel(pixel);
}
#else
layout(location = 0) in vec2 v_ndc;
layout(location = 0) out vec4 o_out0;
void put(vec4 value) { o_out0 = value; }
#ifdef OUT1
layout(location = 1) out vec4 o_out1;
void put_second(vec4 value) { o_out1 = value; }
#endif

void main() { shade_pixel(ivec2(gl_FragCoord.xy)); }
#endif
