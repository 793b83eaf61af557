// Antialiasing in time: every frame is drawn with another shift below a pixel; this pass follows each surface to where it was in
// the frame before and averages (Karis 2014, "High-Quality Temporal Supersampling"; Salvi 2016, variance clipping).
// What was hidden then, lay off the screen, or belongs to another view is not taken.
#include "common/screen.glsl"
#include "common/frame.glsl"
layout(binding = 0) uniform sampler2D t_color;
layout(binding = 1) uniform sampler2D t_before;
layout(binding = 2) uniform sampler2D t_place_before;
layout(binding = 3) uniform sampler2D t_depth;
layout(binding = 4) uniform usampler2D t_surface;
layout(location = 0) uniform vec2 u_state; // 1 where there is a frame before; 1 where there are several views
// The second target, place: distance along the view's axis of what is nearest here; view number; frames gathered

const float kFar = 60000.0; // sky, as half floats hold it
const float kMost = 32.0;   // frames that a resting picture gathers

// Averages are taken where light is held to 0..4 by its strongest channel, or one blinding sample would outweigh all others
// along an edge; what a screen can show is changed little. Written so that NaN and what is no light give black.
vec3 held(vec3 c) {
    c = clamp(c, vec3(0.0), vec3(6.0e4));
    float strongest = max(max(c.r, c.g), c.b);
    return strongest > 0.0 ? c / (1.0 + 0.25 * strongest) : vec3(0.0);
}
vec3 released(vec3 c) { return c / max(1.0 - 0.25 * max(max(c.r, c.g), c.b), 1e-4); }
vec3 ycocg(vec3 c) { return vec3(dot(c, vec3(0.25, 0.5, 0.25)), dot(c, vec3(0.5, 0.0, -0.5)), dot(c, vec3(-0.25, 0.5, -0.25))); }
vec3 from_ycocg(vec3 c) { return vec3(c.x + c.y - c.z, c.x + c.z, c.x - c.y - c.z); }

// Where there is no surface its texel holds anything: the sky is one for all views.
uint number_at(ivec2 pixel, float depth) { return depth > 0.0 ? texelFetch(t_surface, pixel, 0).z & 7u : 0u; }

// Catmull-Rom through five bilinear taps, corners left out (Jimenez 2016, "Filmic SMAA"): keeps what averaging would blur.
vec3 sharp_before(vec2 uv) {
    vec2 size = screen.xy, at = uv * size;
    vec2 middle = floor(at - 0.5) + 0.5, f = at - middle;
    vec2 w0 = f * (-0.5 + f * (1.0 - 0.5 * f)), w1 = 1.0 + f * f * (1.5 * f - 2.5);
    vec2 w2 = f * (0.5 + f * (2.0 - 1.5 * f)), w3 = f * f * (0.5 * f - 0.5);
    vec2 w12 = w1 + w2;
    vec2 p0 = (middle - 1.0) * screen.zw, p3 = (middle + 2.0) * screen.zw, p12 = (middle + w2 / w12) * screen.zw;
    vec4 sum = vec4(textureLod(t_before, p12, 0.0).rgb, 1.0) * (w12.x * w12.y);
    sum += vec4(textureLod(t_before, vec2(p0.x, p12.y), 0.0).rgb, 1.0) * (w0.x * w12.y);
    sum += vec4(textureLod(t_before, vec2(p3.x, p12.y), 0.0).rgb, 1.0) * (w3.x * w12.y);
    sum += vec4(textureLod(t_before, vec2(p12.x, p0.y), 0.0).rgb, 1.0) * (w12.x * w0.y);
    sum += vec4(textureLod(t_before, vec2(p12.x, p3.y), 0.0).rgb, 1.0) * (w12.x * w3.y);
    return sum.rgb / sum.w;
}

// The part of the way from the box's middle to `c` that lies inside it.
vec3 clipped(vec3 c, vec3 middle, vec3 extent) {
    vec3 way = c - middle;
    vec3 over = abs(way) / max(extent, vec3(1e-5));
    float most = max(max(over.x, over.y), over.z);
    return most > 1.0 ? middle + way / most : c;
}

