// How much of the sky over a surface is free of what stands within a radius of blocks, weighted by the cosine: 1 all.
//
// Slices through the eye's ray and a line on the screen, as ground-truth ambient occlusion takes them (Jimenez, Wu, Pesce and
// Jarabo 2016), their light measured by the closed integral there. In each slice a mask of 32 equal shares of that light
// keeps what is hidden, as in the visibility bitmask of Therrien, Levesque and Gilet (2023), so that light passes behind
// things that float. Unlike there samples that follow each other closely are joined, since a few must do for a whole wall.
#include "common/frame.glsl"
#include "common/normal.glsl"
#include "common/surface.glsl"
#include "common/dither.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 2) uniform usampler2D t_surface;
layout(binding = 3) uniform sampler2D t_depth;
layout(location = 0) uniform vec2 u_radius; // blocks; strength
layout(location = 1) uniform uint u_turn;   // of the frame, 0 where frames are not averaged
layout(binding = 0, r8) writeonly uniform image2D i_ao;

const float kPi = 3.14159265, kHalfPi = 1.57079633;
const float kThickness = 1.0; // blocks, of what stands there
const float kJoin = 1.5;      // radii: samples nearer to each other belong to one thing
const float kRounded = 1.0 / 64.0; // pixels; GPUs place corners in steps of 1/256 and take depths from there
const float kWidest = 0.3;    // of the screen's height: near things are looked at in a smaller radius

vec3 place_of(ViewData view, ivec2 pixel, float depth) {
    vec2 ndc = (vec2(pixel) + 0.5) * screen.zw * 2.0 - 1.0;
    return (view.ray_forward.xyz + view.ray_right.xyz * ndc.x + view.ray_up.xyz * ndc.y) * (view.fraction.w / depth);
}

// Light between the eye's direction and an angle from it in a slice where the normal stands at angle g.
float light_until(float angle, float g, float cos_g, float sin_g) {
    float arc = 0.25 * (cos_g + 2.0 * angle * sin_g - cos(2.0 * angle - g));
    return angle < 0.0 ? -arc : arc;
}

