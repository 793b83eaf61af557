#include "trace/scenes.h"

#include "base/rng.h"
#include "scene/sky.h"
#include "trace/kernel/path.h"
#include "trace/sky_source.h"

#include <cstdio>

namespace vitrail::test {

using namespace trace;

namespace {
constexpr u32 kSide = 8; // texels of a layer
constexpr u32 kWater = 1, kCrystal = 2, kFrost = 3, kLava = 4;
} // namespace

// A picture of one color; '#' of the pattern (8 rows of 8, or one row for all) shine or are holes.
u32 TestScene::add_layer(u32 color, u32 roughness, const std::string& shining, const std::string& holes) {
    const u32 layer = u32(albedo_.size()) / (kSide * kSide);
    const auto marked = [](const std::string& pattern, u32 i) {
        return !pattern.empty() && pattern[i % pattern.size()] == '#';
    };
    for (u32 i = 0; i < kSide * kSide; ++i) {
        albedo_.push_back(color | (marked(holes, i) ? 0u : 0xFF000000u));
        material_.push_back(0x8080u | roughness << 16 | (marked(shining, i) ? 0xFF000000u : 0u));
    }
    return layer;
}

void TestScene::add_face_block(u32 state, u32 layer, CellKind kind, Optics optics) {
    StateRecord& r = records[state];
    r.kind = kind;
    r.optics = u8(optics);
    for (u32 f = 0; f < 6; ++f)
        r.faces[f] = u64(f) << 20 | u64(layer) << 32;
}

void TestScene::add_quad(u32 state, Vec3 corner, Vec3 a, Vec3 b, u32 layer, Optics optics, u32 flags) {
    TraceQuad q{};
    q.corner = corner, q.edge_a = a, q.edge_b = b, q.texture = layer;
    q.look = u32(optics) << 16 | flags;
    q.normal = normalized(cross(a, b));
    q.ua = 1, q.v0 = 1, q.vb = -1;
    StateRecord& r = records[state];
    r.kind = CellKind::model;
    if (r.quads++ == 0) r.first_quad = u32(quads_.size());
    quads_.push_back(q);
}

TestScene::TestScene()
    : grid_({3, 3, 3})
    , frame_(std::make_unique<scene::FrameView>()) {
    records.resize(blocks_end);
    const auto cube = [&](Block b, u32 color, u32 roughness) {
        add_face_block(b, add_layer(color, roughness), CellKind::cube, Optics::matte);
    };
    const std::string all = "#";
    cube(stone, 0x8F8C8A, 230), cube(grass, 0x3D8A5A, 240), cube(wood, 0x4A6FA0, 150);
    cube(white, 0xFFFFFF, 255), cube(red, 0x3030C0, 255), cube(marble, 0xE0E4E8, 60);
    cube(gold, 0x60C8F5, 70), cube(mirror, 0xE8E8E8, 0);
    records[gold].optics = records[mirror].optics = u8(Optics::metal);
    const auto shine = [&](Block b, u16 r, u16 g, u16 blue) {
        records[b].emission[0] = r, records[b].emission[1] = g, records[b].emission[2] = blue;
    };
    add_face_block(lamp, add_layer(0xA0E0FF, 255, all), CellKind::cube, Optics::matte), shine(lamp, 48, 40, 26);
    const std::string middle = "........"
                               "........"
                               "..####.."
                               "..####.."
                               "..####.."
                               "..####.."
                               "........"
                               "........";
    add_face_block(half_lamp, add_layer(0x60A0C0, 200, middle), CellKind::cube, Optics::matte),
        shine(half_lamp, 90, 90, 120);
    const u32 stick = add_layer(0x3A5A80, 230), flame = add_layer(0x80D0FF, 255, all);
    const auto post = [&](Block b, Vec3 low, Vec3 high, u32 layer) {
        const Vec3 d = high - low;
        add_quad(b, {low.x, low.y, low.z}, {0, 0, d.z}, {0, d.y, 0}, layer, Optics::matte, 0);
        add_quad(b, {high.x, low.y, high.z}, {0, 0, -d.z}, {0, d.y, 0}, layer, Optics::matte, 0);
        add_quad(b, {low.x, low.y, high.z}, {d.x, 0, 0}, {0, d.y, 0}, layer, Optics::matte, 0);
        add_quad(b, {high.x, low.y, low.z}, {-d.x, 0, 0}, {0, d.y, 0}, layer, Optics::matte, 0);
        add_quad(b, {low.x, high.y, high.z}, {d.x, 0, 0}, {0, 0, -d.z}, layer, Optics::matte, 0);
    };
    post(torch, {0.44f, 0, 0.44f}, {0.56f, 0.5f, 0.56f}, stick);
    post(torch, {0.42f, 0.5f, 0.42f}, {0.58f, 0.66f, 0.58f}, flame);
    shine(torch, 400, 280, 130);
    add_face_block(lava, add_layer(0x2060E0, 255, all), CellKind::liquid, Optics::matte), shine(lava, 40, 18, 5);
    records[lava].medium = kLava, records[lava].liquid_height = 227;
    add_face_block(water, add_layer(0xFFFFFF, 0), CellKind::liquid, Optics::water);
    records[water].medium = kWater, records[water].liquid_height = 227;
    const u32 pane = add_layer(0xF8F4F0, 10);
    for (u32 i = 0; i < kSide * kSide; ++i) // alpha: hardly painted, but for its rim at two sides
        albedo_[pane * kSide * kSide + i] &= i % kSide == 0 || i / kSide == 0 ? 0x90FFFFFF : 0x10FFFFFF;
    add_face_block(glass, pane, CellKind::medium, Optics::thin);
    add_face_block(crystal, add_layer(0xFFFFFF, 0), CellKind::medium, Optics::dielectric);
    records[crystal].medium = kCrystal;
    add_face_block(frost, add_layer(0xFFFFFF, 100), CellKind::medium, Optics::dielectric);
    records[frost].medium = kFrost;
    const std::string lattice = "##......";
    add_face_block(leaves, add_layer(0x30A040, 230, {}, lattice), CellKind::cutout, Optics::leaf);
    const u32 petals = add_layer(0x4040E0, 230, {}, "..####..");
    const u32 sheet = TraceQuad::kTwoSided | TraceQuad::kCutout;
    add_quad(flower, {0.15f, 0, 0.15f}, {0.7f, 0, 0.7f}, {0, 0.8f, 0}, petals, Optics::matte, sheet);
    add_quad(flower, {0.15f, 0, 0.85f}, {0.7f, 0, -0.7f}, {0, 0.8f, 0}, petals, Optics::matte, sheet);

    media.resize(5);
    media[kWater].ior = 1.333f, media[kWater].kind = 1;
    media[kWater].absorption = {0.30f, 0.09f, 0.06f}, media[kWater].scattering = {0.030f, 0.034f, 0.038f};
    media[kCrystal].ior = 1.8f, media[kCrystal].kind = 2, media[kCrystal].absorption = {0.05f, 0.6f, 0.5f};
    media[kFrost].ior = 1.7f, media[kFrost].kind = 2, media[kFrost].absorption = {0.08f, 0.04f, 0.02f};
    media[kLava].ior = 1, media[kLava].kind = 2, media[kLava].absorption = {50, 50, 50};
    fixed_tints_.assign(256, 0xFFFFFFFF);
    set_sky(6000);
    camera.width = 64, camera.height = 36;
    look({0, 4, 0}, {0, 4, -1});
    publish_states();
}

TestScene::~TestScene() = default;

void TestScene::publish_states() {
    view.states = records.data();
    view.state_count = u32(records.size());
    view.quads = quads_.data();
    view.media = media.data();
    view.textures = {albedo_.data(), material_.data(), 3, 1, u32(albedo_.size()) / (kSide * kSide), kSide * kSide};
    view.fixed_tints = fixed_tints_.data();
    grid_.set_states(records, media);
    lights.set_states(view, u32(quads_.size()));
    for (auto& [at, chunk] : chunks_)
        changed_[at] = true;
}

void TestScene::set(i32 x, i32 y, i32 z, Block block) {
    const std::array<i32, 3> at{x >> 4, y >> 4, z >> 4};
    std::shared_ptr<Chunk>& chunk = chunks_[at];
    if (!chunk) chunk = std::make_shared<Chunk>();
    chunk->blocks.set(LocalPos(x & 15, y & 15, z & 15), StateId(block));
    changed_[at] = true;
}

void TestScene::fill(IVec3 least, IVec3 most, Block block) {
    for (i32 y = least.y; y <= most.y; ++y)
        for (i32 z = least.z; z <= most.z; ++z)
            for (i32 x = least.x; x <= most.x; ++x)
                set(x, y, z, block);
}

TestScene::Block TestScene::at(i32 x, i32 y, i32 z) const {
    const auto it = chunks_.find({x >> 4, y >> 4, z >> 4});
    return it == chunks_.end() ? air : Block(it->second->blocks.get(LocalPos(x & 15, y & 15, z & 15)));
}

void TestScene::publish() {
    grid_.center_on({0, 0, 0});
    for (const auto& [at, is] : changed_) {
        const ChunkPos c{at[0], at[1], at[2]};
        grid_.set_chunk(c, chunks_.at(at).get());
        lights.mark(c, std::make_shared<Chunk>(*chunks_.at(at)));
    }
    changed_.clear();
    view.grid = grid_.view();
    lights.update(view.grid);
    view.lights = lights.view();
}

void TestScene::look(Vec3 eye, Vec3 to, float fov) {
    eye_ = eye, to_ = to, fov_ = fov;
    camera.eye = moved({{0, 0, 0}, {0, 0, 0}}, eye, 1);
    camera.forward = normalized(to);
    const float up = std::tan(fov * 3.14159265f / 360), aspect = float(camera.width) / float(camera.height);
    const Vec3 right = normalized(cross(camera.forward, {0, 1, 0}));
    camera.up = cross(right, camera.forward) * up;
    camera.right = right * (up * aspect);
}

void TestScene::set_size(u32 width, u32 height) {
    camera.width = width, camera.height = height;
    look(eye_, to_, fov_);
}

void TestScene::set_sky(float time, float sun_radius) {
    frame_->sky = scene::sky_at(time);
    frame_->views.resize(1);
    frame_->views[0].sea_level = 0;
    frame_->view_distance = 96;
    sky = sky_view_of(*frame_);
    if (sun_radius > 0) sky.light_radius = sun_radius;
}

void TestScene::set_glow(Vec3 radiance) {
    sky.open = false;
    sky.ground = radiance;
    sky.sun_light = {};
    sky.haze = sky.mist = 0;
}

PixelSample TestScene::sample(u32 x, u32 y, u32 number, u32& rays) const {
    return trace_path(view, sky, camera, settings, x, y, number, rays);
}

std::vector<Vec3> TestScene::picture(u32 samples, u32 first, u64* rays) const {
    std::vector<Vec3> out(std::size_t(camera.width) * camera.height);
    u32 traced = 0;
    for (u32 y = 0; y < camera.height; ++y)
        for (u32 x = 0; x < camera.width; ++x) {
            Vec3 sum{};
            for (u32 s = 0; s < samples; ++s)
                sum += radiance_of(sample(x, y, first + s, traced));
            out[x + std::size_t(y) * camera.width] = sum * (1 / float(samples));
            if (rays) *rays += traced;
            traced = 0;
        }
    return out;
}

const char* name_of(SceneName name) {
    const char* names[] = {"open_noon", "dusk_fog", "water_and_glass", "lit_cave", "lamp_room", "night"};
    return names[int(name)];
}

static void land(TestScene& s) {
    Rng rng(9);
    s.fill({-30, -4, -30}, {30, -1, 30}, TestScene::stone);
    s.fill({-30, 0, -30}, {30, 0, 30}, TestScene::grass);
    for (int i = 0; i < 26; ++i) { // trees and rocks
        const i32 x = i32(rng.below(50)) - 25, z = i32(rng.below(44)) - 34 + 8;
        if (std::abs(x) < 3 && z > -6) continue;
        if (rng.below(3) == 0) {
            s.fill({x, 1, z}, {x + 1, 1 + i32(rng.below(3)), z + 1}, TestScene::stone);
            continue;
        }
        const i32 tall = 4 + i32(rng.below(3));
        s.fill({x - 2, tall - 1, z - 2}, {x + 2, tall + 1, z + 2}, TestScene::leaves);
        s.fill({x, 1, z}, {x, tall, z}, TestScene::wood);
    }
    for (int i = 0; i < 60; ++i) {
        const i32 x = i32(rng.below(40)) - 20, z = i32(rng.below(40)) - 20;
        if (s.at(x, 1, z) == TestScene::air) s.set(x, 1, z, TestScene::flower);
    }
}

std::unique_ptr<TestScene> make_scene(SceneName name, float sun_radius) {
    auto scene = std::make_unique<TestScene>();
    TestScene& s = *scene;
    switch (name) {
    case SceneName::open_noon:
        land(s);
        s.set(-3, 1, -6, TestScene::gold);
        s.set(3, 1, -5, TestScene::marble);
        s.set_sky(7500, sun_radius);
        s.look({0.5f, 4.2f, 8.5f}, {0, -0.2f, -1});
        break;
    case SceneName::dusk_fog:
        land(s);
        s.set_sky(11700, sun_radius);
        s.look({0.5f, 3.2f, 10.5f}, {-0.7f, 0.08f, -0.7f});
        break;
    case SceneName::water_and_glass:
        s.fill({-16, -6, -24}, {16, -1, 16}, TestScene::stone);
        s.fill({-6, -3, -9}, {6, -1, 4}, TestScene::water);
        s.fill({-6, -4, -9}, {6, -4, 4}, TestScene::white);
        s.fill({-6, 0, -12}, {6, 4, -12}, TestScene::stone);
        s.fill({-3, 0, -8}, {3, 3, -8}, TestScene::glass);
        s.fill({-5, -3, -4}, {-5, 1, -4}, TestScene::crystal);
        s.fill({7, 0, -4}, {8, 2, -3}, TestScene::frost);
        s.set(0, -3, -2, TestScene::red);
        s.set(0, 0, -10, TestScene::gold);
        s.set(5, 1, -11, TestScene::lamp);
        s.set(2, 0, -11, TestScene::mirror);
        s.set(-2, -3, 1, TestScene::half_lamp);
        s.view.wave_height = 0.06f, s.view.seconds = 2.5f;
        s.set_sky(8200, sun_radius);
        s.look({0.5f, 4.0f, 8.5f}, {0, -0.42f, -1});
        break;
    case SceneName::lit_cave: {
        Rng rng(4);
        s.fill({-14, -6, -22}, {14, 10, 12}, TestScene::stone);
        for (int i = 0; i < 40; ++i) { // bubbles of air
            const i32 x = i32(rng.below(16)) - 8, y = i32(rng.below(6)) - 1, z = i32(rng.below(26)) - 18,
                      r = 2 + i32(rng.below(3));
            for (i32 c = 0; c < (2 * r + 1) * (2 * r + 1) * (2 * r + 1); ++c) {
                const i32 dx = c % (2 * r + 1) - r, dy = c / (2 * r + 1) % (2 * r + 1) - r,
                          dz = c / ((2 * r + 1) * (2 * r + 1)) - r;
                if (dx * dx + dy * dy + dz * dz <= r * r && y + dy > -4) s.set(x + dx, y + dy, z + dz, TestScene::air);
            }
        }
        s.fill({-3, -2, 2}, {3, 3, 10}, TestScene::air);
        for (i32 x = -14; x <= 14; ++x)
            for (i32 z = -22; z <= 12; ++z)
                if (s.at(x, -3, z) == TestScene::air) s.set(x, -3, z, x < -1 ? TestScene::lava : TestScene::stone);
        for (int i = 0; i < 400; ++i) { // lamps in walls, torches on floors
            const i32 x = i32(rng.below(20)) - 10, y = i32(rng.below(9)) - 2, z = i32(rng.below(28)) - 20;
            if (s.at(x, y, z) != TestScene::air) continue;
            const bool floor = s.at(x, y - 1, z) == TestScene::stone;
            if (floor && i % 10 == 0)
                s.set(x, y, z, TestScene::torch);
            else if (s.at(x, y + 1, z) == TestScene::stone && i % 17 == 0)
                s.set(x, y + 1, z, TestScene::lamp);
        }
        s.set_sky(6000, sun_radius);
        s.sky.haze = s.sky.mist = 0;
        s.look({0.5f, 1.0f, 8.5f}, {-0.1f, -0.12f, -1}, 70);
        break;
    }
    case SceneName::lamp_room:
        s.fill({-5, -1, -9}, {5, 6, 5}, TestScene::stone);
        s.fill({-4, 0, -8}, {4, 5, 4}, TestScene::air);
        for (i32 y = 0; y <= 5; ++y)
            for (i32 z = -8; z <= 4; ++z)
                s.set(-5, y, z, TestScene::red), s.set(5, y, z, TestScene::white);
        s.fill({-4, 0, -9}, {4, 5, -9}, TestScene::white);
        s.set(0, 6, -4, TestScene::lamp);
        s.fill({-3, 0, -6}, {-2, 2, -5}, TestScene::wood);
        s.fill({2, 0, -4}, {3, 0, -3}, TestScene::marble);
        s.set(2, 1, -4, TestScene::gold);
        s.set(-1, 0, -3, TestScene::flower);
        s.set_glow({0, 0, 0});
        s.look({0.5f, 2.6f, 4.4f}, {0, -0.05f, -1}, 66);
        break;
    case SceneName::night:
        land(s);
        s.fill({-4, 1, -10}, {4, 4, -6}, TestScene::wood);
        s.fill({-3, 1, -9}, {3, 3, -7}, TestScene::air);
        s.fill({-1, 1, -6}, {1, 2, -6}, TestScene::glass);
        s.set(0, 3, -8, TestScene::lamp);
        s.set(-4, 1, -3, TestScene::torch), s.set(4, 1, -2, TestScene::torch);
        s.set(6, 3, -4, TestScene::half_lamp);
        s.set_sky(16000, sun_radius);
        s.look({0.5f, 3.2f, 6.5f}, {0, -0.1f, -1});
        break;
    }
    s.publish();
    return scene;
}

void write_picture(const std::string& path, const std::vector<Vec3>& picture, u32 width, float exposure) {
    std::FILE* file = std::fopen(path.c_str(), "wb");
    if (!file) return;
    std::fprintf(file, "P6\n%u %u\n255\n", width, u32(picture.size()) / width);
    for (const Vec3& p : picture) {
        const auto encode = [&](float v) { // a shoulder for what is bright, then sRGB's curve, about
            v = v * exposure;
            v = v / (1 + 0.5f * v) * 1.2f;
            return u8(clamp(std::pow(clamp(v, 0, 1), 1 / 2.2f) * 255 + 0.5f, 0, 255));
        };
        const u8 bytes[3] = {encode(p.x), encode(p.y), encode(p.z)};
        std::fwrite(bytes, 1, 3, file);
    }
    std::fclose(file);
}

} // namespace vitrail::test
