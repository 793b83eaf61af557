// Waves of water in world space; scene/water.h is the same in C++ and says what the numbers mean (a test compares them).
// WAVE_HEIGHT: blocks. WAVES_SIMPLE: five waves tell the slope, for software OpenGL.
const float kWaveTurn = 6.2831853, kWavePer = 1.0 / 256.0;
const int kSwells = 4, kWaveCount = 12;
const vec4 kWaves[kWaveCount] = vec4[](
    vec4(15.0, 5.0, 44.0, 0.40), vec4(14.0, 21.0, 55.0, 0.30), vec4(38.0, 2.0, 68.0, 0.18),
    vec4(39.0, 40.0, 82.0, 0.12), vec4(19.0, 73.0, 95.0, 0.0150), vec4(95.0, 32.0, 110.0, 0.0122),
    vec4(-52.0, 122.0, 127.0, 0.0094), vec4(171.0, -31.0, 145.0, 0.0072), vec4(137.0, 180.0, 165.0, 0.0056),
    vec4(190.0, -229.0, 190.0, 0.0042), vec4(-119.0, 367.0, 216.0, 0.0030), vec4(421.0, 287.0, 249.0, 0.0020));

// Where a place is in a wave, radians. place: xz of the world modulo 256 (or near it).
float wave_phase(vec4 wave, vec2 place, float seconds) {
    float turns = (dot(wave.xy, place) - wave.z * mod(seconds, 256.0)) * kWavePer;
    return fract(turns) * kWaveTurn;
}

// Blocks that the surface lies above its level; the geometry follows this.
float wave_swell(vec2 place, float seconds) {
    float sum = 0.0;
    for (int i = 0; i < kSwells; ++i)
        sum += kWaves[i].w * sin(wave_phase(kWaves[i], place, seconds));
    return sum * WAVE_HEIGHT;
}

struct WaveSlope {
    vec2 slope;     // of swell and ripples, along x and z
    float variance; // of the slope that waves have which are too short to be seen from here
};
// footprint: blocks that a pixel covers. Waves shorter than two pixels would only glitter: they roughen instead.
WaveSlope wave_slope(vec2 place, float seconds, float footprint) {
    WaveSlope result = WaveSlope(vec2(0.0), 0.0);
#ifdef WAVES_SIMPLE
    for (int i = 1; i < kWaveCount; i += 2) {
        float more = 1.4;
#else
    for (int i = 0; i < kWaveCount; ++i) {
        float more = 1.0;
#endif
        vec4 wave = kWaves[i];
        float number = length(wave.xy) * kWavePer; // waves a block
        float steep = wave.w * number * kWaveTurn * (i < kSwells ? WAVE_HEIGHT : WAVE_HEIGHT / 0.06) * more;
        float seen = 1.0 - smoothstep(0.15, 0.50, number * footprint);
        result.slope += wave.xy * (kWavePer / number * steep * seen * cos(wave_phase(wave, place, seconds)));
        result.variance += 0.5 * steep * steep * (1.0 - seen * seen);
    }
    return result;
}
