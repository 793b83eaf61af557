// Pulls 8-byte quads (render/meshing/quad.h) by gl_VertexID. MODEL: 0 cube quads, 1 model quads, 2 either.
// SMOOTH: blended tints. SWAY: wind. NORMAL_MAPS, LIQUID: the fragment needs the place. LIQUID: and where it is in the
// world, modulo 256.
// SHADOW: into a shadow map (shadow/shadow_pass.cpp), sections relative to the map's anchor block; CUTOUT and COLORED
// say what its fragments need.
#include "common/frame.glsl"
#include "common/normal.glsl"

layout(location = 0) in ivec4 in_section; // blocks from the eye's block; w: light slot | tint slot << 16
layout(std430, binding = 0) readonly buffer Quads { uvec2 quads[]; };
layout(std430, binding = 1) readonly buffer Tints { uint tints[]; };
layout(std430, binding = 2) readonly buffer FixedTints { uint fixed_tints[]; };
layout(std430, binding = 3) readonly buffer Models { uint models[]; };
#ifdef SHADOW
layout(location = 2) uniform vec4 u_map[4]; // rows_from_anchor in shadow/shadow_cascades.h
layout(location = 7) uniform vec4 u_toward; // to the light; w: blocks that a cube quad grows by on each side
#if defined(CUTOUT) || defined(COLORED)
layout(location = 0) out vec3 v_look; // texture coordinates, layer
#endif
#ifdef COLORED
layout(location = 1) flat out vec4 v_tint; // w: 1 for liquids
#endif
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

const uint kFlagLiquid = 1u;
const float kLiquidDrop = 28.0 / 256.0; // render/meshing/quad.h
const float kSeal = 0.06; // pixels that a cube quad grows by on each side

vec3 unpack_color(uint c) { return vec3(c & 255u, c >> 8 & 255u, c >> 16 & 255u) * (1.0 / 255.0); }

vec3 tint_of(uint kind, uint fixed_index, uint slot, vec2 xz) {
    if (kind == 0u) return vec3(1.0);
    if (kind == 4u) return unpack_color(fixed_tints[fixed_index]);
    uint base = slot * 108u + (kind - 1u) * 36u;
#ifdef SMOOTH
    vec2 p = clamp(xz * 0.25 + 0.5, 0.0, 4.999);
    uvec2 i = uvec2(p);
    vec2 f = p - vec2(i);
    uint at = base + i.x + i.y * 6u;
    return mix(mix(unpack_color(tints[at]), unpack_color(tints[at + 1u]), f.x),
               mix(unpack_color(tints[at + 6u]), unpack_color(tints[at + 7u]), f.x), f.y);
#else
    // At a quarter of the loads: the texel around the point, which the mesh's 16 blocks show as soft steps.
    uvec2 i = uvec2(clamp(xz * 0.25 + 1.0, 0.0, 5.0));
    return unpack_color(tints[base + i.x + i.y * 6u]);
#endif
}

