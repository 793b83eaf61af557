// Surfaces that let light through, drawn forward over the lit picture, back to front.
#include "common/frame.glsl"
#include "common/sky.glsl"
#include "common/color.glsl"
#include "common/normal.glsl"
#include "common/surface.glsl"
#include "common/ambient.glsl"
#include "water/medium.glsl"
#include "water/caustics.glsl"
#include "common/fog.glsl"
#include "shadow/shadow.glsl"
#include "lighting/lamp_light.glsl"
#include "lighting/shade.glsl"
#include "water/sides.glsl"
#include "water/waves.glsl"
#include "water/glass.glsl"

layout(location = 0) in vec3 v_uv_ao;
layout(location = 1) in vec3 v_light_at;
layout(location = 2) in vec3 v_tint;
layout(location = 3) flat in uvec2 v_surface;
layout(location = 4) in vec3 v_position;
layout(location = 5) in vec3 v_world;
layout(binding = 0) uniform sampler2DArray t_albedo;
layout(binding = 1) uniform sampler3D t_light;
#ifdef MIRRORS
#include "ssr/ssr.glsl"
#else
layout(binding = 3) uniform sampler2D t_depth; // of the solid picture
#ifdef SCENE
layout(binding = 4) uniform sampler2D t_scene; // the solid picture
#endif
#endif
#ifdef SCENE
// Of layers.frag.glsl: red the depth of the farthest surface, green (negated) that of the nearest way out of a liquid.
#ifdef ATOMIC
layout(binding = 14) uniform usampler2D t_farthest;
layout(binding = 15) uniform usampler2D t_way_out;
vec2 layers_at(ivec2 pixel) {
    return vec2(uintBitsToFloat(texelFetch(t_farthest, pixel, 0).r), -uintBitsToFloat(texelFetch(t_way_out, pixel, 0).r));
}
#else
layout(binding = 14) uniform sampler2D t_layers;
vec2 layers_at(ivec2 pixel) { return texelFetch(t_layers, pixel, 0).rg; }
#endif
#endif
#include "water/liquid.glsl"
// Two sources of one blend: what is added, and by color what is let through of the light behind. Water and colored
// glass absorb; a single opacity would make bright sand under water white.
layout(location = 0, index = 0) out vec4 o_color;
layout(location = 0, index = 1) out vec4 o_through;

void main() {
    vec4 albedo = texture(t_albedo, vec3(v_uv_ao.xy, float(v_surface.x)));
    vec4 light = texture(t_light, v_light_at).bgra;
    float per_length = inversesqrt(max(dot(v_position, v_position), 1e-12));
    float away = dot(v_position, v_position) * per_length;
    vec3 towards = v_position * per_length;
    uint face = v_surface.y >> 19 & 7u, number = v_surface.y >> 16 & 7u;
    bool liquid = is_liquid(v_surface);
    vec3 n = surface_normal(v_surface);
    Surface s;
    s.albedo = liquid ? vec3(1.0) : linear_from_srgb(albedo.rgb * v_tint);
    // A liquid is lit from above, whichever of its sides one looks at.
    s.normal = liquid ? vec3(0.0, 1.0, 0.0) : n;
    s.face = face < 6u ? axis_of_face(face) : s.normal;
    s.plant = false;
    s.light = light;
    s.ao = v_uv_ao.z;
    s.roughness = 1.0;
    s.emission = 0.0;
    vec3 lit = shade(s, v_position, towards, number);
    Blend result;
    if (liquid) {
        result = shade_liquid(lit, light, towards, away, number);
    } else {
        Pane pane = pane_of(s.albedo, albedo.a);
        n = dot(n, towards) > 0.0 ? -n : n;
        vec3 mirror = reflect(towards, n);
        float share = fresnel(max(-dot(n, towards), 0.02), 1.5) * (1.0 - pane.own) * 0.7;
        vec3 reflected = sky_dome(mirror.y < 0.0 ? vec3(mirror.x, 0.0, mirror.z) : mirror) * (light.a * light.a * (mirror.y < 0.0 ? 0.4 : 1.0));
#ifdef MIRRORS
        if (share > 0.02) {
            vec4 seen = march_reflection(v_position + n * 0.02, mirror, number, 0.5);
            reflected = mix(reflected, seen.rgb, seen.a);
        }
#endif
        result.through = pane.through * (1.0 - share);
        result.color = lit * pane.own + reflected * share;
        // What lies behind has its fog already; the surface's own light gets the share that it covers.
        vec3 covered = max(1.0 - result.through, vec3(1e-3));
        result.color = apply_fog(result.color / covered, away, towards, number, light.a) * covered;
    }
    o_color = vec4(result.color, 0.0);
    o_through = vec4(result.through, 1.0);
}
