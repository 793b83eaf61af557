// Clouds in a layer that hangs in the world and drifts with the wind. CLOUDS 1: a sheet, lit by one look towards the
// light; CLOUDS 2: a slab with height, marched in a few steps, each shadowed by what stands between it and the light.
// The layer bends down with a globe far smaller than the Earth, so that it meets the horizon within a few thousand
// blocks. Needs frame.glsl, sky.glsl and ambient.glsl.
const float kCloudBase = 520.0, kCloudThick = 150.0, kGlobe = 9000.0; // blocks
const float kCoarse = 1.0 / 4096.0, kFine = 1.0 / 1024.0;             // texture a block; whole numbers over 4096 blocks
const vec2 kWind = vec2(3.1, 1.2);                                    // blocks a second

// Way along a ray of this slope to the shell that high above the eye.
float way_to_shell(float slope, float above) {
    float x = 2.0 * above / kGlobe;
    return (sqrt(slope * slope + x + 0.25 * x * x) - slope) * kGlobe;
}

// Where the eye stands, as the noise repeats (4096 blocks), with the wind.
vec2 cloud_origin() {
    ViewData v = views[0];
    return vec2(v.eye_block.xz & 4095) + v.fraction.xz + kWind * misc.x;
}

// 0..1: how much cloud stands over that place, before details.
float cloud_shape(sampler2D noise, vec2 at, float lod) {
    float wide = textureLod(noise, at * kCoarse, lod).r;
    return smoothstep(0.47, 0.74, wide + 0.10 * (textureLod(noise, at * kCoarse * 3.0 + 0.31, lod + 2.0).r - 0.5));
}

// Light scattered towards the eye: forward with a silver lining, a little back (two lobes of Henyey and Greenstein 1941).
float cloud_phase(float cosine) {
    float f = 1.0 + 0.7225 - 1.7 * cosine, b = 1.0 + 0.09 + 0.6 * cosine;
    return 0.30 * (1.0 - 0.7225) * inversesqrt(f * f * f) + 0.70 * (1.0 - 0.09) * inversesqrt(b * b * b);
}

// rgb: light of the clouds in a direction; a: share of what lies behind that is seen through them.
// edge: radians of a pixel; dither: 0..1, where in its stretch a step looks.
vec4 clouds_at(vec3 d, sampler2D noise, float edge, float dither) {
    if (d.y < 0.005) return vec4(0.0, 0.0, 0.0, 1.0);
    float above = max(kCloudBase - float(views[0].eye_block.y), 60.0);
    float near = way_to_shell(d.y, above);
    vec2 origin = cloud_origin();
    float lod = max(log2(near * edge / max(d.y, 0.08) * 256.0 * kCoarse), 0.0);
    float haze = exp(-near * near * (1.0 / (3600.0 * 3600.0))) * smoothstep(0.005, 0.06, d.y);
    vec3 towards_light = cloud_direction.xyz;
    float phase = cloud_phase(dot(d, towards_light));
    vec3 from_above = sky_irradiance(vec3(0.0, 1.0, 0.0)), from_below = sky_irradiance(vec3(0.0, -1.0, 0.0));
    vec3 light = vec3(0.0);
    float through = 1.0;
#if CLOUDS == 1
    vec2 at = origin + d.xz * near;
    float shape = cloud_shape(noise, at, lod);
    float fine = textureLod(noise, at * kFine + misc.x * 0.0004, lod + 2.0).g;
    float density = clamp(shape * 1.5 - (1.0 - fine) * 0.62, 0.0, 1.0);
    float shadow = cloud_shape(noise, at + towards_light.xz * 90.0, lod) * 0.5 + density * 0.5;
    light = cloud_light.rgb * (phase * 0.62 * exp(-shadow * 1.7) + 0.62 * exp(-shadow * 0.55)) +
            mix(from_below, from_above, 0.65 - 0.3 * density);
    through = 1.0 - clamp(density * 1.9, 0.0, 1.0) * 0.96;
    light *= 1.0 - through;
#else
    const int kSteps = 9;
    float far = way_to_shell(d.y, above + kCloudThick);
    // No ray is marched further than it takes to go through a cloud.
    far = min(far, near + 4.0 * kCloudThick);
    float stride = (far - near) / float(kSteps);
    for (int i = 0; i < kSteps; ++i) {
        float along = (float(i) + dither) / float(kSteps), t = near + (far - near) * along;
        float high = (above + kCloudThick) > above ? clamp((t * d.y + t * t * (0.5 / kGlobe) - above) / kCloudThick, 0.0, 1.0) : 0.0;
        vec2 at = origin + d.xz * t;
        float shape = cloud_shape(noise, at, lod);
        if (shape <= 0.0) continue;
        // Flat below, heaped above: the higher, the more of the shape is gone.
        float heap = shape * 1.45 - high * high * 1.1 - max(0.12 - high, 0.0) * 3.0;
        float fine = textureLod(noise, at * kFine * 2.0 + vec2(high * 0.13, -high * 0.09) + misc.x * 0.0005, lod + 2.0).g;
        float density = clamp(heap - (1.0 - fine) * (0.50 + 0.25 * high), 0.0, 1.0);
        if (density <= 0.004) continue;
        // What stands towards the light, by two looks; less of it the higher we are.
        vec2 lean = towards_light.xz * (kCloudThick / max(towards_light.y, 0.22));
        float first = cloud_shape(noise, at + lean * 0.22, lod) * 1.45 - (high + 0.22) * (high + 0.22) * 1.1 - 0.22;
        float second = cloud_shape(noise, at + lean * 0.65, lod + 1.0) * 1.45 - (high + 0.65) * (high + 0.65) * 1.1 - 0.22;
        float depth = density * 0.9 + max(first, 0.0) * 2.1 + max(second, 0.0) * 2.6;
        // Light that was scattered many times goes deeper (an octave of Wrenninge et al. 2013).
        float direct = exp(-depth * 1.25) * phase + 0.42 * exp(-depth * 0.30);
        vec3 lit = cloud_light.rgb * (direct * 1.25) + mix(from_below, from_above, 0.35 + 0.65 * high) * (0.62 + 0.38 * high);
        float passes = exp(-density * stride * 0.030);
        light += lit * (through * (1.0 - passes));
        through *= passes;
        if (through < 0.02) { through = 0.0; break; }
    }
#endif
    return vec4(light * haze, mix(1.0, through, haze));
}
