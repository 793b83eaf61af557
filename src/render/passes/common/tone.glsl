// Linear light to what a screen shows; scene/tone_curve.h is the same in C++ (a test compares them).
// Filmic curve: the reference rendering and output transforms of ACES for an sRGB screen as fitted by Stephen Hill
// (BakingLab, 2016). Its matrices mix the channels before the curve and part them after it, so that bright pure colors
// go towards white instead of staying at a gaudy primary.
vec3 filmic(vec3 c) {
    const mat3 to_rrt = mat3(0.59719, 0.07600, 0.02840, 0.35458, 0.90834, 0.13383, 0.04823, 0.01566, 0.83777);
    const mat3 from_odt = mat3(1.60475, -0.10208, -0.00327, -0.53108, 1.10813, -0.07276, -0.07367, -0.00605, 1.07602);
    vec3 v = to_rrt * (c * 1.75); // 0.18 stays about where a plain sRGB screen shows it
    v = (v * (v + 0.0245786) - 0.000090537) / (v * (0.983729 * v + 0.4329510) + 0.238081);
    return clamp(from_odt * v, 0.0, 1.0);
}

// sRGB's curve without a power function (the roots' fit by Chilliant 2012, the straight foot exact): within 0.002.
vec3 srgb_from_linear(vec3 c) {
    vec3 r = sqrt(c), rr = sqrt(r);
    vec3 fit = 0.662002687 * r + 0.684122060 * rr - 0.323583601 * sqrt(rr) - 0.0225411470 * c;
    return mix(fit, 12.92 * c, lessThan(c, vec3(0.0031308)));
}
