// How much of the sun's (or moon's) light reaches a surface, by color. Needs frame.glsl.
//
// Against acne: a surface's depth over the filter's kernel is the plane it lies in, known exactly by its normal; the rest,
// that a texel holds the depth of its center, is met by an offset along the normal in proportion to texel and slope.
// Soft outlines: Percentage-Closer Soft Shadows (Fernando 2005): the mean distance of what blocks times the sun's
// width is the radius of the filter, a Vogel disk turned by a full circle of interleaved gradient noise (Jimenez 2014),
// which antialiasing in time evens out. SHADOW_QUADS, for passes over the whole screen without it: four pixels share one
// disk of four times the samples and its mean, and there is no noise.
#include "common/pixel.glsl"
#include "shadow/shadow_map.glsl"

#ifdef SHADOWS
const float kShadowWidest = 0.5; // blocks; kPenumbraMost in shadow_cascades.h
#ifdef SHADOW_QUADS
const mat2 kGoldenTurn = mat2(-0.98471353, -0.17418194, 0.17418194, -0.98471353); // four golden angles
#else
const mat2 kGoldenTurn = mat2(-0.73736888, 0.67549029, -0.67549029, -0.73736888);
#endif
// Light that is left after a block of water, on the way down: its logarithm of base 2.
const vec3 kWaterLight = vec3(0.34, 0.115, 0.085);

// Direction of the disk's first sample, and its share of the way to the second.
vec3 shadow_start() {
#ifdef SHADOW_QUADS
    ivec2 pixel = ivec2(pixel_middle()) & 1;
    float k = float(pixel.x + 2 * pixel.y);
    float angle = k * 2.39996323, share = (k + 0.5) * 0.25;
#else
    float noise = fract(52.9829189 * fract(dot(pixel_middle() + shadow_info.z, vec2(0.06711056, 0.00583715))));
    float angle = noise * 6.2831853, share = 0.5;
#endif
    return vec3(cos(angle), sin(angle), share);
}

#ifdef SHADOW_QUADS
float shadow_radius = 0.0; // of the last filter, blocks

// The mean over those of four pixels that show one plane and lie within one filter's reach. Called where all pixels come
// by.
vec3 shadow_quad(vec3 light, vec3 place, vec3 face, float near) {
    float plane = dot(place, face), wide = shadow_radius * shadow_radius;
    vec2 to_other = vec2(1 - 2 * (ivec2(pixel_middle()) & 1)) * 0.5;
    vec3 step_x = dFdxFine(light), over_x = dFdxFine(place);
    float plane_x = abs(dFdxFine(plane)), turn_x = dot(abs(dFdxFine(face)), vec3(1.0));
    if (plane_x < near && turn_x < 0.1 && dot(over_x, over_x) < wide) light += step_x * to_other.x;
    vec3 step_y = dFdyFine(light), over_y = dFdyFine(place);
    float plane_y = abs(dFdyFine(plane)), turn_y = dot(abs(dFdyFine(face)), vec3(1.0));
    if (plane_y < near && turn_y < 0.1 && dot(over_y, over_y) < wide) light += step_y * to_other.y;
    return light;
}
#endif

#ifdef SHADOW_COLOR
vec3 shadow_color(vec2 at, float layer, float depth, float range, float bias) {
    vec4 c = textureLod(t_shadow_color, vec3(at, layer), 0.0);
    uint code = uint(c.a * 65535.0 + 0.5);
    if (code == 65535u) return vec3(1.0);
    float way = (depth - float(code >> 1) * (1.0 / 32767.0)) * range; // blocks behind the nearest
    if (way <= bias) return vec3(1.0);
    return (code & 1u) != 0u ? c.rgb * exp2(-way * kWaterLight) : c.rgb;
}
#endif

