// The three faces of a section's box that look at the eye, 18 vertices an instance.
#include "common/frame.glsl"
#include "occlusion/seen.glsl"

layout(location = 0) in ivec4 in_section; // blocks from the eye's block
layout(std430, binding = 4) readonly buffer Slots { uint slots[]; };
layout(std430, binding = 5) buffer Seen { uint seen[]; };
layout(location = 0) uniform uint u_now;
layout(location = 0) flat out uint v_slot;

const float kReach = 3.0 / 16.0; // kSectionReach of render/culling.h

void main() {
    uint slot = slots[gl_InstanceID];
    vec3 least = vec3(in_section.xyz) - views[0].fraction.xyz - kReach;
    vec3 most = least + 16.0 + 2.0 * kReach;
    int axis = gl_VertexID / 6, u = (axis + 1) % 3, v = (axis + 2) % 3;
    int corner = gl_VertexID % 6; // 0 1 2 2 3 0
    corner = corner < 3 ? corner : corner == 5 ? 0 : corner - 1;
    vec3 p;
    p[axis] = least[axis] > 0.0 ? least[axis] : most[axis];
    p[u] = corner == 1 || corner == 2 ? most[u] : least[u];
    p[v] = corner >= 2 ? most[v] : least[v];
    gl_Position = views[0].view_proj * vec4(p, 1.0);
    bool looks = least[axis] > 0.0 || most[axis] < 0.0;
    // A fragment may write what is read here; whichever comes first, the section has been seen.
    bool drawn = (slot & kAlways) != 0u || (seen_lately(seen[slot & ~kAlways], u_now) && !tested_again(slot, u_now));
    if (!looks || drawn) gl_Position = vec4(0.0, 0.0, -1.0, 0.0);
    v_slot = slot;
}
