// What of the surfaces that let light through lies where: red the depth of the farthest, green (negated) that of the nearest
// way out of a liquid. Blended by the least of each.
#include "common/frame.glsl"
#include "common/normal.glsl"
#include "water/sides.glsl"
layout(location = 3) flat in uvec2 v_surface;
layout(location = 4) in vec3 v_position;
layout(location = 0) out vec2 o_layers;

void main() {
    bool leaves = is_liquid(v_surface) && leaves_liquid(v_surface, v_position);
    o_layers = vec2(gl_FragCoord.z, leaves ? -gl_FragCoord.z : 0.0);
}
