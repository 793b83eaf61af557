#include "render/meshing/mesh_kernels.inl"

namespace vitrail::render {

const MeshKernels kMeshKernelsAvx512 = VX_MESH_TABLE("avx512");

} // namespace vitrail::render
