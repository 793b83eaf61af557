// After the test: the commands that are still to be drawn, and the list of all that are seen.
#include "occlusion/seen.glsl"

layout(local_size_x = 64) in;
layout(std430, binding = 0) readonly buffer Source { uint source[]; }; // DrawCommand, five words each
layout(std430, binding = 1) buffer Lists { uint lists[]; };            // first, late, both
layout(std430, binding = 2) buffer Counts { uint sections, quads, draws; };
layout(std430, binding = 4) readonly buffer Slots { uint slots[]; };
layout(std430, binding = 5) buffer Seen { uint seen[]; };
layout(location = 0) uniform uvec4 u_count; // commands, the number of this frame, words of a list, sections

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i < u_count.w) {
        uint slot = slots[i];
        if ((slot & kAlways) != 0u) seen[slot & ~kAlways] = u_count.y;
        if ((slot & kAlways) != 0u || seen_lately(seen[slot & ~kAlways], u_count.y)) atomicAdd(sections, 1u);
    }
    if (i >= u_count.x) return;
    uint at = i * 5u;
    uint slot = slots[source[at + 4u]];
    bool is_seen = (slot & kAlways) != 0u || seen_lately(seen[slot & ~kAlways], u_count.y);
    bool drawn = lists[at + 1u] != 0u;
    for (uint list = 1u; list < 3u; ++list) {
        uint to = list * u_count.z + at;
        lists[to] = source[at];
        lists[to + 1u] = is_seen && (list == 2u || !drawn) ? 1u : 0u;
        lists[to + 2u] = source[at + 2u];
        lists[to + 3u] = source[at + 3u];
        lists[to + 4u] = source[at + 4u];
    }
    if (is_seen) {
        atomicAdd(quads, source[at] / 6u);
        atomicAdd(draws, 1u);
    }
}
