#define GLOSS
// Translucent surfaces, drawn forward over the lit picture, back to front: water, glass, ice, crystals.
#include "common/frame.glsl"
#include "common/sky.glsl"
#include "common/color.glsl"
#include "common/normal.glsl"
#include "common/surface.glsl"
#include "common/ambient.glsl"
#include "common/fog.glsl"
#include "shadow/shadow.glsl"
#include "lighting/shade.glsl"

layout(location = 0) in vec3 v_uv_ao;
layout(location = 1) in vec3 v_light_at;
layout(location = 2) in vec3 v_tint;
layout(location = 3) flat in uvec2 v_surface;
layout(location = 4) in vec3 v_position;
layout(location = 5) in vec3 v_local;
layout(binding = 0) uniform sampler2DArray t_albedo;
layout(binding = 1) uniform sampler3D t_light;
#ifdef SEES_DEPTH
layout(binding = 3) uniform sampler2D t_depth; // of what lies behind
#endif
// Two sources of one blend: what is added, and by color what is let through of the light behind. Water and colored
// glass absorb; a single opacity would make bright sand under water white.
layout(location = 0, index = 0) out vec4 o_color;
layout(location = 0, index = 1) out vec4 o_through;

// Slope of the water: four waves with a whole number of periods over 16 blocks, so that sections meet, nothing swims with
// the camera and every place of the world has the same.
vec2 wave_slope(vec2 p, float t) {
    p *= 0.392699082;
    vec2 slope = vec2(0.0);
    slope += vec2(2.0, 1.0) * cos(dot(p, vec2(2.0, 1.0)) + t * 1.1) * 0.020;
    slope += vec2(-1.0, 3.0) * cos(dot(p, vec2(-1.0, 3.0)) + t * 1.4) * 0.014;
    slope += vec2(5.0, -4.0) * cos(dot(p, vec2(5.0, -4.0)) + t * 2.3) * 0.006;
    slope += vec2(4.0, 7.0) * cos(dot(p, vec2(4.0, 7.0)) - t * 2.9) * 0.004;
    return slope;
}

void main() {
    vec4 albedo = texture(t_albedo, vec3(v_uv_ao.xy, float(v_surface.x)));
    vec4 light = texture(t_light, v_light_at).bgra;
    vec3 n = normal_from_bytes(uvec2(v_surface.y & 255u, v_surface.y >> 8 & 255u));
    bool liquid = (v_surface.y >> 24 & 1u) != 0u;
    float per_length = inversesqrt(max(dot(v_position, v_position), 1e-12));
    float away = dot(v_position, v_position) * per_length;
    vec3 towards = v_position * per_length;
    ViewData view = views[v_surface.y >> 16 & 7u];

#ifdef WAVES
    if (liquid) {
        // Waves smaller than a pixel would only glitter.
        vec2 slope = wave_slope(v_local.xz, misc.x) / (1.0 + away * away * 0.0004);
        n = normalize(n + vec3(slope.x, 0.0, slope.y) * (abs(n.y) > 0.5 ? 1.0 : 0.0));
    }
#endif
    float facing = abs(dot(n, towards));
    float graze = 1.0 - facing;
    float g2 = graze * graze;
    float fresnel = 0.02 + 0.98 * g2 * g2 * graze;
    vec3 base = linear_from_srgb(albedo.rgb * v_tint);
    // Water's own color is the light it scatters: never as pure as a painted tint.
    if (liquid) base = mix(base, vec3(0.02, 0.12, 0.16) + dot(base, vec3(0.25, 0.55, 0.20)) * vec3(0.35, 0.60, 0.70), 0.6);
    // The sun in the water is the mirror below; counted as gloss too it would be a white sheet.
    uint face = v_surface.y >> 19 & 7u, number = v_surface.y >> 16 & 7u;
    Surface s;
    s.albedo = base;
    s.normal = n;
    s.face = face < 6u ? axis_of_face(face) : n;
    s.plant = false;
    s.light = light;
    s.ao = v_uv_ao.z;
    s.roughness = liquid ? 1.0 : 0.1;
    s.emission = 0.0;
    vec3 body = shade(s, v_position, towards, number);
#ifdef SEES_DEPTH
    float behind = view.fraction.w / max(texelFetch(t_depth, ivec2(gl_FragCoord.xy), 0).r, 1e-9);
    float here = view.fraction.w / max(gl_FragCoord.z, 1e-9);
    // Along the ray, not along the view's axis.
    float thickness = max(behind - here, 0.0) * (away / max(here, 1e-3));
#else
    float thickness = 2.2;
#endif
    // A liquid's share grows with the way through it; red goes first. Glass has the opacity of its texture, and what passes takes
    // a little of its color.
    vec3 clear = liquid ? exp2(-thickness * vec3(0.62, 0.24, 0.17)) * 0.97 : mix(vec3(1.0), albedo.rgb * 1.2, 0.35) * (1.0 - albedo.a);
    vec3 own = liquid ? 1.0 - exp2(-thickness * vec3(0.34)) : vec3(albedo.a);
    // Mirror: the sky in the reflected direction where the sky is open, else darkness.
    vec3 mirror = reflect(towards, n);
    mirror.y = abs(mirror.y);
    vec3 reflected = sky_dome(mirror) * (light.a * light.a);
    float glint = max(dot(mirror, light_direction.xyz), 0.0);
    glint *= glint;
    glint *= glint;
    glint *= glint;
    glint *= glint;
    glint *= glint;
    reflected += sun_light.rgb * (light.a > 0.9 ? glint * glint * glint * 3.0 : 0.0);
    float shine = fresnel * (liquid ? 1.0 : 0.6) * (1.0 - view.ray_up.w);
    clear *= 1.0 - shine;
    vec3 color = body * own * (1.0 - shine) + reflected * shine;
    // What lies behind has its fog already; the surface's own light gets the share that it covers.
    vec3 covered = 1.0 - clear;
    vec3 fogged = apply_fog(color / max(covered, vec3(1e-3)), away, towards, view.ray_up.w, light.a) * covered;
    o_color = vec4(fogged, 1.0);
    o_through = vec4(clear, 0.0);
}
