// From the grid of measure.frag.glsl to one exposure, which follows what it should be as eyes do: slowly.
layout(binding = 0) uniform sampler2D t_log;
layout(binding = 1) uniform sampler2D t_before;
layout(location = 0) uniform vec4 u_share; // of the way to go: to darker, to brighter; z: 1 where nothing came before
layout(location = 1) uniform vec4 u_curve; // log2 of the luminance that needs no change, slope, least and most stops
layout(location = 0) out vec2 o_exposure;  // factor, log2 of it

// The middle counts most; less the upper rim, where the sky is.
float weight_of(vec2 cell) {
    vec2 from_middle = (cell + 0.5) / vec2(16.0, 9.0) - vec2(0.5, 0.45);
    return 0.15 + exp2(-6.0 * dot(from_middle, from_middle));
}

void main() {
    float sum = 0.0, weights = 0.0;
    for (int i = 0; i < 144; ++i) {
        ivec2 cell = ivec2(i & 15, i >> 4);
        float w = weight_of(vec2(cell));
        sum += texelFetch(t_log, cell, 0).r * w;
        weights += w;
    }
    // What is far from the mean (the sun, a lamp, the mouth of a cave) pulls no more than what is 2 stops away
    // (Huber 1964): a few bright cells must not blind a dark picture. Two rounds are near the fixed point.
    float mean = sum / weights;
    for (int round = 0; round < 2; ++round) {
        float middle = mean;
        sum = 0.0;
        for (int i = 0; i < 144; ++i) {
            ivec2 cell = ivec2(i & 15, i >> 4);
            sum += clamp(texelFetch(t_log, cell, 0).r, middle - 2.0, middle + 2.0) * weight_of(vec2(cell));
        }
        mean = sum / weights;
    }
    // Eyes make up for a part of the change only: what is darker still looks darker.
    float wanted = clamp((u_curve.x - mean) * u_curve.y, u_curve.z, u_curve.w);
    float before = texelFetch(t_before, ivec2(0), 0).g;
    float share = wanted < before ? u_share.x : u_share.y;
    float now = u_share.z > 0.5 ? wanted : mix(before, wanted, share);
    o_exposure = vec2(exp2(now), now);
}
