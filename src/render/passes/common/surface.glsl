// What lighting knows of a surface.
struct Surface {
    vec3 albedo;     // linear
    vec3 normal;     // shading normal, unit
    vec3 face;       // of the geometry, unit: shadows are offset along it
    vec4 light;      // levels of block r g b and sky, each 0..1
    float ao;        // of the mesh
#ifdef SSAO
    float screen_ao; // of the screen
#endif
    float roughness; // 0..1
    float emission;  // 0..1
    bool plant;      // lit from all sides alike
};

// The byte of the G-buffer that holds the view's number (bits 0..2) and what the face is (bits 3..5: 0..5 a Face of the
// axes, 6 another direction, 7 a plant).
const uint kFaceModel = 6u, kFacePlant = 7u;
vec3 axis_of_face(uint face) {
    float side = (face & 1u) != 0u ? 1.0 : -1.0;
    uint axis = face >> 1;
    return axis == 0u ? vec3(side, 0.0, 0.0) : axis == 1u ? vec3(0.0, side, 0.0) : vec3(0.0, 0.0, side);
}
