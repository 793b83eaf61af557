// The eye, as kernels read it. Kernel-safe.
#pragma once

#include "trace/kernel/ray.h"

namespace vitrail::trace {

struct Camera {
    Place eye;
    // Of the world: a ray is forward + right * x + up * y with x, y -1..1 over the picture; forward is unit, right and
    // up hold half of the picture's width and height at distance 1.
    Vec3 right, up, forward;
    u32 width = 0, height = 0; // pixels traced
    Vec2 jitter{};             // of this frame, pixels -0.5..0.5, where the film wants it instead of the sampler
    u32 medium = 0;            // that the eye is in (SceneView::media)
};

// x, y: pixels, the picture's left upper corner is 0, 0. Unit.
VX_HD Vec3 direction_through(const Camera& c, float x, float y) {
    const float u = 2 * x / float(c.width) - 1, v = 1 - 2 * y / float(c.height);
    return normalized(c.forward + c.right * u + c.up * v);
}

// Where a place is seen: pixels, and along `forward` in blocks (z). Behind the eye z <= 0.
VX_HD Vec3 pixel_of(const Camera& c, Vec3 from_eye) {
    const float z = dot(from_eye, c.forward), r = dot(from_eye, c.right) / dot(c.right, c.right),
                u = dot(from_eye, c.up) / dot(c.up, c.up);
    return {(r / z + 1) * 0.5f * float(c.width), (1 - u / z) * 0.5f * float(c.height), z};
}

} // namespace vitrail::trace
