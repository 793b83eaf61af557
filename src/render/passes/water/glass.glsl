// Panes: glass, ice, slime, crystals. Each face takes its share of the light behind it by color and adds its own.
struct Pane {
    vec3 through; // of the light behind
    float own;    // of a painted surface
};
// color: linear; opacity: of the texture. 0 lets all through, 1 nothing; between, light takes the pane's hue.
Pane pane_of(vec3 color, float opacity) {
    vec3 hue = color / max(max(max(color.r, color.g), color.b), 1e-3);
    float tinted = min(1.6 * opacity, 1.0), solid = opacity * opacity;
    return Pane(mix(vec3(1.0), hue, tinted) * (1.0 - solid), solid);
}
