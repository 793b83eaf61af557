// What every pass knows of the frame; FrameUniforms in render/frame_uniforms.h writes it.
struct ViewData {
    mat4 view_proj;   // camera-relative world to clip space, reversed depth; jitter included
    mat4 previous;    // camera-relative place of this frame to clip space of the frame before, without jitter
    vec4 fraction;    // xyz: the eye inside its block; w: near plane, blocks
    vec4 clip_plane;  // camera-relative
    vec4 ray_right;   // xyz: with ray_up and ray_forward the ray of a point of the screen, forward part 1;
    vec4 ray_up;      // w of ray_right: blocks a pixel at distance 1; of ray_up: 1 where the eye is in a liquid, 2 in one that glows
    vec4 ray_forward; // w: scale of the view
    ivec4 eye_block;  // xyz: add a camera-relative place and fraction for a place in the world (modulo a power of two)
    vec4 medium;      // extinction of the liquid around the eye, a block (base e); w: blocks from the eye up to its surface
    vec4 murk;        // radiance that an endless way through it sends to the eye; w: how open to the sky
};
layout(std140, binding = 0) uniform Frame {
    ViewData views[8];
    vec4 sun_direction;   // w: amount of stars
    vec4 moon_direction;
    vec4 light_direction; // of the direct light: sun or moon
    vec4 sun_light;
    vec4 ambient;         // w: how open to the sky the eye stands
    vec4 sky_azimuth;     // xy: unit (x, z), where the sun stands; see common/sky.glsl
    vec4 screen;          // width, height, 1 / width, 1 / height
    vec4 misc;            // seconds, 1 / view distance, exposure, star and cloud turn (radians)
    vec4 background;      // w: 1 where it replaces the sky (tests)
    vec4 jitter;          // xy: of this frame, ndc
    vec4 sky_sh[9];       // irradiance of the sky, see common/ambient.glsl
};
