// Mirror rays through what is on the screen. Needs common/frame.glsl and common/surface.glsl; MARCH_STEPS: how many steps
// (reflections.steps); the passes that include it bind the depth at unit 3 and "scene" (scene_copy_pass.h) at unit 4.
//
//     vec4 seen = march_reflection(place, direction, view, jitter);
//     reflected = mix(sky, seen.rgb, seen.a);
//
// Depth is reversed and has no far plane: it is near / distance along the view, which is linear on the screen. A ray is
// therefore a straight line in (x, y, depth), as McGuire and Mara (2014) march it, and one that leaves the eye ends in the
// vanishing point of its direction at depth 0. Steps grow with their distance from the surface; the first that lies behind
// something is halved until the crossing is found, and counts where the ray is no farther behind than things are thick.
layout(binding = 3) uniform sampler2D t_depth;
layout(binding = 4) uniform sampler2D t_scene;

const float kMarchThickness = 0.9; // blocks, of what the ray may have passed behind
const int kMarchHalvings = 6;
const float kMarchBorder = 0.06; // of the screen: reflections end softly before it

struct MarchHit {
    vec2 uv;          // on the screen
    float along;      // blocks that the ray went; a very large number for the sky
    float confidence; // 0: nothing was found
};

// place: camera-relative, a little outside the surface. direction: unit. view: the surface's; what belongs to another is
// not seen. jitter: 0..1, of the pixel: spreads what the steps leave out.
MarchHit march_screen(vec3 place, vec3 direction, uint view, float jitter) {
    const MarchHit none = MarchHit(vec2(0.0), 0.0, 0.0);
    float near = views[view].fraction.w;
    vec4 start = views[view].view_proj * vec4(place, 1.0), way = views[view].view_proj * vec4(direction, 0.0);
    if (start.w <= near) return none;
    // As (u, v, depth) from the start to where the ray passes the near plane, or to infinity.
    vec3 from = vec3(start.xy / start.w * 0.5 + 0.5, near / start.w);
    float far = 4.0 / misc.y; // blocks: beyond it nothing is drawn
    bool leaves = way.w * far > 0.5 * start.w;
    float reach = way.w < 0.0 ? min(far, (start.w - 1.01 * near) / -way.w) : far;
    vec4 end = leaves ? way : start + way * reach;
    vec3 to = vec3(end.xy / end.w * 0.5 + 0.5, leaves ? 0.0 : near / end.w);
    vec3 line = to - from;
    // As much of it as is on the screen.
    vec2 room = mix(from.xy, 1.0 - from.xy, vec2(greaterThan(line.xy, vec2(0.0)))) / max(abs(line.xy), vec2(1e-7));
    bool ends = min(room.x, room.y) >= 1.0; // on the screen
    line *= min(min(room.x, room.y), 1.0);
    vec2 size = screen.xy;
    float pixels = max(abs(line.x) * size.x, abs(line.y) * size.y);
    if (pixels < 1.0 || !(pixels < 1e6)) return none;

    // Steps grow from a pixel or two, so that what stands on the mirror touches its image.
    float first = min(1.5 / pixels, 1.0);
    float before = first * 0.5;
    for (int i = 0; i < MARCH_STEPS; ++i) {
        float x = (float(i) + jitter) * (1.0 / float(MARCH_STEPS));
        float now = i + 1 == MARCH_STEPS ? 1.0 : first + (1.0 - first) * x * sqrt(x);
        vec3 p = from + line * now;
        float depth = texelFetch(t_depth, min(ivec2(p.xy * size), ivec2(size) - 1), 0).r;
        if (depth > p.z) {
            // The crossing lies between the last step, in front, and this one, behind.
            float front = before, back = now;
            for (int k = 0; k < kMarchHalvings; ++k) {
                float middle = 0.5 * (front + back);
                vec3 m = from + line * middle;
                bool behind = texelFetch(t_depth, min(ivec2(m.xy * size), ivec2(size) - 1), 0).r > m.z;
                front = behind ? front : middle;
                back = behind ? middle : back;
            }
            vec3 hit = from + line * back;
            ivec2 pixel = min(ivec2(hit.xy * size), ivec2(size) - 1);
            float surface = near / max(texelFetch(t_depth, pixel, 0).r, 1e-9), ray = near / max(hit.z, 1e-9);
            uint seen = uint(texelFetch(t_scene, pixel, 0).a + 0.5);
            uint face = seen >> 3;
            // A face that looks the way the ray goes was reached from its back.
            bool facing = face >= 6u || dot(axis_of_face(face), direction) < 0.0;
            // Between the halvings' ends depth may still jump: allow what a pixel spans.
            float slack = abs(near / max(from.z + line.z * front, 1e-9) - ray);
            if (ray - surface < kMarchThickness + slack && (seen & 7u) == view && facing) {
                vec2 inside = smoothstep(vec2(0.0), vec2(kMarchBorder), min(hit.xy, 1.0 - hit.xy));
                // Along the ray: w grows by way.w a block; where it hardly grows, x or y tell.
                vec3 d = abs(way.xyw);
                vec2 ndc = (hit.xy * 2.0 - 1.0) * ray;
                float along = d.z > 0.3 ? (ray - start.w) / way.w
                            : d.x > d.y ? (ndc.x - start.x) / way.x : (ndc.y - start.y) / way.y;
                return MarchHit(hit.xy, max(along, 0.0), inside.x * inside.y);
            }
        }
        before = now;
    }
    // The ray left the world where the screen shows the sky: its clouds and glow are better than a computed dome.
    if (ends && leaves && view == 0u && texelFetch(t_depth, min(ivec2(to.xy * size), ivec2(size) - 1), 0).r == 0.0) {
        vec2 inside = smoothstep(vec2(0.0), vec2(kMarchBorder), min(to.xy, 1.0 - to.xy));
        return MarchHit(to.xy, 1e6, inside.x * inside.y);
    }
    return none;
}

