// Sun and moon. Both are drawn some five times as wide as they are, as players expect them.
const float kSunRadius = 0.030, kMoonRadius = 0.036; // radians

// Half the chord between two unit vectors; where small, half the angle. Finer than an arc cosine of floats.
float angle_between(vec3 a, vec3 b) { return length(a - b); }

// edge: radians of a pixel. Adds the disc with its darker limb and the glare around it.
vec3 sun_at(vec3 d, vec3 disc, float edge) {
    float angle = angle_between(d, sun_direction.xyz);
    float r = angle / kSunRadius;
    // Limb darkening, stronger in blue (fit of the solar disc's linear law).
    vec3 limb = 1.0 - vec3(0.35, 0.48, 0.62) * (1.0 - sqrt(max(1.0 - r * r, 0.0)));
    vec3 face = limb * (14.0 * clamp((kSunRadius - angle) / edge + 0.5, 0.0, 1.0));
    // Glare: falls like light scattered in air and eye, from bright at the limb to nothing.
    float q = angle / kSunRadius;
    float glare = 0.55 / (1.0 + q * q * 0.55) * max(1.0 - angle * 1.4, 0.0);
    return disc * (face + glare * glare * 1.4);
}

// The seas and a few rayed craters, by place on the disc (-1..1).
float moon_face(sampler2D noise, vec2 p) {
    float seas = textureLod(noise, p * 0.21 + vec2(0.37, 0.61), 1.0).r * 0.7 + textureLod(noise, p * 0.63 + 0.17, 1.0).r * 0.3;
    float fine = textureLod(noise, p * 1.9, 0.0).g;
    float face = mix(1.0, 0.52, smoothstep(0.46, 0.60, seas)) * (0.86 + 0.28 * fine);
    vec2 crater = p - vec2(0.12, -0.62);
    float c2 = dot(crater, crater);
    return face + 0.30 * exp(-c2 * 90.0) + 0.10 * exp(-c2 * 8.0);
}

// x y: how much of what lies behind is covered; rgb of `light`: what is seen instead. phase: radians, 0 full.
float moon_at(vec3 d, vec3 disc, float phase, float edge, sampler2D noise, out vec3 light) {
    light = vec3(0.0);
    float angle = angle_between(d, moon_direction.xyz);
    float cover = clamp((kMoonRadius - angle) / edge + 0.5, 0.0, 1.0);
    float q = angle / kMoonRadius;
    float lit_part = 0.5 + 0.5 * cos(phase);
    float glare = max(1.0 - angle * 2.0, 0.0) / (1.0 + q * q * 0.30);
    light = disc * vec3(0.55, 0.75, 1.1) * (0.055 * lit_part * glare);
    if (cover <= 0.0) return 0.0;
    // The pole of the sky's turning is up on the disc, so the same face turns with the sky.
    vec3 pole = sky_pole.xyz;
    vec3 right = normalize(cross(pole, moon_direction.xyz));
    vec2 p = vec2(dot(d, right), dot(d, pole)) / kMoonRadius;
    float z = sqrt(max(1.0 - dot(p, p), 0.0));
    float sun = dot(vec3(p, z), vec3(sin(phase), 0.0, cos(phase)));
    // A dusty ball sends light back evenly up to its limb (Lommel and Seeliger).
    float lit = clamp(sun * 14.0 + 0.5, 0.0, 1.0) * 2.0 * max(sun, 0.0) / (max(sun, 0.0) + z + 0.02);
    vec3 face = vec3(1.0, 0.97, 0.92) * (lit * 0.75) + vec3(0.006, 0.009, 0.014); // the last: earthshine
    light = mix(light, disc * face * moon_face(noise, p), cover);
    return cover;
}
