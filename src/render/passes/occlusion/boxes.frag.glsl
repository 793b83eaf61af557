// A pixel of a section's box that nothing drawn so far covers: the section is seen.
layout(early_fragment_tests) in;
layout(std430, binding = 5) buffer Seen { uint seen[]; };
layout(location = 0) flat in uint v_slot;
layout(location = 0) uniform uint u_now;

void main() {
    if (seen[v_slot] != u_now) seen[v_slot] = u_now;
}
