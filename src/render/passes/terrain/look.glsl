// What a quad's textures make of a pixel of the G-buffer. Needs common/normal.glsl and common/surface.glsl.

// The normal with the texture's relief. px, py: how far the place moves from a pixel to the next, right and up; ux, uy: how
// far the texture coordinates do. The texture's axes in the world follow, so that any model may turn its texture.
vec3 relief(vec3 n, vec2 slope, vec3 px, vec3 py, vec2 ux, vec2 uy) {
    vec3 a = cross(py, n), b = cross(n, px);
    vec3 tangent = a * ux.x + b * uy.x, bitangent = a * ux.y + b * uy.y;
    float size = max(max(dot(tangent, tangent), dot(bitangent, bitangent)), 1e-24);
    return normalize(n + (tangent * slope.x + bitangent * slope.y) * inversesqrt(size));
}

// material: normal x, normal y, roughness, emission.
vec2 slope_of(vec4 material) { return material.rg * 2.0 - 1.00392157; }
// What is tilted keeps its plain normal: shadows need that of the geometry, and it has no other place.
bool has_relief(uvec2 surface) { return (surface.y >> 19 & 7u) != kFaceModel; }

// "surface" of the G-buffer. surface: surface_word of terrain/corner.glsl; normal: bytes.
uvec4 surface_bytes(uvec2 surface, uvec2 normal, vec4 material) {
    return uvec4(normal, surface.y >> 16 & 255u, uint(material.b * 15.0 + 0.5) << 4 | uint(material.a * 15.0 + 0.5));
}

// alpha: in cutouts holes, else how much of the tint the texel takes (render/texture_set.h).
vec3 tinted(vec4 albedo, vec3 tint, bool cutout) { return albedo.rgb * (cutout ? tint : mix(vec3(1.0), tint, albedo.a)); }
