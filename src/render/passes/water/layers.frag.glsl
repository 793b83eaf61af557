// What of the surfaces that let light through lies where: red the depth of the farthest, green (negated) that of the nearest
// way out of a liquid. Blended by the least of each. ATOMIC: as bits of floats into two images instead: GPUs blend such wide
// pixels slowly.
#include "common/frame.glsl"
#include "common/normal.glsl"
#include "water/sides.glsl"
layout(location = 3) flat in uvec2 v_surface;
layout(location = 4) in vec3 v_position;
#ifdef ATOMIC
layout(early_fragment_tests) in;
layout(binding = 0, r32ui) uniform uimage2D i_farthest;
layout(binding = 1, r32ui) uniform uimage2D i_way_out;
#else
layout(location = 0) out vec2 o_layers;
#endif

void main() {
    bool leaves = is_liquid(v_surface) && leaves_liquid(v_surface, v_position);
#ifdef ATOMIC
    uint depth = floatBitsToUint(gl_FragCoord.z); // of what is not negative, bits have the order of the numbers
    imageAtomicMin(i_farthest, ivec2(gl_FragCoord.xy), depth);
    if (leaves) imageAtomicMax(i_way_out, ivec2(gl_FragCoord.xy), depth);
#else
    o_layers = vec2(gl_FragCoord.z, leaves ? -gl_FragCoord.z : 0.0);
#endif
}
