// Which quad a pixel shows, and nothing else of it: surfaces.comp.glsl looks the rest up. CUTOUT: holes.
layout(location = 0) flat in uint v_shown;
layout(location = 0) out uint o_shown;
#ifdef CUTOUT
layout(location = 1) in vec3 v_look; // texture coordinates, layer
layout(binding = 0) uniform sampler2DArray t_albedo;
#endif

void main() {
#ifdef CUTOUT
    if (texture(t_albedo, v_look).a < 0.5) discard;
#endif
    o_shown = v_shown;
}
