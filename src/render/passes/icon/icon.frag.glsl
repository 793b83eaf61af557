layout(location = 0) in vec3 v_uv_layer;
layout(location = 1) in vec4 v_tint;
layout(binding = 0) uniform sampler2DArray t_albedo;
layout(location = 0) out vec4 o_color;
void main() {
    vec4 c = texture(t_albedo, v_uv_layer);
    if (c.a < 0.1) discard;
    o_color = vec4(c.rgb * v_tint.rgb * c.a, c.a);
}
