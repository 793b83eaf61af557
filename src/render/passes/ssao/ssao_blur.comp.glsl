// One direction of the blur that evens out the noise of ssao.comp.glsl. Neighbors count where they lie in the same plane, of the
// same view, and near: nothing is carried over an edge.
#include "common/frame.glsl"
#include "common/normal.glsl"
#include "common/surface.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0) uniform sampler2D t_ao;
layout(binding = 2) uniform usampler2D t_surface;
layout(binding = 3) uniform sampler2D t_depth;
layout(location = 0) uniform vec2 u_radius; // blocks
layout(location = 1) uniform ivec2 u_step;  // pixels: (1, 0) or (0, 1)
layout(binding = 0, r8) writeonly uniform image2D i_ao;

const int kReach = 3;

vec3 place_of(ViewData view, ivec2 pixel, float depth) {
    vec2 ndc = (vec2(pixel) + 0.5) * screen.zw * 2.0 - 1.0;
    return (view.ray_forward.xyz + view.ray_right.xyz * ndc.x + view.ray_up.xyz * ndc.y) * (view.fraction.w / depth);
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy), size = ivec2(screen.xy);
    if (any(greaterThanEqual(pixel, size))) return;
    float depth = texelFetch(t_depth, pixel, 0).r;
    if (depth <= 0.0) {
        imageStore(i_ao, pixel, vec4(1.0));
        return;
    }
    uvec4 surface = texelFetch(t_surface, pixel, 0);
    ViewData view = views[surface.z & 7u];
    uint face = surface.z >> 3 & 7u;
    float away = view.fraction.w / depth;
    vec3 place = place_of(view, pixel, depth);
    vec3 normal = face < 6u ? axis_of_face(face) : normal_from_bytes(surface.xy);
    float plane = 40.0 / (1.0 + 0.2 * away); // 1 / blocks
    float near = 1.0 / (0.35 * u_radius.x);
    float sum = texelFetch(t_ao, pixel, 0).r, weights = 1.0;
    for (int i = -kReach; i <= kReach; ++i) {
        ivec2 there = pixel + u_step * i;
        if (i == 0 || any(lessThan(there, ivec2(0))) || any(greaterThanEqual(there, size))) continue;
        float far = texelFetch(t_depth, there, 0).r;
        if (far <= 0.0 || texelFetch(t_surface, there, 0).z != surface.z) continue;
        vec3 d = place_of(view, there, far) - place;
        float off = abs(dot(d, normal)) * plane;
        float weight = max(1.0 - off, 0.0) * exp2(-dot(d, d) * near * near) * (1.0 - abs(float(i)) * (0.5 / float(kReach)));
        sum += texelFetch(t_ao, there, 0).r * weight;
        weights += weight;
    }
    imageStore(i_ao, pixel, vec4(sum / weights));
}
