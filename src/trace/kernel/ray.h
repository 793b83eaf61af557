// Rays and what they meet. Kernel-safe: values only, CPU and CUDA alike.
//
// Places are a block of the world and a fraction in it, so that nothing is lost far from the world's middle; a ray's
// arithmetic is relative to the block that it starts in.
#pragma once

#include "base/hd.h"
#include "base/types.h"
#include "math/vec.h"

// Large functions: calls on a GPU, where code has to fit the instruction cache and callers to share registers; inlined
// on the CPU, as all kernels are. A file of small kernels that call each of them once may have them inlined.
#if defined(__CUDACC__) && !defined(VITRAIL_INLINE_CALLS)
#define VX_HD_CALL inline __host__ __device__ __noinline__
#else
#define VX_HD_CALL VX_HD
#endif

namespace vitrail::trace {

inline constexpr float kFar = 1e30f; // distance of nothing

// Block of the world (wraps at 2^31) and 0 <= at <= 1 inside it. On a face both cells beside it are right: who starts a
// ray says by `cell` which side it is on.
struct Place {
    IVec3 cell;
    Vec3 at;
};

struct Ray {
    Place from;
    Vec3 dir; // unit
};

// p moved by `t` along `dir`; the cell is the one that holds the new place.
VX_HD Place moved(Place p, Vec3 dir, float t) {
    const Vec3 q{p.at.x + dir.x * t, p.at.y + dir.y * t, p.at.z + dir.z * t};
    const float fx = std::floor(q.x), fy = std::floor(q.y), fz = std::floor(q.z);
    return {{p.cell.x + i32(fx), p.cell.y + i32(fy), p.cell.z + i32(fz)}, {q.x - fx, q.y - fy, q.z - fz}};
}

// b seen from a, blocks; both within 2^23 blocks of each other.
VX_HD Vec3 offset(Place a, Place b) {
    return {float(i32(u32(b.cell.x) - u32(a.cell.x))) + (b.at.x - a.at.x),
            float(i32(u32(b.cell.y) - u32(a.cell.y))) + (b.at.y - a.at.y),
            float(i32(u32(b.cell.z) - u32(a.cell.z))) + (b.at.z - a.at.z)};
}

enum class HitKind : u8 {
    nothing = 0,
    cube = 1,    // a face of a full cube (opaque, cutout texel, or the border of a medium that fills its cell)
    quad = 2,    // a quad of a model; also a liquid's surface that is no face of its cell
    box = 3,     // an entity's box
    unknown = 4, // the ray is longer than it may be, or went through more than kCellsMost cells
};

struct Hit {
    float t = kFar; // blocks from the ray's start
    IVec3 cell;     // block that was hit (inner side)
    u32 state = 0;  // of that block
    HitKind kind = HitKind::nothing;
    u8 face = 0; // cube: Face order west, east, down, up, north, south; the face's outer side looks against the ray,
                 // unless `leaving`
    bool leaving = false; // the ray was inside of this block's medium and meets the border from within
    u32 quad = 0;         // quad: index into SceneView::quads; box: index into the boxes
    float u = 0, v = 0;   // quad: texture coordinates 0..1, v downwards
};

} // namespace vitrail::trace
