// Pulls 8-byte quads by gl_VertexID; terrain/corner.glsl says what MODEL, SMOOTH and SWAY mean. NORMAL_MAPS, LIQUID: the
// fragment needs the place. LIQUID: and where it is in the world, modulo 256. SHOWN: the fragment needs the quad's number
// alone (terrain/shown.frag.glsl).
// SHADOW: into a shadow map (shadow/shadow_pass.cpp), sections relative to the map's anchor block; CUTOUT and COLORED
// say what its fragments need.
#include "common/frame.glsl"
#include "common/normal.glsl"
#include "terrain/corner.glsl"

layout(location = 0) in ivec4 in_section; // blocks from the eye's block; w: light slot | tint slot << 16
#ifdef SHADOW
layout(location = 2) uniform vec4 u_map[4]; // rows_from_anchor in shadow/shadow_cascades.h
layout(location = 7) uniform vec4 u_toward; // to the light; w: blocks that a cube quad grows by on each side
#if defined(CUTOUT) || defined(COLORED)
layout(location = 0) out vec3 v_look; // texture coordinates, layer
#endif
#ifdef COLORED
layout(location = 1) flat out vec4 v_tint; // w: 1 for liquids
#endif
#elif defined(SHOWN)
layout(location = 0) uniform uint u_view;
layout(location = 1) in uint in_shown; // adds to a quad's place in the buffer: its number in this frame
layout(location = 0) flat out uint v_shown; // the number, then 1 for cutout
#ifdef CUTOUT
layout(location = 1) out vec3 v_look; // texture coordinates, layer
#endif
out float gl_ClipDistance[1];
#else
layout(location = 0) uniform uint u_view;
layout(location = 1) uniform vec4 u_light_atlas; // xyz: 1 / texels; w: bricks a row

layout(location = 0) out vec3 v_uv_ao;
layout(location = 1) out vec3 v_light_at;
layout(location = 2) out vec3 v_tint;
layout(location = 3) flat out uvec2 v_surface; // layer; normal bytes, view << 16, face << 19, liquid << 24
#if defined(NORMAL_MAPS) || defined(LIQUID)
layout(location = 4) out vec3 v_position;
#endif
#ifdef LIQUID
layout(location = 5) out vec3 v_world;
layout(location = 6) out float v_bob; // 1: a corner of a liquid's surface, which waves move (water.tese.glsl)
#endif
out float gl_ClipDistance[1];
#endif

void main() {
    uvec2 q = quads[gl_VertexID >> 2];
#ifdef SHADOW
    Corner c = corner_of(q, uint(gl_VertexID) & 3u, in_section.xyz, vec3(0.0));
#else
    Corner c = corner_of(q, uint(gl_VertexID) & 3u, in_section.xyz, views[u_view].fraction.xyz);
#endif
#ifdef SHADOW
    // Rounded to the rasterizer's own steps before the center is taken away, which is exact: a map around another center
    // is the same picture moved by whole texels.
    vec3 place = vec3(in_section.xyz) + c.local + c.grow * u_toward.w;
    vec2 at_map = vec2(dot(u_map[0].xyz, place), dot(u_map[1].xyz, place));
    at_map = floor(at_map * 256.0 + 0.5) * (1.0 / 256.0) - u_map[3].xy;
    gl_Position = vec4(at_map * u_map[3].z, dot(u_map[2], vec4(place, 1.0)), 1.0);
#if defined(CUTOUT) || defined(COLORED)
    v_look = vec3(c.uv, float(q.y & 0xffffu));
#endif
#ifdef COLORED
    v_tint = vec4(quad_tint(q, uint(in_section.w) >> 16, c.local.xz), float(q.y >> 28 & 1u));
    // Light that enters a block of glass leaves it too: one face of the two counts.
    if (dot(c.normal, u_toward.xyz) <= 0.0) gl_Position = vec4(2.0, 2.0, 0.0, 1.0);
#endif
#else
    ViewData view = views[u_view];
    vec3 position = place_of(c, in_section.xyz, view);
    gl_Position = view.view_proj * vec4(position, 1.0);
    gl_ClipDistance[0] = dot(view.clip_plane, vec4(position, 1.0));
    if (c.gone) gl_Position = vec4(0.0, 0.0, -1.0, 0.0);
#ifdef SHOWN
    v_shown = (uint(gl_VertexID) >> 2) + in_shown << 1;
#ifdef CUTOUT
    v_shown |= 1u;
    v_look = vec3(c.uv, float(q.y & 0xffffu));
#endif
#else
    v_uv_ao = vec3(c.uv, c.ao);
    v_light_at = light_place(c, uint(in_section.w) & 0xffffu, u_light_atlas);
    v_tint = quad_tint(q, uint(in_section.w) >> 16, c.local.xz);
    v_surface = surface_word(c, q, u_view);
#if defined(NORMAL_MAPS) || defined(LIQUID)
    v_position = position;
#endif
#ifdef LIQUID
    v_world = vec3((view.eye_block.xyz + in_section.xyz) & 255) + c.local;
    v_bob = c.bob;
#endif
#endif
#endif
}
