// The corners of what water.tesc.glsl cut, moved by the waves. They fade away towards kSwellEnd, where surfaces lie flat
// and whole, and close to the eye, which must not dip into a wave that the game does not know of.
#include "common/frame.glsl"
#include "water/waves.glsl"
layout(quads, equal_spacing, ccw) in;

layout(location = 0) in vec3 c_uv_ao[];
layout(location = 1) in vec3 c_light_at[];
layout(location = 2) in vec3 c_tint[];
layout(location = 3) in uvec2 c_surface[];
layout(location = 4) in vec3 c_position[];
layout(location = 5) in vec3 c_world[];
layout(location = 6) in float c_bob[];
layout(location = 0) out vec3 v_uv_ao;
layout(location = 1) out vec3 v_light_at;
layout(location = 2) out vec3 v_tint;
layout(location = 3) flat out uvec2 v_surface;
layout(location = 4) out vec3 v_position;
layout(location = 5) out vec3 v_world;
layout(location = 6) out float v_bob;
out float gl_ClipDistance[1];

const float kSwellEnd = 32.0; // blocks; render::kSwellReach

vec3 between(vec3 a, vec3 b, vec3 c, vec3 d) {
    return mix(mix(a, b, gl_TessCoord.x), mix(d, c, gl_TessCoord.x), gl_TessCoord.y);
}

void main() {
    v_uv_ao = between(c_uv_ao[0], c_uv_ao[1], c_uv_ao[2], c_uv_ao[3]);
    v_light_at = between(c_light_at[0], c_light_at[1], c_light_at[2], c_light_at[3]);
    v_tint = between(c_tint[0], c_tint[1], c_tint[2], c_tint[3]);
    v_surface = c_surface[0];
    v_position = between(c_position[0], c_position[1], c_position[2], c_position[3]);
    v_world = between(c_world[0], c_world[1], c_world[2], c_world[3]);
    v_bob = mix(mix(c_bob[0], c_bob[1], gl_TessCoord.x), mix(c_bob[3], c_bob[2], gl_TessCoord.x), gl_TessCoord.y);
    ViewData view = views[v_surface.y >> 16 & 7u];
    if (v_bob > 0.99) {
        // Where two quads meet both must find the same wave, bit for bit: cuts lie at whole blocks.
        vec2 corner = floor(v_world.xz + 0.5);
        if (dot(v_position.xz, v_position.xz) < 64.0 * 64.0) { // beyond, nothing moves, and the world is told modulo 256
            vec2 from_eye = corner - vec2(view.eye_block.xz & 255);
            v_position.xz = from_eye - 256.0 * floor(from_eye * (1.0 / 256.0) + 0.5) - view.fraction.xz;
        }
        float far = length(v_position.xz), away = length(v_position);
        float share = (1.0 - smoothstep(0.6 * kSwellEnd, kSwellEnd, far)) * smoothstep(0.3, 1.5, away);
        float rise = share > 0.0 ? share * wave_swell(corner, misc.x) : 0.0;
        v_position.y += rise;
        v_world.y += rise;
    }
    gl_Position = view.view_proj * vec4(v_position, 1.0);
    gl_ClipDistance[0] = dot(view.clip_plane, vec4(v_position, 1.0));
}
