// Unit vectors as two numbers -1..1 by the octahedral map (Cigolle et al. 2014).
vec2 octahedral(vec3 n) {
    n.xy /= abs(n.x) + abs(n.y) + abs(n.z);
    vec2 folded = (1.0 - abs(n.yx)) * vec2(n.x >= 0.0 ? 1.0 : -1.0, n.y >= 0.0 ? 1.0 : -1.0);
    return n.z >= 0.0 ? n.xy : folded;
}
vec3 from_octahedral(vec2 e) {
    vec3 n = vec3(e, 1.0 - abs(e.x) - abs(e.y));
    float t = max(-n.z, 0.0);
    n.x += n.x >= 0.0 ? -t : t;
    n.y += n.y >= 0.0 ? -t : t;
    return normalize(n);
}
// Bytes: 127 is exactly 0, so that the six axis directions are exact.
uvec2 normal_bytes(vec3 n) { return uvec2(octahedral(n) * 127.0 + 127.5); }
vec3 normal_from_bytes(uvec2 b) { return from_octahedral((vec2(b) - 127.0) / 127.0); }
