// A block seen from above at a corner, for the hotbar. Plain vertices: position in the block, texture, shade, tint.
layout(location = 0) in vec4 in_position; // xyz 0..1; w: layer
layout(location = 1) in vec4 in_look;     // s, t, shade, solid: alpha is the share of tint
layout(location = 2) in vec4 in_tint;
layout(location = 0) uniform int u_flat; // 1: seen straight from the front
layout(location = 0) out vec3 v_uv_layer;
layout(location = 1) out vec4 v_tint;
layout(location = 2) out float v_shade;
void main() {
    vec3 p = in_position.xyz - 0.5;
    // Turn by 45 degrees, look down by 30: the classic view of a block.
    vec2 turned = vec2(p.x - p.z, p.x + p.z) * 0.70710678;
    vec2 screen = vec2(turned.x, p.y * 0.8660254 - turned.y * 0.5);
    float depth = p.y * 0.5 + turned.y * 0.8660254;
    gl_Position = vec4(u_flat != 0 ? p.xy * 1.9 : screen * 1.22, 0.5 + depth * 0.25, 1.0);
    v_uv_layer = vec3(in_look.xy, in_position.w);
    v_tint = vec4(in_tint.rgb, in_look.w);
    v_shade = in_look.z;
}
