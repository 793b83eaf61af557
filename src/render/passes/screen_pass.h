// Passes that shade the whole screen with one triangle: lighting, sky, tone map.
#pragma once

#include "gfx/handles.h"

#include <initializer_list>

namespace vitrail::render {

// Which pixels of the attached depth are shaded.
enum class ScreenArea { all, surfaces, background };
// over: premultiplied colors are laid over what is there.
enum class ScreenBlend { none, over };

// textures: of units 0, 1, ...; 0 leaves a unit empty.
void draw_screen(const gfx::Program& program, u32 vertex_array, ScreenArea area, std::initializer_list<u32> textures,
                 ScreenBlend blend = ScreenBlend::none);

} // namespace vitrail::render
