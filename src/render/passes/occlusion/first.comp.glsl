// The commands that are drawn first: of sections that were seen lately, and of those around the eye.
#include "occlusion/seen.glsl"

layout(local_size_x = 64) in;
layout(std430, binding = 0) readonly buffer Source { uint source[]; }; // DrawCommand, five words each
layout(std430, binding = 1) writeonly buffer Lists { uint lists[]; };
layout(std430, binding = 4) readonly buffer Slots { uint slots[]; };
layout(std430, binding = 5) readonly buffer Seen { uint seen[]; };
layout(location = 0) uniform uvec2 u_count; // commands, the number of this frame

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= u_count.x) return;
    uint at = i * 5u;
    uint slot = slots[source[at + 4u]];
    bool drawn = (slot & kAlways) != 0u || seen_lately(seen[slot & ~kAlways], u_count.y);
    lists[at] = source[at];
    lists[at + 1u] = drawn ? 1u : 0u;
    lists[at + 2u] = source[at + 2u];
    lists[at + 3u] = source[at + 3u];
    lists[at + 4u] = source[at + 4u];
}
