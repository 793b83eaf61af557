// Surfaces of liquids near the eye are cut into squares of a block, so that waves can bend them; all else stays whole. Cuts
// lie at whole blocks, whatever quads they belong to: neighbors meet corner to corner.
#include "common/frame.glsl"
layout(vertices = 4) out;

layout(location = 0) in vec3 v_uv_ao[];
layout(location = 1) in vec3 v_light_at[];
layout(location = 2) in vec3 v_tint[];
layout(location = 3) in uvec2 v_surface[];
layout(location = 4) in vec3 v_position[];
layout(location = 5) in vec3 v_world[];
layout(location = 6) in float v_bob[];
layout(location = 0) out vec3 c_uv_ao[];
layout(location = 1) out vec3 c_light_at[];
layout(location = 2) out vec3 c_tint[];
layout(location = 3) out uvec2 c_surface[];
layout(location = 4) out vec3 c_position[];
layout(location = 5) out vec3 c_world[];
layout(location = 6) out float c_bob[];

// A patch is the six indices of a quad's two triangles.
const int kCorner[4] = int[](0, 1, 2, 4);

float cuts(int a, int b) {
    return v_bob[a] * v_bob[b] > 0.0 ? max(floor(distance(v_world[a].xz, v_world[b].xz) + 0.5), 1.0) : 1.0;
}

void main() {
    int from = kCorner[gl_InvocationID];
    c_uv_ao[gl_InvocationID] = v_uv_ao[from];
    c_light_at[gl_InvocationID] = v_light_at[from];
    c_tint[gl_InvocationID] = v_tint[from];
    c_surface[gl_InvocationID] = v_surface[from];
    c_position[gl_InvocationID] = v_position[from];
    c_world[gl_InvocationID] = v_world[from];
    c_bob[gl_InvocationID] = v_bob[from];
    if (gl_InvocationID == 0) {
        bool gone = gl_in[0].gl_Position.w == 0.0; // looks away
        gl_TessLevelOuter[0] = gone ? 0.0 : cuts(0, 4);
        gl_TessLevelOuter[1] = gone ? 0.0 : cuts(0, 1);
        gl_TessLevelOuter[2] = gone ? 0.0 : cuts(1, 2);
        gl_TessLevelOuter[3] = gone ? 0.0 : cuts(4, 2);
        gl_TessLevelInner[0] = max(gl_TessLevelOuter[1], gl_TessLevelOuter[3]);
        gl_TessLevelInner[1] = max(gl_TessLevelOuter[0], gl_TessLevelOuter[2]);
    }
}
