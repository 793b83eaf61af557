// What smooth solid surfaces mirror. Blended over the picture by the share that is reflected: light that a surface throws
// back as a mirror never enters it, so just that share is taken from what was there.
#include "common/frame.glsl"
#include "common/sky.glsl"
#include "common/normal.glsl"
#include "common/surface.glsl"
#include "water/medium.glsl"
#include "common/fog.glsl"
#include "common/dither.glsl"
#include "ssr/ssr.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0) uniform sampler2D t_albedo;
layout(binding = 1) uniform sampler2D t_light;
layout(binding = 2) uniform usampler2D t_surface;
layout(location = 0) uniform float u_roughest;
layout(location = 1) uniform uint u_turn; // of the frame, 0 where frames are not averaged
layout(binding = 0, rgba16f) uniform image2D i_color;

// What a ray that found nothing most likely met: the sky as open as it is here, else what the lamps here light.
vec3 surroundings(vec3 direction, vec4 light) {
    vec3 below = ambient.rgb * 0.3;
    vec3 open = mix(sky_dome(direction), below, smoothstep(0.05, -0.25, direction.y));
    return mix(open, background.rgb, background.w) * (light.a * light.a) + light.rgb * light.rgb * 0.2;
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, ivec2(screen.xy)))) return;
    float depth = texelFetch(t_depth, pixel, 0).r;
    if (depth <= 0.0) return;
    uvec4 surface = texelFetch(t_surface, pixel, 0);
    float roughness = float(surface.w >> 4) * (1.0 / 15.0);
    uint face = surface.z >> 3 & 7u, number = surface.z & 7u;
    if (roughness >= u_roughest || face == kFacePlant) return;

    ViewData view = views[number];
    vec2 ndc = (vec2(pixel) + 0.5) * screen.zw * 2.0 - 1.0;
    vec3 ray = view.ray_forward.xyz + view.ray_right.xyz * ndc.x + view.ray_up.xyz * ndc.y;
    vec3 place = ray * (view.fraction.w / depth);
    vec3 towards = normalize(ray);
    float away = length(place);
    vec3 normal = normal_from_bytes(surface.xy);
    vec3 flat_normal = face < 6u ? axis_of_face(face) : normal;
    vec3 direction = reflect(towards, normal);
    // Relief may turn a mirror ray into the surface.
    float out_of = dot(direction, flat_normal);
    direction = normalize(direction + flat_normal * max(0.02 - out_of, 0.0));

    // Fresnel after Schlick (1994); rough surfaces reflect less at grazing angles (Lagarde 2011).
    float graze = 1.0 - clamp(-dot(normal, towards), 0.0, 1.0);
    float g2 = graze * graze;
    const float straight = 0.04; // what is no metal
    float share = straight + (max(1.0 - roughness, straight) - straight) * g2 * g2 * graze;
    share *= 1.0 - smoothstep(0.7, 1.0, roughness / u_roughest);
    share *= 1.0 - 0.7 * min(view.ray_up.w, 1.0); // wet already: water bends light nearly as stone does

    vec4 light = texelFetch(t_light, pixel, 0);
    vec4 seen = march_reflection_rough(place + flat_normal * (0.004 + 0.0004 * away), direction, number,
                                       pixel_noise(pixel, u_turn), roughness * roughness);
    vec3 reflected = mix(surroundings(direction, light) * texelFetch(t_albedo, pixel, 0).a, seen.rgb, seen.a);
    // The air in front of the mirror hides it.
    vec3 air = apply_fog(vec3(0.0), away, towards, number, light.a);
    vec3 clear = apply_fog(vec3(1.0), away, towards, number, light.a) - air;
    share *= dot(clear, vec3(1.0 / 3.0));
    vec4 was = imageLoad(i_color, pixel);
    imageStore(i_color, pixel, vec4(mix(was.rgb, reflected, share), was.a));
}
