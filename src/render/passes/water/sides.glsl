// What v_surface (terrain.vert.glsl) says of a surface that lets light through. Needs common/normal.glsl.
bool is_liquid(uvec2 surface) { return (surface.y >> 24 & 1u) != 0u; }
vec3 surface_normal(uvec2 surface) { return normal_from_bytes(uvec2(surface.y & 255u, surface.y >> 8 & 255u)); }
// Whether the ray from the eye leaves the liquid here. Sloping surfaces (models, which look at the eye from both sides)
// look down only when seen from below.
bool leaves_liquid(uvec2 surface, vec3 position) {
    vec3 n = surface_normal(surface);
    bool model = (surface.y >> 19 & 7u) >= 6u;
    return model ? n.y < -0.5 : dot(n, position) > 0.0;
}
