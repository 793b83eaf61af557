// Light that waves gather on the ground below: world space, moves with them. Needs common/frame.glsl.
// A web of bright lines where two layers of warped cells meet; its mean is 1, so that it moves light and makes none.
float caustic_layer(vec2 p, float t) {
    // Each turn bends the plane by waves of whole periods over 16 blocks, so that the web repeats with them.
    const float k = 0.392699082; // 2 pi / 16
    vec2 q = p;
    float sum = 0.0;
    vec2 bend = vec2(0.0);
    for (int i = 0; i < 3; ++i) {
        float n = float(i);
        bend = vec2(sin(k * (3.0 * p.y + (2.0 + n) * p.x) + t * (1.0 + 0.3 * n) + 1.7 * bend.y),
                    sin(k * (3.0 * p.x - (3.0 + n) * p.y) - t * (1.1 + 0.2 * n) + 1.9 * bend.x));
        sum += abs(bend.x + bend.y);
    }
    return sum * (1.0 / 3.0); // 0..2, thin lines near 0
}
// place: xz of the world modulo 256; depth: blocks of water above. The factor on the sun's light.
float caustics(vec2 place, float depth, float seconds) {
    float t = mod(seconds, 256.0) * 0.9817477; // 40 periods in 256 s
    float line = caustic_layer(place, t);
    float bright = exp(-line * 3.2); // mean near 0.21
    float focus = smoothstep(0.0, 1.2, depth) * exp(-0.06 * depth); // they blur in deep water
    return 1.0 + focus * 2.2 * (bright - 0.21);
}
