// Opaque and cutout terrain into the G-buffer. Colors stay sRGB-encoded in the G-buffer:
// textures, tints and their product are what artists see; lighting decodes them once a pixel.
// CUTOUT: holes. NORMAL_MAPS: relief.
#include "common/frame.glsl"
#include "common/normal.glsl"
#include "common/surface.glsl"

layout(location = 0) in vec3 v_uv_ao;
layout(location = 1) in vec3 v_light_at;
layout(location = 2) in vec3 v_tint;
layout(location = 3) flat in uvec2 v_surface;
#ifdef NORMAL_MAPS
layout(location = 4) in vec3 v_position;
#endif
layout(binding = 0) uniform sampler2DArray t_albedo;
layout(binding = 1) uniform sampler3D t_light;
layout(binding = 2) uniform sampler2DArray t_material; // normal x, normal y, roughness, emission

layout(location = 0) out vec4 o_albedo;   // sRGB-encoded albedo, ambient occlusion
layout(location = 1) out vec4 o_light;    // block light r g b, sky light, each level / 15
layout(location = 2) out uvec4 o_surface; // normal (octahedral), view number | face << 3, roughness << 4 | emission

#ifdef NORMAL_MAPS
vec3 relief(vec3 n, vec2 slope) {
    // The texture's axes in the world from screen derivatives, so that any model may turn its texture.
    vec3 px = dFdx(v_position), py = dFdy(v_position);
    vec2 ux = dFdx(v_uv_ao.xy), uy = dFdy(v_uv_ao.xy);
    vec3 a = cross(py, n), b = cross(n, px);
    vec3 tangent = a * ux.x + b * uy.x, bitangent = a * ux.y + b * uy.y;
    float size = max(max(dot(tangent, tangent), dot(bitangent, bitangent)), 1e-24);
    return normalize(n + (tangent * slope.x + bitangent * slope.y) * inversesqrt(size));
}
#endif

void main() {
    vec3 at = vec3(v_uv_ao.xy, float(v_surface.x));
    vec4 albedo = texture(t_albedo, at);
    // Before the holes: derivatives end where a neighbor is discarded.
    vec4 material = texture(t_material, at);
#ifdef NORMAL_MAPS
    vec3 n = normal_from_bytes(uvec2(v_surface.y & 255u, v_surface.y >> 8 & 255u));
    // What is tilted keeps its plain normal: shadows need that of the geometry, and it has no other place.
    vec3 raised = relief(n, material.rg * 2.0 - 1.00392157);
    if ((v_surface.y >> 19 & 7u) != kFaceModel) n = raised;
#endif
#ifdef CUTOUT
    if (albedo.a < 0.5) discard;
#endif
    vec4 light = texture(t_light, v_light_at).bgra;
#ifdef CUTOUT
    vec3 color = albedo.rgb * v_tint;
#else
    vec3 color = albedo.rgb * mix(vec3(1.0), v_tint, albedo.a); // alpha: how much of the tint (render/texture_set.h)
#endif
    o_albedo = vec4(color, v_uv_ao.z);
    o_light = light;
    uvec4 surface = uvec4(v_surface.y & 255u, v_surface.y >> 8 & 255u, v_surface.y >> 16 & 255u, 0u);
#ifdef NORMAL_MAPS
    surface.xy = normal_bytes(n);
#endif
    surface.w = uint(material.b * 15.0 + 0.5) << 4 | uint(material.a * 15.0 + 0.5);
    o_surface = surface;
}
