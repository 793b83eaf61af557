// Light of every pixel that shows something, once a screen; what differs between views comes from views[view number].
// ONE_VIEW: all pixels belong to view 0: its data are read once, not by pixel. DRY: see water/medium.glsl.
#define GLOSS
#include "common/screen.glsl"
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

layout(binding = 0) uniform sampler2D t_albedo;
layout(binding = 1) uniform sampler2D t_light;
layout(binding = 2) uniform usampler2D t_surface;
layout(binding = 3) uniform sampler2D t_depth;
#ifdef SSAO
layout(binding = 8) uniform sampler2D t_ao;
#endif

void shade_pixel(ivec2 pixel) {
    vec4 albedo = texelFetch(t_albedo, pixel, 0);
    uvec4 surface = texelFetch(t_surface, pixel, 0);
    float depth = texelFetch(t_depth, pixel, 0).r;
#ifdef ONE_VIEW
    const uint number = 0u;
#else
    uint number = surface.z & 7u;
#endif
    ViewData view = views[number];
    vec3 ray = view.ray_forward.xyz + view.ray_right.xyz * v_ndc.x + view.ray_up.xyz * v_ndc.y;
    float per_length = inversesqrt(dot(ray, ray));
    vec3 place = ray * (view.fraction.w / max(depth, 1e-9));
    float away = length(place);

    Surface s;
    s.albedo = linear_from_srgb(albedo.rgb);
    s.normal = normal_from_bytes(surface.xy);
    uint face = surface.z >> 3 & 7u;
    s.face = face < 6u ? axis_of_face(face) : s.normal;
    s.plant = face == kFacePlant;
    s.light = texelFetch(t_light, pixel, 0);
    s.ao = albedo.a;
    s.roughness = float(surface.w >> 4) * (1.0 / 15.0);
    s.emission = float(surface.w & 15u) * (1.0 / 15.0);
#ifdef SSAO
    s.screen_ao = texelFetch(t_ao, pixel, 0).r;
#endif
    vec3 towards = ray * per_length;
    vec3 color = shade(s, place, towards, number);
    put(vec4(apply_fog(color, away, towards, number, s.light.a), 1.0));
}
