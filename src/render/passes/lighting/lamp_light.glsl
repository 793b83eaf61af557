// What the levels of lamps mean as light: scene/lamp_light.h is the same in C++.

// levels: shares of 15 by color. What a white surface returns: between a linear and a square law. Each channel loses one
// level a block, so far from a lamp only its strongest color would be left: the weaker a light, the nearer to gray it is
// taken. Flames are warm.
vec3 lamp_light(vec3 levels) {
    float strongest = max(max(levels.r, levels.g), levels.b);
    float gray = mix(1.15, 0.15, strongest) * strongest;
    vec3 hue = (levels + gray) / max(strongest + gray, 1e-3);
    return hue * vec3(1.10, 0.97, 0.84) * (strongest * (0.16 + 1.24 * strongest));
}
