// VX_HD marks functions that compile for CPU and CUDA alike (kernel dialect: values and views only). They are always
// inlined: a copy made under one set of vector flags must never be the one that a baseline build calls. VX_HD_FN marks
// large ones that may stay calls: templates over a lane type (terrain/kernel/lanes.h), which differs by vector set.
#pragma once

#ifdef __CUDACC__
#define VX_HD __host__ __device__ __forceinline__
#define VX_HD_FN __host__ __device__
#else
#define VX_HD inline __attribute__((always_inline))
#define VX_HD_FN inline
#endif
