// How much of the sun's (or moon's) light reaches a place, by color. Needs frame.glsl.
// place: camera-relative; face: normal of the geometry; facing: cosine to the light; sky: light level of the sky, 0..1.
vec3 sun_visibility(vec3 place, vec3 face, float facing, float sky, uint view) {
    // Without shadow maps direct light fades where the sky is not quite open, under trees and eaves.
    float open_sky = clamp(sky * 5.0 - 3.9, 0.0, 1.0);
    return vec3(open_sky * open_sky);
}
