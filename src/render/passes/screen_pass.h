// Passes that shade the whole screen with one triangle: lighting, sky, tone map.
#pragma once

#include "gfx/handles.h"

#include <initializer_list>

namespace vitrail::render {

// Which pixels of the attached depth are shaded.
enum class ScreenArea { all, surfaces, background };
// over: premultiplied colors are laid over what is there; by_share: mixed in, the same share everywhere.
enum class ScreenBlend { none, over, add, by_share };

// textures: of units 0, 1, ...; 0 leaves a unit empty. share: for by_share, 0..1.
void draw_screen(const gfx::Program& program, u32 vertex_array, ScreenArea area, std::initializer_list<u32> textures,
                 ScreenBlend blend = ScreenBlend::none, float share = 1);

} // namespace vitrail::render