void shade_pixel(ivec2 pixel) {
    ivec2 last = ivec2(screen.xy) - 1;
    vec4 color = texelFetch(t_color, pixel, 0);
    float here = texelFetch(t_depth, pixel, 0).r;
    uint number = number_at(pixel, here);

    // Neighbors of the same view: their colors bound what the past may say, and the nearest one tells how the edge moves.
    vec3 own = ycocg(held(color.rgb)), sum = vec3(0.0), squares = vec3(0.0), soft = vec3(0.0), least = own, most = own;
    float count = 0.0, shares = 0.0, nearest = here;
    ivec2 nearest_at = pixel;
    for (int i = 0; i < 9; ++i) {
        ivec2 q = clamp(pixel + ivec2(i % 3 - 1, i / 3 - 1), ivec2(0), last);
        float depth = texelFetch(t_depth, q, 0).r;
        if (number_at(q, depth) != number) continue;
        vec3 c = ycocg(held(texelFetch(t_color, q, 0).rgb));
        sum += c;
        squares += c * c;
        float share = (i % 3 == 1 ? 2.0 : 1.0) * (i / 3 == 1 ? 2.0 : 1.0);
        soft += c * share;
        shares += share;
        least = min(least, c);
        most = max(most, c);
        count += 1.0;
        if (depth > nearest) nearest = depth, nearest_at = q;
    }

    // Where that surface was, as the frame before saw it. The shifts of both frames are left out of the motion.
    ViewData view = views[number];
    vec2 ndc = (vec2(nearest_at) + 0.5) * screen.zw * 2.0 - 1.0;
    vec3 ray = view.ray_forward.xyz + view.ray_right.xyz * ndc.x + view.ray_up.xyz * ndc.y;
    vec4 clip = nearest > 0.0 ? view.previous * vec4(ray * (view.fraction.w / nearest), 1.0) : view.previous * vec4(ray, 0.0);
    vec2 motion = clip.w > 0.0 ? clip.xy / clip.w - (ndc - jitter.xy) : vec2(4.0);
    vec2 uv = pixel_middle() * screen.zw + motion * 0.5;
    float moved = length(motion * 0.5 * screen.xy);
    float expected = nearest > 0.0 ? min(clip.w, kFar) : kFar;

    ivec2 before_at = clamp(ivec2(floor(uv * screen.xy)), ivec2(0), last);
    vec4 place_before = texelFetch(t_place_before, before_at, 0);
    vec4 around = textureGather(t_place_before, uv, 0);
    float farthest = max(max(around.x, around.y), max(around.z, around.w));
    // Half floats round to a 2048th; what is seen at a grazing angle changes its distance from texel to texel.
    bool known = u_state.x > 0.5 && all(greaterThanEqual(uv, vec2(0.0))) && all(lessThanEqual(uv, vec2(1.0))) &&
                 uint(place_before.y + 0.5) == number && farthest > expected * 0.93 - 0.2 && background.w < 0.5;
    if (!known) {
        put_second(vec4(nearest > 0.0 ? min(view.fraction.w / nearest, kFar) : kFar, float(number), 1.0, 0.0));
        put(color);
        return;
    }
    bool seam = false; // of views: no filter may reach across
    if (u_state.y > 0.5)
        for (int i = 0; i < 25; ++i) {
            ivec2 q = clamp(before_at + ivec2(i % 5 - 2, i / 5 - 2), ivec2(0), last);
            seam = seam || uint(texelFetch(t_place_before, q, 0).y + 0.5) != number;
        }
    vec3 before = seam ? texelFetch(t_before, before_at, 0).rgb : sharp_before(uv);
    vec3 past = ycocg(held(before));
    vec3 mean = sum / count, deviation = sqrt(max(squares / count - mean * mean, vec3(0.0)));
    // In motion a tight box, against smear.
    float moves = clamp(moved, 0.0, 1.0);
    vec3 spread = deviation * mix(2.0, 1.0, moves);
    vec3 low = max(mean - spread, least), high = min(mean + spread, most);
    vec3 bounded = clipped(past, (low + high) * 0.5, (high - low) * 0.5);
    // At rest details smaller than a pixel come and go, and what the neighbors of one frame happen to show says little. There a
    // blurred look decides whether anything has changed: while past and present agree in it, the past stands.
    float same = 0.0;
    if (moves < 1.0 && !seam) {
        vec2 t = screen.zw * 0.5;
        vec3 blurred = held(textureLod(t_before, uv + t, 0.0).rgb) + held(textureLod(t_before, uv - t, 0.0).rgb) +
                       held(textureLod(t_before, uv + vec2(t.x, -t.y), 0.0).rgb) + held(textureLod(t_before, uv + vec2(-t.x, t.y), 0.0).rgb);
        float off = abs(ycocg(blurred * 0.25).x - soft.x / shares) / (deviation.x + 0.01 * mean.x + 1e-5);
        same = (1.0 - moves) * (1.0 - smoothstep(0.7, 1.3, off));
    }
    past = mix(bounded, past, same);
    float gathered = min(place_before.z + 1.0, mix(8.0, kMost, same));
    vec3 result = mix(past, own, 1.0 / gathered);
    put_second(vec4(nearest > 0.0 ? min(view.fraction.w / nearest, kFar) : kFar, float(number), gathered, 0.0));
    put(vec4(released(clamp(from_ycocg(result), vec3(0.0), vec3(3.9999))), 1.0));
}
