// The G-buffer from what each pixel shows (shown.frag.glsl): the pixel's quad is unpacked once more, its ray meets the quad's
// triangle, and what the triangle's corners know is weighed as the rasterizer would have done. For GPUs whose compute
// units far outnumber those that shade fragments: there the rasterizer is left as little as can be.
// (A visibility buffer: C. A. Burns and W. A. Hunt, JCGT 2(2), 2013.) NORMAL_MAPS: relief. See also terrain/corner.glsl.
#include "common/frame.glsl"
#include "common/normal.glsl"
#include "common/surface.glsl"
#include "terrain/corner.glsl"
#include "terrain/look.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0) uniform sampler2DArray t_albedo;
layout(binding = 1) uniform sampler3D t_light;
layout(binding = 2) uniform sampler2DArray t_material;
layout(binding = 3) uniform sampler2D t_depth;
layout(binding = 4) uniform usampler2D t_shown;
struct ShownSection { // terrain_pass.cpp
    ivec4 section; // blocks from the eye's block; w: light slot | tint slot << 16
    uint base;     // what the number of a quad has over its place in the buffer
    uint view;
};
layout(std430, binding = 4) readonly buffer Shown { ShownSection shown_sections[]; };
layout(location = 0) uniform uint u_shift;      // of a quad's number: the section's, above it
layout(location = 1) uniform vec4 u_light_atlas; // xyz: 1 / texels; w: bricks a row
layout(binding = 0, rgba8) writeonly uniform image2D i_albedo;
layout(binding = 1, rgba8) writeonly uniform image2D i_light;
layout(binding = 2, rgba8ui) writeonly uniform uimage2D i_surface;

// Forward part 1. Depends on the pixel alone, so that neighbors compute the same.
vec3 ray_of(ViewData view, ivec2 pixel) {
    vec2 ndc = (vec2(pixel) + 0.5) * screen.zw * 2.0 - 1.0;
    return view.ray_forward.xyz + view.ray_right.xyz * ndc.x + view.ray_up.xyz * ndc.y;
}

// A triangle: where rays from the eye meet its plane, from its first corner.
struct Plane {
    vec3 corner, normal, to_second, to_third; // the last two: dual to the edges
};
vec3 meet(Plane p, vec3 ray) {
    float towards = dot(ray, p.normal);
    return ray * (dot(p.corner, p.normal) / (abs(towards) < 1e-20 ? 1e-20 : towards)) - p.corner;
}
vec2 shares(Plane p, vec3 at) { return vec2(dot(at, p.to_second), dot(at, p.to_third)); }

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, ivec2(screen.xy))) || texelFetch(t_depth, pixel, 0).r <= 0.0) return;
    uint shown = texelFetch(t_shown, pixel, 0).r;
    bool cutout = (shown & 1u) != 0u;
    shown >>= 1;
    ShownSection of = shown_sections[shown >> u_shift];
    uvec2 q = quads[shown - of.base & 0x7fffffffu];
    ViewData view = views[of.view];
    vec3 ray = ray_of(view, pixel);

    // Two triangles, 0 1 2 and 2 3 0: on which side of the common edge.
    ivec3 section = of.section.xyz;
    vec3 fraction = view.fraction.xyz;
    Corner a = corner_of(q, 0u, section, fraction), b = corner_of(q, 1u, section, fraction);
    Corner c = corner_of(q, 2u, section, fraction);
    vec3 at_a = place_of(a, section, view), at_b = place_of(b, section, view), at_c = place_of(c, section, view);
    vec3 edge = cross(at_a, at_c);
    uvec2 surface = surface_word(c, q, of.view);
    if (dot(edge, ray) * dot(edge, at_b) < 0.0) {
        b = corner_of(q, 3u, section, fraction);
        at_b = place_of(b, section, view);
        surface = surface_word(a, q, of.view); // the triangle's last corner speaks for it
    }

    vec3 ab = at_b - at_a, ac = at_c - at_a, n = cross(ab, ac);
    float scale = 1.0 / max(dot(n, n), 1e-30);
    Plane plane = Plane(at_a, n, cross(ac, n) * scale, cross(n, ab) * scale);
    vec3 place = meet(plane, ray);
    vec2 share = shares(plane, place);
    // Differences within squares of 2 x 2 pixels, as fragments have them.
    ivec2 odd = (pixel & 1) * -2 + 1;
    vec3 px = (meet(plane, ray_of(view, pixel + ivec2(odd.x, 0))) - place) * float(odd.x);
    vec3 py = (meet(plane, ray_of(view, pixel + ivec2(0, odd.y))) - place) * float(odd.y);
    mat2 uv_edges = mat2(b.uv - a.uv, c.uv - a.uv);
    vec2 uv = a.uv + uv_edges * share, ux = uv_edges * shares(plane, px), uy = uv_edges * shares(plane, py);

    vec3 at = vec3(uv, float(surface.x));
    vec4 albedo = textureGrad(t_albedo, at, ux, uy), material = textureGrad(t_material, at, ux, uy);
    uint slot = uint(of.section.w) & 0xffffu, tints_slot = uint(of.section.w) >> 16;
    vec3 tint = quad_tint(q, tints_slot, a.local.xz);
    tint += (quad_tint(q, tints_slot, b.local.xz) - tint) * share.x + (quad_tint(q, tints_slot, c.local.xz) - tint) * share.y;
    Corner here = a;
    here.lit_at += (b.lit_at - a.lit_at) * share.x + (c.lit_at - a.lit_at) * share.y;
    float ao = a.ao + (b.ao - a.ao) * share.x + (c.ao - a.ao) * share.y;

    uvec2 normal = uvec2(surface.y & 255u, surface.y >> 8 & 255u);
#ifdef NORMAL_MAPS
    if (has_relief(surface)) normal = normal_bytes(relief(normal_from_bytes(normal), slope_of(material), px, py, ux, uy));
#endif
    imageStore(i_albedo, pixel, vec4(tinted(albedo, tint, cutout), ao));
    imageStore(i_light, pixel, textureLod(t_light, light_place(here, slot, u_light_atlas), 0.0).bgra);
    imageStore(i_surface, pixel, surface_bytes(surface, normal, material));
}