vec3 shadow_in(int i, vec3 place, vec3 face, vec3 start) {
    ShadowCascade c = shadow_cascades[i];
    float texel = c.size.x, range = c.size.y, layer = float(i);
    float across = 1.0 / (texel * SHADOW_SIZE); // texture coordinates a block
    // The normal along the map's axes; z to the light.
    vec3 n = vec3(dot(face, c.u.xyz), dot(face, c.v.xyz), 0.0) * (texel * SHADOW_SIZE);
    n.z = -dot(face, c.z.xyz) * range;
    float sine = sqrt(max(1.0 - n.z * n.z, 0.0));
    vec3 at = shadow_place(c, place + face * (texel * (0.25 + 1.5 * sine)));
    vec2 slope = n.xy * (1.0 / (max(n.z, 0.04) * range)); // depth a block aside
#if SHADOW_SAMPLES == 1
    float lit = texture(t_shadow, vec4(at.xy, layer, at.z));
    float radius = texel;
#else
    // What stands in between?
    float search = clamp(128.0 * shadow_info.w, 1.5 * texel, kShadowWidest);
    float blockers = 0.0, sum = 0.0;
    vec2 d = start.xy;
    for (int k = 0; k < SHADOW_SEARCH; ++k) {
        vec2 aside = d * (sqrt((float(k) + start.z) * (1.0 / float(SHADOW_SEARCH))) * search);
        d = kGoldenTurn * d;
        vec4 depths = textureGather(t_shadow_depth, vec3(at.xy + aside * across, layer), 0);
        float here = at.z + dot(slope, aside);
        vec4 blocks = vec4(lessThan(depths, vec4(here)));
        blockers += dot(blocks, vec4(1.0));
        sum += dot(blocks, here - depths);
    }
    float lit = 1.0, radius = texel;
    if (blockers > 0.0) {
        radius = clamp(sum / blockers * range * shadow_info.w, texel, kShadowWidest);
        lit = 0.0;
        // Nothing but blockers: the core of the shadow.
        if (blockers < float(4 * SHADOW_SEARCH)) {
            d = start.xy;
            for (int k = 0; k < SHADOW_SAMPLES; ++k) {
                vec2 aside = d * (sqrt((float(k) + start.z) * (1.0 / float(SHADOW_SAMPLES))) * radius);
                d = kGoldenTurn * d;
                lit += texture(t_shadow, vec4(at.xy + aside * across, layer, at.z + dot(slope, aside)));
            }
            lit *= 1.0 / float(SHADOW_SAMPLES);
        }
    }
#endif
#ifdef SHADOW_QUADS
    shadow_radius = radius;
#endif
    vec3 light = vec3(lit);
#ifdef SHADOW_COLOR
    if (c.size.w > 0.0 && lit > 0.0) {
        float bias = 0.04 + texel * (0.5 + sine / max(n.z, 0.1));
        vec3 through = vec3(0.0);
        vec2 e = start.xy;
        for (int k = 0; k < SHADOW_COLOR; ++k) {
            vec2 aside = e * (sqrt((float(k) + start.z) * (1.0 / float(SHADOW_COLOR))) * max(radius, 1.2 * texel));
            e = kGoldenTurn * e;
            through += shadow_color(at.xy + aside * across, layer, at.z + dot(slope, aside), range, bias);
        }
        light *= through * (1.0 / float(SHADOW_COLOR));
    }
#endif
    return light;
}
#endif

// place: camera-relative; face: unit normal of the geometry (the direction to the light, for what has no side); facing:
// cosine to the light; sky: level of the sky's light, 0..1; view: only view 0 has maps of its own.
vec3 sun_visibility(vec3 place, vec3 face, float facing, float sky, uint view) {
    // Without shadow maps direct light fades where the sky is not quite open, under trees and eaves.
    float open_sky = clamp(sky * 5.0 - 3.9, 0.0, 1.0);
    open_sky *= open_sky;
#ifdef SHADOWS
    float away = length(place);
    float beyond = clamp((away - shadow_info.x) * shadow_info.y + 1.0, 0.0, 1.0);
    bool mapped = view == 0u && beyond < 1.0;
    // No sky, no sun: rays may pass the edge of the land that is loaded, or of what casts.
#ifdef SHADOW_COLOR
    float some_sky = clamp(sky * 15.0, 0.0, 1.0);
#else
    float some_sky = clamp(sky * 1.6, 0.0, 1.0); // what no map knows of takes its share: water
#endif
    bool asked = mapped && facing > 0.0 && some_sky > 0.0 && dot(face, light_direction.xyz) > 0.0;
    vec3 light = vec3(0.0);
    if (asked) {
        vec3 start = shadow_start();
        int i = min(shadow_cascade(away), SHADOW_CASCADES - 1);
        light = shadow_in(i, place, face, start);
        // The last tenth of a cascade goes over into the next.
        float next = clamp((away / shadow_cascades[i].size.z - 0.9) * 10.0, 0.0, 1.0);
        if (next > 0.0 && i + 1 < SHADOW_CASCADES) light = mix(light, shadow_in(i + 1, place, face, start), next);
    }
#ifdef SHADOW_QUADS
    light = shadow_quad(light, place, face, 0.01 + 0.001 * away);
#endif
    return mapped ? mix(light * some_sky, vec3(open_sky), beyond) : vec3(open_sky);
#else
    return vec3(open_sky);
#endif
}
