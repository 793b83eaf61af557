// Twice the size: a 3 x 3 tent over the smaller level (Jimenez 2014), blended over the level that is there.
layout(binding = 0) uniform sampler2D t_from;
layout(location = 0) out vec4 o_color;

void main() {
    vec2 t = 1.0 / vec2(textureSize(t_from, 0));
    vec2 at = gl_FragCoord.xy * 0.5 * t;
    vec3 sum = textureLod(t_from, at, 0.0).rgb * 4.0;
    sum += (textureLod(t_from, at + vec2(-t.x, 0), 0.0).rgb + textureLod(t_from, at + vec2(t.x, 0), 0.0).rgb + textureLod(t_from, at + vec2(0, -t.y), 0.0).rgb + textureLod(t_from, at + vec2(0, t.y), 0.0).rgb) * 2.0;
    sum += textureLod(t_from, at - t, 0.0).rgb + textureLod(t_from, at + t, 0.0).rgb + textureLod(t_from, at + vec2(t.x, -t.y), 0.0).rgb + textureLod(t_from, at + vec2(-t.x, t.y), 0.0).rgb;
    o_color = vec4(sum * (1.0 / 16.0), 1.0);
}
