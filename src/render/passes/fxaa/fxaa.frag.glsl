// Antialiasing of the finished picture: where brightness steps, follow the step along the edge to its ends and mix the two
// sides by how far the pixel is from them, as if the edge were a slanted line (the idea of Lottes 2009, "FXAA").
layout(binding = 0) uniform sampler2D t_picture; // sRGB-encoded, as eyes see steps
layout(location = 0) out vec4 o_color;

const float kLeastStep = 0.04, kLeastShare = 0.10; // steps that nobody sees: absolute, of the brightest around
const float kPoints = 0.6;                         // how far single points are smoothed, 0..1
const int kSteps = 10;
const float kStride[kSteps] = float[](1.0, 1.0, 1.0, 1.5, 2.0, 2.0, 2.0, 2.0, 4.0, 8.0);

float brightness(vec3 c) { return dot(c, vec3(0.299, 0.587, 0.114)); }
float at(vec2 uv) { return brightness(textureLod(t_picture, uv, 0.0).rgb); }

void main() {
    vec2 t = 1.0 / vec2(textureSize(t_picture, 0)), uv = gl_FragCoord.xy * t;
    vec3 own = textureLod(t_picture, uv, 0.0).rgb;
    float m = brightness(own);
    float n = at(uv + vec2(0, t.y)), s = at(uv - vec2(0, t.y)), e = at(uv + vec2(t.x, 0)), w = at(uv - vec2(t.x, 0));
    float high = max(m, max(max(n, s), max(e, w))), low = min(m, min(min(n, s), min(e, w)));
    float range = high - low;
    o_color = vec4(own, 1.0);
    if (range < max(kLeastStep, high * kLeastShare)) return;

    float ne = at(uv + t), sw = at(uv - t), nw = at(uv + vec2(-t.x, t.y)), se = at(uv + vec2(t.x, -t.y));
    // Which way the edge runs: second differences across it.
    float rows = abs(nw + sw - 2.0 * w) + 2.0 * abs(n + s - 2.0 * m) + abs(ne + se - 2.0 * e);
    float columns = abs(nw + ne - 2.0 * n) + 2.0 * abs(w + e - 2.0 * m) + abs(sw + se - 2.0 * s);
    bool lies = rows >= columns;
    vec2 across = lies ? vec2(0, t.y) : vec2(t.x, 0), along = lies ? vec2(t.x, 0) : vec2(0, t.y);
    float up = lies ? n : e, down = lies ? s : w;
    if (abs(down - m) > abs(up - m)) {
        across = -across;
        up = down;
    }
    // Between the two rows of pixels bilinear filtering gives their mean: it leaves that mean where the edge ends.
    float mean = (m + up) * 0.5, leave = abs(up - m) * 0.25;
    vec2 line = uv + across * 0.5;
    float ends[2], differences[2];
    for (int side = 0; side < 2; ++side) {
        float way = 0.0, difference = 0.0;
        for (int i = 0; i < kSteps; ++i) {
            way += kStride[i];
            difference = at(line + along * (side == 0 ? way : -way)) - mean;
            if (abs(difference) >= leave) break;
        }
        ends[side] = way;
        differences[side] = difference;
    }
    float nearer = min(ends[0], ends[1]), whole = ends[0] + ends[1];
    float difference = ends[0] < ends[1] ? differences[0] : differences[1];
    // Only the side of the edge that the line cuts into is mixed.
    bool cut = (difference < 0.0) != (m < mean);
    float shift = cut && abs(difference) >= leave ? 0.5 - nearer / whole : 0.0;
    // Points and thin lines have no ends to walk to: by their contrast with all neighbors.
    float ring = (2.0 * (n + s + e + w) + ne + nw + se + sw) / 12.0;
    float point = clamp(abs(ring - m) / range, 0.0, 1.0);
    point = point * point * (3.0 - 2.0 * point);
    shift = max(shift, point * point * kPoints);
    o_color = vec4(textureLod(t_picture, uv + across * shift, 0.0).rgb, 1.0);
}
