// A picture that the path tracer made, in place of what the passes before "the eye" draw: its light, and its distances as
// depth, so that what is drawn into the world (the outline) is hidden as it should be.
#include "common/frame.glsl"
layout(binding = 0) uniform sampler2D t_film; // rgb: linear light; a: blocks along the ray, 0 sky; first row on top
layout(location = 0) out vec4 o_color;

void main() {
    vec2 at = vec2(gl_FragCoord.x, screen.y - gl_FragCoord.y) * screen.zw;
    o_color = vec4(textureLod(t_film, at, 0.0).rgb, 1.0);
    ivec2 size = textureSize(t_film, 0);
    float away = texelFetch(t_film, min(ivec2(at * vec2(size)), size - 1), 0).a;
    vec2 ndc = gl_FragCoord.xy * screen.zw * 2.0 - 1.0;
    vec3 ray = views[0].ray_forward.xyz + views[0].ray_right.xyz * ndc.x + views[0].ray_up.xyz * ndc.y;
    // Reversed: 1 at the near plane, 0 at infinity.
    gl_FragDepth = away > 0.0 ? clamp(views[0].fraction.w * length(ray) / away, 0.0, 1.0) : 0.0;
}