void main() {
    uvec2 q = quads[gl_VertexID >> 2];
    uint corner = uint(gl_VertexID) & 3u;
    vec3 local = vec3(q.x & 15u, q.x >> 4 & 15u, q.x >> 8 & 15u);
    vec3 cell = local;
    vec2 uv;
    float ao = 1.0;
    vec3 normal;
    vec3 lit_at;
    vec3 grow = vec3(0.0);
    bool gone = false;
    float bob = 0.0;
    uint what = 6u; // kFaceModel
#if MODEL == 2
    bool is_model = (q.x >> 23 & 1u) != 0u;
    if (!is_model)
#endif
#if MODEL != 1
    {
        uint face = q.x >> 20 & 7u;
        what = face;
        uint axis = face >> 1;
        bool positive = (face & 1u) != 0u;
        uint a = q.x >> 24;
        uint a0 = a & 3u, a1 = a >> 2 & 3u, a2 = a >> 4 & 3u, a3 = a >> 6;
        uint c = a0 + a2 > a1 + a3 ? corner : corner + 1u & 3u;
        // Where u x v points into the block the corners are taken the other way round.
        if (face == 1u || face == 3u || face == 4u) c = 4u - c & 3u;
        float along_u = c == 1u || c == 2u ? 1.0 : 0.0;
        float along_v = c >= 2u ? 1.0 : 0.0;
        float w = along_u * float((q.x >> 12 & 15u) + 1u), h = along_v * float((q.x >> 16 & 15u) + 1u);
        float out_by = positive ? 1.0 : 0.0;
        vec3 add = axis == 0u ? vec3(out_by, h, w) : axis == 1u ? vec3(w, out_by, h) : vec3(w, h, out_by);
        local += add;
        if ((q.y >> 28 & 1u) != 0u && face == 3u) local.y -= kLiquidDrop, bob = 1.0; // a level liquid ends below its cell's top
        float su = along_u * 2.0 - 1.0, sv = along_v * 2.0 - 1.0;
        grow = axis == 0u ? vec3(0.0, sv, su) : axis == 1u ? vec3(su, 0.0, sv) : vec3(su, sv, 0.0);
        float side = positive ? 1.0 : -1.0;
        normal = axis == 0u ? vec3(side, 0.0, 0.0) : axis == 1u ? vec3(0.0, side, 0.0) : vec3(0.0, 0.0, side);
        // Texture: right and down as seen from outside.
        float s = axis == 0u ? -side * local.z : axis == 1u ? local.x : side * local.x;
        float t = axis == 1u ? side * local.z : -local.y;
        uint turn = q.y >> 30;
        uv = turn == 0u ? vec2(s, t) : turn == 1u ? vec2(t, -s) : turn == 2u ? vec2(-s, -t) : vec2(-t, s);
        ao = 0.43 + 0.19 * float(a >> (c * 2u) & 3u);
        lit_at = local + normal * 0.5;
    }
#endif
#if MODEL == 2
    else
#endif
#if MODEL != 0
    {
        uint at = ((q.x >> 12 & 2047u) | (q.x >> 24) << 11) * 12u;
        uint xy = models[at + corner * 2u], zs = models[at + corner * 2u + 1u];
        uint tt = models[at + 8u + (corner >> 1)];
        ivec3 p = ivec3(bitfieldExtract(int(xy), 0, 16), bitfieldExtract(int(xy), 16, 16), bitfieldExtract(int(zs), 0, 16));
        vec3 inside = vec3(p) * (1.0 / 256.0);
        local += inside;
        bob = (q.y >> 28 & 1u) != 0u && p.y > 4 && p.y < 252 ? 1.0 : 0.0;
        int s = bitfieldExtract(int(zs), 16, 16), t = bitfieldExtract(int(tt), int(corner & 1u) * 16, 16);
        uv = vec2(s, t) * (1.0 / 256.0);
        int nw = int(models[at + 10u]);
        normal = vec3(bitfieldExtract(nw, 0, 8), bitfieldExtract(nw, 8, 8), bitfieldExtract(nw, 16, 8)) * (1.0 / 127.0);
        uint flags = uint(nw) >> 24;
#ifndef SHADOW
        vec3 from_eye = vec3(in_section.xyz) + local - views[u_view].fraction.xyz;
        bool away = dot(normal, from_eye) > 0.0;
        gone = away && (flags & 1u) == 0u;
        if (away) normal = -normal;
#endif
        // Slabs, stairs and fences have faces along the axes too: those know them exactly, whatever relief does later.
        vec3 straight = step(vec3(0.999), abs(normal));
        if (straight.x + straight.y + straight.z == 1.0 && dot(abs(normal), vec3(1.0)) < 1.004)
            what = uint(dot(straight, vec3(0.0, 2.0, 4.0))) + (dot(normal, straight) > 0.0 ? 1u : 0u);
        if ((flags & 2u) != 0u) {
            normal = vec3(0.0, 1.0, 0.0);
            what = 7u; // kFacePlant
        }
        lit_at = clamp(local + normal * 0.25, -0.5, 16.5);
#ifdef SWAY
        if ((q.y >> 27 & 1u) != 0u) {
            float phase = misc.x * 1.7 + (local.x * 3.0 + local.z * 5.0) * 0.392699082; // whole waves a section
            local.xz += inside.y * 0.05 * vec2(sin(phase), sin(phase * 0.5 + local.x * 1.570796327));
        }
#endif
    }
#endif
#ifdef SHADOW
    // Rounded to the rasterizer's own steps before the center is taken away, which is exact: a map around another center
    // is the same picture moved by whole texels.
    vec3 place = vec3(in_section.xyz) + local + grow * u_toward.w;
    vec2 at_map = vec2(dot(u_map[0].xyz, place), dot(u_map[1].xyz, place));
    at_map = floor(at_map * 256.0 + 0.5) * (1.0 / 256.0) - u_map[3].xy;
    gl_Position = vec4(at_map * u_map[3].z, dot(u_map[2], vec4(place, 1.0)), 1.0);
#if defined(CUTOUT) || defined(COLORED)
    v_look = vec3(uv, float(q.y & 0xffffu));
#endif
#ifdef COLORED
    v_tint = vec4(tint_of(q.y >> 16 & 7u, q.y >> 19 & 255u, uint(in_section.w) >> 16, local.xz), float(q.y >> 28 & 1u));
    // Light that enters a block of glass leaves it too: one face of the two counts.
    if (dot(normal, u_toward.xyz) <= 0.0) gl_Position = vec4(2.0, 2.0, 0.0, 1.0);
#endif
#else
    ViewData view = views[u_view];
    vec3 position = vec3(in_section.xyz) + local - view.fraction.xyz;
    // Cracks at T-junctions are rounding, far less than a pixel: each cube quad grows by a hair.
    vec3 reach = abs(position);
    position += grow * (max(max(reach.x, reach.y), reach.z) * view.ray_right.w * kSeal);
    gl_Position = view.view_proj * vec4(position, 1.0);
    gl_ClipDistance[0] = dot(view.clip_plane, vec4(position, 1.0));
    if (gone) gl_Position = vec4(0.0, 0.0, -1.0, 0.0);
    v_uv_ao = vec3(uv, ao);
    uint slot = uint(in_section.w) & 0xffffu;
    uint row = uint(u_light_atlas.w);
    uvec3 brick = uvec3(slot % row, slot / row % row, slot / (row * row));
    v_light_at = (vec3(brick) * 18.0 + lit_at.xzy + 1.0) * u_light_atlas.xyz;
    v_tint = tint_of(q.y >> 16 & 7u, q.y >> 19 & 255u, uint(in_section.w) >> 16, local.xz);
    uvec2 n = normal_bytes(normal);
    v_surface = uvec2(q.y & 0xffffu, n.x | n.y << 8 | u_view << 16 | what << 19 | ((q.y >> 28 & 1u) != 0u ? kFlagLiquid << 24 : 0u));
#if defined(NORMAL_MAPS) || defined(LIQUID)
    v_position = position;
#endif
#ifdef LIQUID
    v_world = vec3((view.eye_block.xyz + in_section.xyz) & 255) + local;
    v_bob = bob;
#endif
#endif
}
