#include "render/meshing/mesh_kernels.inl"

namespace vitrail::render {

const MeshKernels kMeshKernelsAvx2 = VX_MESH_TABLE("avx2");

} // namespace vitrail::render
