// The middle of the pixel at work, in pixels from the lower left, in fragment and in compute shaders (COMPUTE) alike.
#ifdef COMPUTE
vec2 pixel_middle() { return vec2(gl_GlobalInvocationID.xy) + 0.5; }
#else
vec2 pixel_middle() { return gl_FragCoord.xy; }
#endif
