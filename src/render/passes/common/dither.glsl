// Interleaved gradient noise (Jimenez 2014), 0..1: any 3x3 pixels hold nearly evenly spread values, so that a small blur
// evens it out. turn: number of the frame; each frame moves the pattern, which antialiasing in time averages.
float pixel_noise(ivec2 pixel, uint turn) {
    vec2 p = vec2(pixel) + 5.588238 * float(turn);
    return fract(52.9829189 * fract(dot(p, vec2(0.06711056, 0.00583715))));
}
