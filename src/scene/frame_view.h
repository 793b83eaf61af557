// FrameView: everything a renderer needs to know of one frame, plain data. The raster renderer and the path tracer take the
// same. A portal seen is one more View; view 0 is the camera.
#pragma once

#include "math/mat.h"
#include "math/vec.h"
#include "voxel/coords.h"

#include <vector>

namespace vitrail::scene {

// One place looked from. Every pixel of the G-buffer carries the number of the view it belongs to.
struct View {
    Located<WorldPos> eye;
    Mat4 rotation;          // world directions to view space (right, up, -forward); no translation: all is camera-relative
    float fov_y = 1.2217f;  // radians
    float scale = 1;        // blocks of this view's dimension a block of view 0
    Vec4 clip_plane{0, 0, 0, 1}; // camera-relative plane (n, d): drawn where n.p + d >= 0; the default keeps all
    u8 parent = 0;          // view it is seen from
    bool mirrored = false;  // winding turns
    bool underwater = false; // the eye is inside a liquid
    float open_air = 1;     // 0..1, of view 0: how open to the sky the eye stands; air in the dark does not shine
};

// Light and color of the sky, linear RGB, from the time of day (sky.h).
struct SkyState {
    float time = 6000;      // 0..24000, 6000 noon
    Vec3 sun_direction{0, 1, 0}; // towards the sun
    Vec3 moon_direction{0, -1, 0};
    Vec3 sun_light;         // direct light of sun or moon, whichever is up
    Vec3 ambient;           // light of the sky on an open surface
    Vec3 zenith, horizon;   // colors of the dome
    Vec3 fog;               // color that far land fades to
    float stars = 0;        // 0..1
    Vec3 glow;              // light scattered around the sun at dawn and dusk
    // Light of the whole sky on a surface, by its direction n: nine harmonics in the order 1, y, z, x, xy, yz, 3zz - 1,
    // xz, xx - yy, constants taken in (sky.h: sky_irradiance).
    Vec3 irradiance[9]{};
};

// Boxes outlined in the world: the picked block. Boxes are relative to the block's least corner, in blocks.
struct Outline {
    Located<BlockPos> at;
    std::vector<Box> boxes;
};

struct FrameView {
    u32 width = 854, height = 480;
    std::vector<View> views;
    SkyState sky;
    float view_distance = 192; // blocks
    float seconds = 0;         // for animation; never wraps visibly (kept below 2^16)
    float gamma_exposure = 1;
    std::vector<Outline> outlines;
};

} // namespace vitrail::scene
