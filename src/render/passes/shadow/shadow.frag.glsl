// Into a shadow map. CUTOUT: holes. COLORED: translucent surfaces multiply the light that they let through; the least
// of a is the depth of the nearest, in steps of two 65535ths, odd for liquids, which take more the longer the way.
#include "common/color.glsl"
#ifdef CUTOUT
layout(location = 0) in vec3 v_look; // texture coordinates, layer
#endif
#ifdef COLORED
layout(location = 0) in vec3 v_look;
layout(location = 1) flat in vec4 v_tint; // w: 1 for liquids
layout(location = 0) out vec4 o_through;
#endif
layout(binding = 0) uniform sampler2DArray t_albedo;
layout(location = 6) uniform float u_level; // of detail

void main() {
#ifdef CUTOUT
    if (textureLod(t_albedo, v_look, u_level).a < 0.5) discard;
#endif
#ifdef COLORED
    vec4 look = textureLod(t_albedo, v_look, u_level);
    vec3 color = linear_from_srgb(look.rgb * v_tint.rgb);
    // Glass dyes what passes by its hue at full strength, dark glass stays dark; where it is clear, nothing happens.
    vec3 dye = color * (0.95 / max(max(max(color.r, color.g), color.b), 0.25));
    vec3 through = mix(vec3(1.0), dye, clamp(look.a * 2.2, 0.0, 1.0));
    // A liquid's surface mirrors a little away; its depth does the rest (shadow.glsl).
    if (v_tint.w > 0.0) through = vec3(0.96);
    float depth = floor(clamp(gl_FragCoord.z, 0.0, 1.0) * 32766.0 + 0.5);
    o_through = vec4(through, (depth * 2.0 + v_tint.w) * (1.0 / 65535.0));
#endif
}
