// The shadow maps, as ShadowPass fills them (shadow_pass.cpp), and the cheapest question to them. Needs frame.glsl.
// With SHADOWS off there are none: direct light ends where the sky's light does.
#ifdef SHADOWS
struct ShadowCascade {
    vec4 u, v, z; // dot products with (camera-relative place, 1): texture coordinates and depth, 0 nearest to the light
    vec4 size;    // blocks a texel; blocks of the depth's 0..1; blocks from the eye to its end; 1 where it holds any color
};
layout(std140, binding = 1) uniform Shadows {
    ShadowCascade shadow_cascades[4];
    vec4 shadow_info; // where all shadows end; 1 / blocks over which they fade; turn of the kernel; tangent of half the sun
};
layout(binding = 5) uniform sampler2DArrayShadow t_shadow;
#ifdef SHADOW_COLOR
// Light that translucent surfaces let through; a: the depth of the nearest of them, see shadow.frag.glsl.
layout(binding = 6) uniform sampler2DArray t_shadow_color;
#endif
layout(binding = 7) uniform sampler2DArray t_shadow_depth;

vec3 shadow_place(ShadowCascade c, vec3 place) {
    vec4 p = vec4(place, 1.0);
    return vec3(dot(c.u, p), dot(c.v, p), dot(c.z, p));
}

// The first cascade that reaches this far; SHADOW_CASCADES beyond the last.
int shadow_cascade(float away) {
    int i = 0;
    while (i < SHADOW_CASCADES && away > shadow_cascades[i].size.z) ++i;
    return i;
}
#endif

// Whether the sun reaches a place in the air: 0 or 1, in between near outlines; 1 beyond the shadows' end. One texture
// read. place: camera-relative, of view 0.
float sun_shaft(vec3 place) {
#ifdef SHADOWS
    int i = shadow_cascade(length(place));
    if (i == SHADOW_CASCADES) return 1.0;
    vec3 at = shadow_place(shadow_cascades[i], place);
    return texture(t_shadow, vec4(at.xy, float(i), at.z));
#else
    return 1.0;
#endif
}
