// How bright the picture is, in a coarse grid: the mean of log2(luminance) over a cell, from 4 x 4 places in it.
layout(binding = 0) uniform sampler2D t_color;
layout(location = 0) out float o_log;

// Luminance that counts as black and as blinding; outside the eye tells no difference (log2).
const float kDarkest = -9.0, kBrightest = 5.0;

void main() {
    vec2 size = vec2(textureSize(t_color, 0));
    vec2 cell = size / vec2(16.0, 9.0);
    vec2 corner = floor(gl_FragCoord.xy) * cell;
    float sum = 0.0;
    for (int y = 0; y < 4; ++y)
        for (int x = 0; x < 4; ++x) {
            vec2 at = corner + (vec2(x, y) + 0.5) * 0.25 * cell;
            vec3 c = texelFetch(t_color, ivec2(min(at, size - 1.0)), 0).rgb;
            float luminance = dot(c, vec3(0.2126, 0.7152, 0.0722));
            // Written so that NaN counts as black.
            sum += luminance > 0.0 ? clamp(log2(luminance), kDarkest, kBrightest) : kDarkest;
        }
    o_log = sum * (1.0 / 16.0);
}
