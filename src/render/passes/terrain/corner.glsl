// The corners of quads, unpacked from 8 bytes (render/meshing/quad.h): for shaders that draw quads and for the one that
// looks up what was drawn. MODEL: 0 cube quads, 1 model quads, 2 either. SMOOTH: blended tints. SWAY: wind. SHADOW: models
// are not asked which way they look. Needs common/frame.glsl.
layout(std430, binding = 0) readonly buffer Quads { uvec2 quads[]; };
layout(std430, binding = 1) readonly buffer Tints { uint tints[]; };
layout(std430, binding = 2) readonly buffer FixedTints { uint fixed_tints[]; };
layout(std430, binding = 3) readonly buffer Models { uint models[]; };

const float kLiquidDrop = 28.0 / 256.0; // render/meshing/quad.h
#ifdef LIQUID
const float kSeal = 0.0; // blended: what lay under two quads would be drawn twice, in dotted lines
#else
const float kSeal = 0.06; // pixels that a cube quad grows by on each side
#endif

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

struct Corner {
    vec3 local;  // blocks from the section's least corner
    vec3 grow;   // of a cube quad: outwards in its plane
    vec3 normal;
    vec3 lit_at; // where light is looked up, as local
    vec2 uv;
    float ao;
    float bob;   // 1: of a liquid's surface, which waves move (water.tese.glsl)
    uint what;   // the face, as common/surface.glsl has it
    bool gone;   // looks away
};

// section: blocks from the eye's block; fraction: of the eye in it.
Corner corner_of(uvec2 q, uint corner, ivec3 section, vec3 fraction) {
    vec3 local = vec3(q.x & 15u, q.x >> 4 & 15u, q.x >> 8 & 15u);
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
        vec3 from_eye = vec3(section) + local - fraction;
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
    return Corner(local, grow, normal, lit_at, uv, ao, bob, what, gone);
}

#ifndef SHADOW
// Camera-relative. Cracks at T-junctions are rounding, far less than a pixel: each cube quad grows by a hair.
vec3 place_of(Corner c, ivec3 section, ViewData view) {
    vec3 place = vec3(section) + c.local - view.fraction.xyz;
    vec3 reach = abs(place);
    return place + c.grow * (max(max(reach.x, reach.y), reach.z) * view.ray_right.w * kSeal);
}

// In the atlas of light. atlas: 1 / texels; w: bricks a row.
vec3 light_place(Corner c, uint slot, vec4 atlas) {
    uint row = uint(atlas.w);
    uvec3 brick = uvec3(slot % row, slot / row % row, slot / (row * row));
    return (vec3(brick) * 18.0 + c.lit_at.xzy + 1.0) * atlas.xyz;
}

// Layer; normal bytes, view << 16, face << 19, liquid << 24.
uvec2 surface_word(Corner c, uvec2 q, uint view) {
    uvec2 n = normal_bytes(c.normal);
    return uvec2(q.y & 0xffffu, n.x | n.y << 8 | view << 16 | c.what << 19 | (q.y >> 28 & 1u) << 24);
}
#endif

vec3 quad_tint(uvec2 q, uint slot, vec2 xz) { return tint_of(q.y >> 16 & 7u, q.y >> 19 & 255u, slot, xz); }
