// VX_HD marks functions that compile for CPU and CUDA alike (kernel dialect: values and views only).
#pragma once

#ifdef __CUDACC__
#define VX_HD __host__ __device__ __forceinline__
#else
#define VX_HD inline
#endif