// Rays that come back to the eye show the backs of things, which the screen has not.
float march_fade(vec3 place, vec3 direction) {
    float back = -dot(place, direction) * inversesqrt(max(dot(place, place), 1e-9));
    return 1.0 - smoothstep(0.55, 0.85, back);
}

// Filtered, but not with texels of another view.
vec3 scene_light(vec2 uv, float lod, uint view) {
    uvec4 views_near = uvec4(textureGather(t_scene, uv, 3) + 0.5) & 7u;
    if (any(notEqual(views_near, uvec4(view)))) return texelFetch(t_scene, min(ivec2(uv * screen.xy), ivec2(screen.xy) - 1), 0).rgb;
    return textureLod(t_scene, uv, lod).rgb;
}

// rgb: light from there; a: how sure it is, 0..1.
vec4 march_reflection(vec3 place, vec3 direction, uint view, float jitter) {
    float fade = march_fade(place, direction);
    if (fade <= 0.0) return vec4(0.0);
    MarchHit hit = march_screen(place, direction, view, jitter);
    if (hit.confidence <= 0.0) return vec4(0.0);
    return vec4(scene_light(hit.uv, 0.0, view), hit.confidence * fade);
}

// The same in a rough mirror: the light of a cone. spread: tangent of its half angle.
vec4 march_reflection_rough(vec3 place, vec3 direction, uint view, float jitter, float spread) {
    float fade = march_fade(place, direction);
    if (fade <= 0.0) return vec4(0.0);
    MarchHit hit = march_screen(place, direction, view, jitter);
    if (hit.confidence <= 0.0) return vec4(0.0);
    // The cone's width at the hit as the eye sees it: its image lies as far behind the mirror as the hit before it.
    float away = length(place);
    float width = spread * hit.along / max(away + hit.along, 1e-3) / views[view].ray_right.w;
    return vec4(scene_light(hit.uv, log2(max(2.0 * width, 1.0)), view), hit.confidence * fade);
}
