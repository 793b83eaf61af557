// Light of every pixel that shows something, once a screen; what differs between views comes from views[view number].
#include "common/frame.glsl"
#include "common/sky.glsl"
#include "common/color.glsl"
#include "common/normal.glsl"
#include "lighting/shade.glsl"

layout(location = 0) in vec2 v_ndc;
layout(binding = 0) uniform sampler2D t_albedo;
layout(binding = 1) uniform sampler2D t_light;
layout(binding = 2) uniform usampler2D t_surface;
layout(binding = 3) uniform sampler2D t_depth;
layout(location = 0) out vec4 o_color;

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec4 albedo = texelFetch(t_albedo, pixel, 0);
    vec4 light = texelFetch(t_light, pixel, 0);
    uvec4 surface = texelFetch(t_surface, pixel, 0);
    float depth = texelFetch(t_depth, pixel, 0).r;
    ViewData view = views[surface.z & 7u];
    vec3 ray = view.ray_forward.xyz + view.ray_right.xyz * v_ndc.x + view.ray_up.xyz * v_ndc.y;
    float ray_length2 = dot(ray, ray);
    float per_length = inversesqrt(ray_length2);
    vec3 towards = ray * per_length;
    float away = view.fraction.w / max(depth, 1e-9) * ray_length2 * per_length;

    vec3 n = normal_from_bytes(surface.xy);
    float roughness = float(surface.w >> 4) * (1.0 / 15.0), emission = float(surface.w & 15u) * (1.0 / 15.0);
    vec3 color = shade(linear_from_srgb(albedo.rgb), n, light, albedo.a, emission, roughness, towards);
    o_color = vec4(apply_fog(color, away, towards, view.ray_up.w, light.a), 1.0);
}
