// Small worlds for tests and benchmarks of light: blocks of every kind of optics with plain pictures made by hand, the
// grid, lamps, sky and a camera. Made by tests/trace/scenes.cpp; nothing of content/ is read.
//
//     auto scene = make_scene(SceneName::lit_cave);
//     scene->picture(64)                       // mean of so many samples a pixel
#pragma once

#include "scene/frame_view.h"
#include "trace/grid/grid.h"
#include "trace/kernel/camera.h"
#include "trace/kernel/path_settings.h"
#include "trace/kernel/pixel.h"
#include "trace/kernel/sky_view.h"
#include "trace/lights/light_store.h"

#include <map>
#include <memory>
#include <string>
#include <vector>

namespace vitrail::test {

class TestScene {
public:
    // States of every test scene.
    enum Block : u32 {
        air,
        stone, // grey, rough
        grass, // green, rough
        wood,  // brown, half rough
        white, // albedo 1, even (no coat: index 1)
        red,
        marble,    // white, smooth coat
        gold,      // metal, a little rough
        mirror,    // metal, exact
        lamp,      // shines from all of its faces
        half_lamp, // from the middle of its faces
        torch,     // a stick with a shining head, quads
        lava,
        water,
        glass,   // thin, clear but for its rim
        crystal, // clear medium that absorbs green and blue
        frost,   // rough medium
        leaves,  // cutout, light comes through
        flower,  // crossed sheets
        blocks_end
    };
    TestScene();
    ~TestScene();

    void set(i32 x, i32 y, i32 z, Block block);
    void fill(IVec3 least, IVec3 most, Block block); // both in it
    Block at(i32 x, i32 y, i32 z) const;
    // After edits: grid and lamps.
    void publish();

    // Where the eye is and looks to (any length), field of view up and down in degrees.
    void look(Vec3 eye, Vec3 to, float fov = 60);
    void set_size(u32 width, u32 height);
    // The sky at a time of day (0..24000) over land; sun_radius: radians, 0 as it is.
    void set_sky(float time, float sun_radius = 0);
    // No sky: an even glow of this radiance from everywhere.
    void set_glow(Vec3 radiance);

    trace::PixelSample sample(u32 x, u32 y, u32 number, u32& rays) const;
    // Linear radiance, rows from the top; samples first .. first + count - 1 of each pixel's sequence.
    std::vector<Vec3> picture(u32 samples, u32 first = 0, u64* rays = nullptr) const;

    trace::SceneView view;
    trace::SkyView sky;
    trace::Camera camera;
    trace::PathSettings settings;
    trace::LightStore lights;
    std::vector<trace::StateRecord> records; // edit, then publish_states
    std::vector<trace::MediumRecord> media;
    void publish_states();

private:
    void add_face_block(u32 state, u32 layer, trace::CellKind kind, trace::Optics optics);
    u32 add_layer(u32 color, u32 roughness, const std::string& shining = {}, const std::string& holes = {});
    void add_quad(u32 state, Vec3 corner, Vec3 a, Vec3 b, u32 layer, trace::Optics optics, u32 flags);

    std::vector<trace::TraceQuad> quads_;
    std::vector<u32> albedo_, material_, fixed_tints_;
    trace::Grid grid_;
    std::map<std::array<i32, 3>, std::shared_ptr<Chunk>> chunks_;
    std::map<std::array<i32, 3>, bool> changed_;
    std::unique_ptr<scene::FrameView> frame_;
    Vec3 eye_, to_;
    float fov_ = 60;
};

enum class SceneName { open_noon, dusk_fog, water_and_glass, lit_cave, lamp_room, night };
inline constexpr SceneName kSceneNames[] = {SceneName::open_noon, SceneName::dusk_fog,  SceneName::water_and_glass,
                                            SceneName::lit_cave,  SceneName::lamp_room, SceneName::night};
const char* name_of(SceneName name);
// sun_radius: as set_sky.
std::unique_ptr<TestScene> make_scene(SceneName name, float sun_radius = 0);

void write_picture(const std::string& path, const std::vector<Vec3>& picture, u32 width, float exposure = 1);

} // namespace vitrail::test
