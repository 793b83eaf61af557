// Mist that lies low, and thin haze everywhere: how much of the light behind comes through, and what it scatters towards the
// eye. The same for all surfaces and for the sky behind them. Exact for air whose density falls exponentially above a
// height and is even below it; scene/mist.h is the same in C++ (a test compares both with numeric integration).
// Needs frame.glsl.
layout(std140, binding = 2) uniform Mist {
    vec4 mist_air;    // a block: haze, mist below its base; then 1 / height of the mist; share of the sun that is added here
    vec4 mist_eye[8]; // by view: its height above the base, the column below that, 1 where there is mist
};

// The mist's density at the base times this is what lies between the base and `above` (negative below it), in blocks.
float mist_column(float above) {
    float high = max(above, 0.0) * mist_air.z;
    return min(above, 0.0) + (1.0 - exp2(-1.442695 * high)) / max(mist_air.z, 1e-6);
}

// Optical depth of the first `away` blocks along a unit direction that rises by `rise` a block.
float mist_depth(float away, float rise, uint number) {
    vec4 eye = mist_eye[number];
    float climb = rise * away;
    // A level ray: the density at its middle.
    float even = exp2(-1.442695 * max(eye.x + 0.5 * climb, 0.0) * mist_air.z);
    float mean = abs(climb) < 0.05 ? even : (mist_column(eye.x + climb) - eye.y) / climb;
    return (mist_air.x + mist_air.y * mean) * away * eye.z;
}

// Henyey and Greenstein 1941, times 4 pi: 1 where light scatters evenly. Droplets send most of it on.
float mist_phase(vec3 towards) {
    const float g = 0.6;
    float c = dot(towards, light_direction.xyz);
    float base = 1.0 + g * g - 2.0 * g * c;
    return (1.0 - g * g) * inversesqrt(base * base * base);
}
// What full sunlight sends to the eye from air that takes all light; sun_light is irradiance over pi.
vec3 mist_sun(vec3 towards) { return sun_light.rgb * (0.25 * mist_phase(towards)); }

// color: of what lies `away` blocks off. open: how open to the sky eye or surface stand; there is no mist in caves.
vec3 mist_over(vec3 color, float away, vec3 towards, uint number, float open) {
    float through = exp2(-1.442695 * open * mist_depth(away, towards.y, number));
    vec3 light = ambient.rgb * 0.8 + mist_sun(towards) * mist_air.w;
    return mix(light, color, through);
}
