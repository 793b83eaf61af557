// What a block is to light, from content's look: optics by its own word or by layer, material and shape
// (docs/content.md), and the media that its inside is.
#pragma once

#include "scene/block_model.h"
#include "trace/kernel/scene_view.h"
#include "world/block_def.h"

namespace vitrail::trace {

// kind: of the state; nothing and opaque ones are never clear.
Optics optics_of(const BlockLook& look, scene::ModelKind kind);

// Index of refraction of what lies behind the surface; 1 where there is no body behind it (sheets of glass).
float ior_of(const BlockLook& look, Optics optics);

// Mean of a picture as the clear body's color follows from it: linear color of what is not clear, and alpha.
struct PictureMean {
    Vec3 color{1, 1, 1};
    float alpha = 1;
};
// Of a dielectric body of one block.
MediumRecord medium_of(const BlockLook& look, PictureMean mean);

} // namespace vitrail::trace
