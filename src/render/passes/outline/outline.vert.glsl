// Edges of boxes as thin ribbons: 12 edges, 6 vertices each, one instance a box.
#include "common/frame.glsl"
layout(location = 0) in vec4 in_min; // camera-relative
layout(location = 1) in vec4 in_max;
layout(location = 0) uniform uint u_view;
out float gl_ClipDistance[1];

void main() {
    uint edge = uint(gl_VertexID) / 6u, vertex = uint(gl_VertexID) % 6u;
    uint axis = edge >> 2, which = edge & 3u;
    vec3 a = vec3(0.0);
    vec3 along = axis == 0u ? vec3(1, 0, 0) : axis == 1u ? vec3(0, 1, 0) : vec3(0, 0, 1);
    float p = float(which & 1u), q = float(which >> 1);
    a = axis == 0u ? vec3(0.0, p, q) : axis == 1u ? vec3(p, 0.0, q) : vec3(p, q, 0.0);
    // A hair outside the block and towards the eye, so that the faces do not swallow it.
    vec3 lo = in_min.xyz - 0.002, hi = in_max.xyz + 0.002;
    ViewData view = views[u_view];
    vec3 start = mix(lo, hi, a) * 0.998, end = mix(lo, hi, a + along) * 0.998;
    vec4 s = view.view_proj * vec4(start, 1.0), e = view.view_proj * vec4(end, 1.0);
    // Behind the eye an edge has no direction on the screen: cut it at the near plane.
    float near = view.fraction.w;
    if (s.w < near && e.w < near) {
        gl_Position = vec4(0.0, 0.0, -1.0, 0.0);
        gl_ClipDistance[0] = -1.0;
        return;
    }
    if (s.w < near) s = mix(s, e, (near - s.w) / (e.w - s.w));
    else if (e.w < near) e = mix(e, s, (near - e.w) / (s.w - e.w));
    vec2 direction = (e.xy / e.w - s.xy / s.w) * screen.xy;
    float size = max(length(direction), 1e-6);
    vec2 side = vec2(-direction.y, direction.x) / size * screen.zw * max(screen.y / 420.0, 1.0);
    bool at_end = vertex == 1u || vertex == 2u || vertex == 4u;
    float sign = vertex == 0u || vertex == 1u || vertex == 3u ? 1.0 : -1.0;
    if (vertex == 3u) at_end = false;
    vec4 position = at_end ? e : s;
    position.xy += side * sign * position.w;
    gl_Position = position;
    gl_ClipDistance[0] = dot(view.clip_plane, vec4(at_end ? end : start, 1.0));
}
