layout(location = 0) in vec3 v_uv_layer;
layout(location = 1) in vec4 v_tint;
layout(location = 2) in float v_shade;
layout(binding = 0) uniform sampler2DArray t_albedo;
layout(location = 0) out vec4 o_color;
void main() {
    vec4 c = texture(t_albedo, v_uv_layer);
    vec3 tint = v_tint.rgb;
    if (v_tint.a > 0.5) tint = mix(vec3(1.0), tint, c.a), c.a = 1.0;
    if (c.a < 0.1) discard;
    o_color = vec4(c.rgb * tint * v_shade * c.a, c.a);
}
