#include "render/meshing/mesh_kernels.inl"

namespace vitrail::render {

const MeshKernels kMeshKernelsPortable = VX_MESH_TABLE("portable");

} // namespace vitrail::render
