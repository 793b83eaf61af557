// Opaque and cutout terrain into the G-buffer. Colors stay sRGB-encoded in the G-buffer:
// textures, tints and their product are what artists see; lighting decodes them once a pixel.
// CUTOUT: holes. NORMAL_MAPS: relief.
#include "common/frame.glsl"
#include "common/normal.glsl"
#include "common/surface.glsl"
#include "terrain/look.glsl"

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

void main() {
    vec3 at = vec3(v_uv_ao.xy, float(v_surface.x));
    vec4 albedo = texture(t_albedo, at);
    // Before the holes: derivatives end where a neighbor is discarded.
    vec4 material = texture(t_material, at);
    uvec2 normal = uvec2(v_surface.y & 255u, v_surface.y >> 8 & 255u);
#ifdef NORMAL_MAPS
    vec3 raised = relief(normal_from_bytes(normal), slope_of(material), dFdx(v_position), dFdy(v_position),
                         dFdx(v_uv_ao.xy), dFdy(v_uv_ao.xy));
    if (has_relief(v_surface)) normal = normal_bytes(raised);
#endif
#ifdef CUTOUT
    if (albedo.a < 0.5) discard;
#endif
#ifdef CUTOUT
    const bool cutout = true;
#else
    const bool cutout = false;
#endif
    o_albedo = vec4(tinted(albedo, v_tint, cutout), v_uv_ao.z);
    o_light = texture(t_light, v_light_at).bgra;
    o_surface = surface_bytes(v_surface, normal, material);
}
