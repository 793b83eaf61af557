// Light in water. Needs common/frame.glsl. DRY: no view's eye is in a liquid (software OpenGL computes both sides of every
// branch).
const float kPhase = 0.30;    // share of scattered light that turns to the eye (render::kWaterPhase)
const float kDownwards = 0.7; // share of the extinction that light from above suffers: the rest is scattered on downwards

// Eyes grow used to the deep: more than 13 blocks are never counted, so that one sees there.
float told_depth(float depth) { return 13.0 * (1.0 - exp(-depth / 13.0)); }

struct Optics {
    vec3 absorption, scattering; // a block, base e
};
// Water of this tint (sRGB) absorbs what the tint lacks: scene::water_optics is the same in C++.
Optics water_optics(vec3 tint) {
    vec3 c = clamp(tint, 0.0, 1.0);
    vec3 linear = c * (c * (c * 0.305306011 + 0.682171111) + 0.012522878);
    vec3 absorbed = -0.085 * log(max(linear, vec3(0.012)));
    absorbed.b = max(absorbed.b, 0.35 * absorbed.g); // however blue a tint, deep water is not violet
    return Optics(absorbed + vec3(0.030, 0.030, 0.025), vec3(0.030, 0.034, 0.038));
}

// What a way of `path` blocks, sinking `down` a block (-1..1), scatters towards its start, for light 1 there.
vec3 scattered_on_way(vec3 extinction, vec3 scattering, float path, float down) {
    float rate = 1.0 + kDownwards * down;
    return kPhase * scattering / (extinction * rate) * (1.0 - exp(-extinction * (rate * path)));
}

// The liquid around the eye, for what lies `away` blocks off; the way in it ends at its surface.
vec3 through_medium(vec3 color, vec3 towards, float away, uint number) {
#ifdef DRY
    return color;
#else
    ViewData view = views[number];
    if (view.ray_up.w == 0.0) return color;
    // What glows does so alike everywhere and lets nothing through its skin: no surface ends it, no depth darkens it.
    if (view.ray_up.w > 1.5) return mix(view.murk.rgb, color, exp(-view.medium.rgb * away));
    float path = towards.y > 0.0 ? min(away, view.medium.w / max(towards.y, 1e-4)) : away;
    float rate = 1.0 - kDownwards * towards.y;
    return color * exp(-view.medium.rgb * path) + view.murk.rgb * ((1.0 - exp(-view.medium.rgb * (rate * path))) / rate);
#endif
}

// Light levels know a gray law of one level a block of water; with the eye in the liquid its surface is known, and what
// lies below it gets the light of the open sky through that much water. Returns the share by color that is left, and
// takes the water's levels out of `sky`. depth: blocks below the surface, negative above it.
vec3 light_in_medium(vec3 place, uint number, inout float sky, out float depth) {
#ifdef DRY
    depth = -1.0;
    return vec3(1.0);
#else
    ViewData view = views[number];
    depth = view.medium.w - place.y;
    if (view.ray_up.w == 0.0 || depth <= 0.0) return vec3(1.0);
    float expected = max(15.0 - depth, 0.0) * (1.0 / 15.0);
    sky = view.murk.w * clamp(1.0 - (expected - sky) * 2.5, 0.0, 1.0);
    return exp(-view.medium.rgb * (kDownwards * told_depth(depth)));
#endif
}
