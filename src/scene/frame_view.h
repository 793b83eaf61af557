// FrameView: everything a renderer needs to know of one frame, plain data. The raster renderer and the path tracer take
// the same. A portal seen is one more View; view 0 is the camera.
#pragma once

#include "math/mat.h"
#include "math/vec.h"
#include "scene/sky_table.h"
#include "scene/spherical_harmonics.h"
#include "voxel/block_storage.h"
#include "voxel/coords.h"

#include <vector>

namespace vitrail::scene {

// The liquid that the eye is in: what light loses in it a block by color (base e), and what it adds. In thin air all 0.
struct Medium {
    Vec3 absorption{}, scattering{};
    Vec3 glow{};     // radiance of its own: lava
    float depth = 0; // of the eye below the surface, blocks
    float open = 1;  // 0..1: share of the sky's light that reaches the surface above
};

// One place looked from. Every pixel of the G-buffer carries the number of the view it belongs to.
struct View {
    Located<WorldPos> eye;
    Mat4 rotation; // world directions to view space (right, up, -forward); no translation: all is camera-relative
    float fov_y = 1.2217f;       // radians
    float scale = 1;             // blocks of this view's dimension a block of view 0
    Vec4 clip_plane{0, 0, 0, 1}; // camera-relative plane (n, d): drawn where n.p + d >= 0; the default keeps all
    u8 parent = 0;               // view it is seen from
    bool mirrored = false;       // winding turns
    bool underwater = false;     // the eye is inside a liquid:
    Medium medium;               // this one
    i32 sea_level = 63;          // where mist lies, blocks
    bool misty = true;           // false: under a roof without sky there is none
    float open_air = 1;          // 0..1, of view 0: how open to the sky the eye stands; air in the dark does not shine
};

// Light and color of the sky, linear RGB in the unit of sky.h, which makes it from the time of day.
struct SkyState {
    float time = 6000;           // 0..24000, 6000 noon
    Vec3 sun_direction{0, 1, 0}; // towards the sun
    Vec3 moon_direction{0, -1, 0};
    u32 moon_phase = 0;       // 0 full, 2 waning half, 4 new, 6 waxing half; of 8
    Vec3 pole{0, 0, 1};       // unit: what sun, moon and stars turn about
    float star_turn = 0;      // radians that they have turned
    float stars = 0;          // 0..1, how much of them shows
    Vec3 sun_light;           // direct light of sun or moon, whichever is up; 0 where they take over from each other
    Vec3 sun_disc, moon_disc; // colors of the discs; discs.glsl says how bright the parts are
    Vec3 cloud_light;         // direct light at the height of clouds
    Vec3 cloud_direction{0, 1, 0}; // towards where it comes from; it changes while there is none
    Vec2 sun_azimuth{1, 0};        // unit (x, z): the column 0 of `dome` points there
    SkyTable dome;                 // clear sky without discs, stars and clouds
    Irradiance irradiance;         // of the dome and of the ground it lights, over pi; without the direct light
    Vec3 ambient;                  // irradiance on a surface that faces up
};

// Boxes outlined in the world: the picked block. Boxes are relative to the block's least corner, in blocks.
struct Outline {
    Located<BlockPos> at;
    std::vector<Box> boxes;
};

// A box that stands anywhere: someone who walks, a block that falls. Its faces are a block's, stretched over it.
struct EntityBox {
    Located<WorldPos> least; // corner
    Vec3 size{1, 1, 1};      // blocks
    StateId looks_like = StateId::air;
};

struct FrameView {
    u32 width = 854, height = 480; // of the picture
    float resolution = 1;          // 0..1, share of width and height that is drawn, then enlarged (resolution.h)
    std::vector<View> views;
    SkyState sky;
    float view_distance = 192; // blocks
    float seconds = 0;         // for animation; never wraps visibly (kept below 2^16)
    float gamma_exposure = 1;
    std::vector<Outline> outlines;
    std::vector<EntityBox> entities; // without who looks; the path tracer shows them
};

} // namespace vitrail::scene
