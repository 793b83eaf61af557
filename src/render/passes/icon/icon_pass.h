// A block's picture for the hotbar.
#pragma once

#include "base/result.h"
#include "gfx/handles.h"
#include "render/texture_set.h"
#include "scene/block_model.h"

namespace vitrail::render {

// RGBA8, premultiplied, size x size. Plants and other flat things show their texture upright.
// Errors: limit, where the driver gives no framebuffer.
Result<gfx::Texture> draw_icon(const gfx::Program& program, const TextureSet& textures, const StateTable& states,
                               const scene::BlockModels& models, StateId state, u32 size);

} // namespace vitrail::render
