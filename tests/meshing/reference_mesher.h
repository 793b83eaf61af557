// The mesher's answer, found the plain way: cell by cell, face by face, straight from the rules in mesher.h.
#pragma once

#include "render/meshing/mesher.h"

#include <map>
#include <string>
#include <tuple>

namespace vitrail::test {

// A unit face: pass, face, cell -> look and occlusion (cube quads), or a count of model quads with given bits.
struct UnitFaces {
    using Key = std::tuple<u32, u32, u32>; // pass, face, cell
    std::map<Key, std::pair<u64, u32>> cubes;
    std::map<std::tuple<u32, u32, u64>, u32> models; // pass, cell, bits without position -> how many
    std::map<std::tuple<u32, u32, u32>, u32> slopes; // pass, cell, face of liquid model quads -> how many
    std::string error;                               // overlap, bad group, ... of the mesh read
};

UnitFaces reference_mesh(const render::MeshInput& input);
// The mesh's quads cut into unit faces.
UnitFaces unit_faces(const render::SectionMesh& mesh, const scene::BlockModels& models);

} // namespace vitrail::test
