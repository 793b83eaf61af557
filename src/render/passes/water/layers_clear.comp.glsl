// Nothing in any layer (layers.frag.glsl, ATOMIC).
layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0, r32ui) writeonly uniform uimage2D i_farthest;
layout(binding = 1, r32ui) writeonly uniform uimage2D i_way_out;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, imageSize(i_farthest)))) return;
    imageStore(i_farthest, pixel, uvec4(floatBitsToUint(1.0)));
    imageStore(i_way_out, pixel, uvec4(0u));
}