float open_at(ivec2 pixel, ivec2 size, float depth) {
    uvec4 surface = texelFetch(t_surface, pixel, 0);
    uint number = surface.z & 7u, face = surface.z >> 3 & 7u;
    if (face == kFacePlant) return 1.0;
    ViewData view = views[number];
    vec3 place = place_of(view, pixel, depth);
    float pixels = u_radius.x / (view.ray_right.w * (view.fraction.w / depth)), most = kWidest * screen.y;
    float radius = u_radius.x * min(most / pixels, 1.0);
    pixels = min(pixels, most);
    float fade = smoothstep(1.5, 4.0, pixels); // far away it is smaller than pixels
    if (fade <= 0.0) return 1.0;

    vec3 normal = face < 6u ? axis_of_face(face) : normal_from_bytes(surface.xy);
    vec3 to_eye = -normalize(place);
    vec3 right = normalize(view.ray_right.xyz), up = normalize(view.ray_up.xyz);
    float turn = pixel_noise(pixel, u_turn), shift = pixel_noise(pixel + ivec2(37, 17), u_turn);
    float visible = 0.0, all = 0.0;
    for (int slice = 0; slice < SLICES; ++slice) {
        float phi = (float(slice) + turn) * (kPi / float(SLICES));
        vec2 along = vec2(cos(phi), sin(phi));
        // Axes of the slice: to the eye, and across; what of the normal lies in it.
        vec3 across = right * along.x + up * along.y;
        across = normalize(across - to_eye * dot(across, to_eye));
        vec3 axis = cross(to_eye, across);
        float tilt = dot(normal, axis);
        float flat_share = max(1.0 - tilt * tilt, 1e-3);
        vec2 in_slice = vec2(dot(normal, to_eye), dot(normal, across));
        float g = clamp(atan(in_slice.y, in_slice.x), -kHalfPi, kHalfPi);
        float cos_g = cos(g), sin_g = sin(g);
        float lowest = -0.25 * (2.0 * cos_g + (2.0 * g - kPi) * sin_g), total = cos_g + g * sin_g;
        vec3 back_onto = (axis - normal * tilt) / flat_share;
        uint hidden = 0u;
        for (int side = 0; side < 2; ++side) {
            float sign_of = side == 0 ? 1.0 : -1.0;
            vec3 last = vec3(0.0);
            float last_angle = g + sign_of * kHalfPi; // the surface itself
            for (int i = 0; i < STEPS; ++i) {
                float x = (float(i) + shift) * (1.0 / float(STEPS));
                vec2 at = vec2(pixel) + 0.5 + along * (sign_of * max(pixels * x * x, 1.0));
                ivec2 there = ivec2(floor(at));
                if (any(lessThan(there, ivec2(0))) || any(greaterThanEqual(there, size))) break;
                float far = texelFetch(t_depth, there, 0).r;
                uint what = texelFetch(t_surface, there, 0).z;
                // Not the sky, not through a portal, not blades of grass.
                if (far <= 0.0 || (what & 7u) != number || (what >> 3 & 7u) == kFacePlant) continue;
                vec3 s = place_of(view, there, far) - place;
                // What rises by less than corners are rounded on the screen lies in the surface: seen along itself, a plane
                // of several quads would throw shadows from one onto the next.
                float rise = dot(s, normal);
                if (abs(rise) < kRounded * view.ray_right.w * view.fraction.w / min(depth, far)) s -= normal * rise;
                // The pixel's middle lies beside the slice: moved along the surface into it, heights stay exact.
                // Where the surface is seen along itself that way is long: what it carries past the middle tells nothing.
                s -= back_onto * dot(s, axis);
                if (dot(s, across) * sign_of <= 0.0) continue;
                vec3 gap = s - last;
                bool joined = dot(gap, gap) < radius * radius * (kJoin * kJoin);
                if (dot(s, s) > radius * radius) {
                    // What reaches out of the radius counts until there.
                    if (!joined) continue;
                    float a = dot(gap, gap), b = dot(last, gap), c = dot(last, last) - radius * radius;
                    s = last + gap * ((sqrt(max(b * b - a * c, 0.0)) - b) / max(a, 1e-9));
                }
                float front = atan(dot(s, across), dot(s, to_eye));
                vec3 behind = s - to_eye * kThickness;
                float back = atan(dot(behind, across), dot(behind, to_eye));
                float other = joined ? last_angle : front;
                last = s, last_angle = front;
                vec2 ends = side == 0 ? vec2(min(front, other), max(back, other)) : vec2(min(back, other), max(front, other));
                ends = clamp(ends, g - kHalfPi, g + kHalfPi);
                float from = (light_until(ends.x, g, cos_g, sin_g) - lowest) / total;
                float to = (light_until(ends.y, g, cos_g, sin_g) - lowest) / total;
                uint first = uint(clamp(from, 0.0, 1.0) * 32.0 + 0.5), end = uint(clamp(to, 0.0, 1.0) * 32.0 + 0.5);
                if (end > first) hidden |= (0xffffffffu >> (32u - (end - first))) << first;
            }
        }
        float weight = sqrt(flat_share) * total;
        visible += weight * (1.0 - float(bitCount(hidden)) * (1.0 / 32.0));
        all += weight;
    }
    return mix(1.0, pow(max(visible / max(all, 1e-6), 0.0), u_radius.y), fade);
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy), size = ivec2(screen.xy);
    if (any(greaterThanEqual(pixel, size))) return;
    float depth = texelFetch(t_depth, pixel, 0).r;
    imageStore(i_ao, pixel, vec4(depth > 0.0 ? open_at(pixel, size, depth) : 1.0));
}
