// The drawn models of all ShapeKinds but cubes and liquids, after Minecraft's own proportions. Boxes are in 1/16 block
// for a block that faces north; what bodies and picking use of the same states is world/shape.cpp.
#include "scene/model_builder.h"

#include <algorithm>
#include <charconv>

namespace vitrail::scene {

namespace {

constexpr std::array<const char*, 4> kSideNames{"north", "east", "south", "west"};
constexpr u32 kWest = 1, kEast = 2, kDown = 4, kUp = 8, kNorth = 16, kSouth = 32;

struct Subject {
    const StateInfo& info;
    const BlockRegistry& registry;
    ModelBuilder& out;

    std::string_view get(std::string_view property, std::string_view otherwise = {}) const {
        return info.state.get(property, otherwise);
    }
    bool is_true(std::string_view property) const { return get(property) == "true"; }
    int number(std::string_view property, int low, int high, int otherwise) const {
        const std::string_view text = get(property);
        int v = otherwise;
        if (std::from_chars(text.data(), text.data() + text.size(), v).ec != std::errc{}) v = otherwise;
        return std::clamp(v, low, high);
    }
    int side() const {
        const std::string_view facing = get("facing", "north");
        for (int i = 0; i < 4; ++i)
            if (facing == kSideNames[u32(i)]) return i;
        return 0;
    }
    // The look's texture number i as content lists them, the first where there are fewer.
    TextureId listed(std::size_t i) const {
        const auto& names = info.look->textures;
        if (names.empty()) return TextureId::unknown;
        return registry.find_texture(names[i < names.size() ? i : 0]).value_or(TextureId::unknown);
    }
};

// A list of two is side and end (up and down) in a model; the table's answer turned it with axis and facing, for cubes.
std::array<TextureId, 6> model_faces(const Subject& s) {
    if (s.info.look->textures.size() != 2) return s.info.face_textures;
    const TextureId side = s.listed(0), end = s.listed(1);
    return {side, side, end, end, side, side};
}

void add_half_cells(const Subject& s) { // slabs and stairs, from their boxes
    u32 cells = 0;
    for (u32 i = 0; i < 8; ++i) {
        const i32 x = i32(i & 1) * 32 + 16, z = i32(i >> 1 & 1) * 32 + 16, y = i32(i >> 2) * 32 + 16;
        for (const ShapeBox& b : s.info.shape.pick)
            if (x > b.min[0] && x < b.max[0] && y > b.min[1] && y < b.max[1] && z > b.min[2] && z < b.max[2])
                cells |= 1u << i;
    }
    s.out.half_cells(cells);
}

void add_fence(const Subject& s) {
    s.out.box({6, 0, 6, 10, 16, 10});
    for (int side = 0; side < 4; ++side) {
        if (!s.is_true(kSideNames[u32(side)])) continue;
        s.out.turn(float(side));
        s.out.box({7, 6, 0, 9, 9, 6}, kWest | kEast | kUp | kDown | kNorth);
        s.out.box({7, 12, 0, 9, 15, 6}, kWest | kEast | kUp | kDown | kNorth);
    }
}

void add_wall(const Subject& s) {
    const auto arm = [&](int side) { // 0, or the arm's height
        const std::string_view v = s.get(kSideNames[u32(side)]);
        return v == "low" || v == "true" ? 14.0f : v == "tall" ? 16.0f : 0.0f;
    };
    const bool any = arm(0) > 0 || arm(1) > 0 || arm(2) > 0 || arm(3) > 0;
    const bool post = s.get("up", "true") == "true" || !any;
    if (post) s.out.box({4, 0, 4, 12, 16, 12});
    for (int side = 0; side < 4; ++side) {
        if (arm(side) == 0) continue;
        s.out.turn(float(side));
        s.out.box({5, 0, 0, 11, arm(side), post ? 4.0f : 8.0f},
                  post ? u32(ModelBuilder::kAllFaces) & ~kSouth : kWest | kEast | kUp | kDown | kNorth);
    }
}

void add_pane(const Subject& s) {
    const TextureId glass = s.listed(0), edge = s.listed(1);
    bool joined[4];
    int count = 0;
    for (int side = 0; side < 4; ++side)
        count += joined[side] = s.is_true(kSideNames[u32(side)]);
    for (int side = 0; side < 4; ++side) {
        s.out.turn(float(side));
        if (joined[side]) {
            s.out.texture(glass);
            s.out.box({7, 0, 0, 9, 16, 7}, kWest | kEast);
            s.out.texture(edge);
            s.out.box({7, 0, 0, 9, 16, 7}, kUp | kDown);
        } else {
            // An end of the pane shows its edge; the middle of a straight run its glass.
            s.out.texture(count == 1 && joined[(side + 2) & 3] ? edge : glass);
            s.out.box({7, 0, 7, 9, 16, 9}, kNorth);
        }
    }
    s.out.turn(0);
    s.out.texture(edge);
    s.out.box({7, 0, 7, 9, 16, 9}, kUp | kDown);
}

void add_gate(const Subject& s) {
    const float low = s.is_true("in_wall") ? 3.0f : 0.0f;
    s.out.turn(float(s.side()));
    const auto box = [&](float x0, float y0, float z0, float x1, float y1, float z1,
                         u32 faces = ModelBuilder::kAllFaces) {
        s.out.box({x0, y0 - low, z0, x1, y1 - low, z1}, faces);
    };
    box(0, 5, 7, 2, 16, 9);
    box(14, 5, 7, 16, 16, 9);
    if (s.is_true("open")) { // both wings swing towards the facing
        for (const float x : {0.0f, 14.0f}) {
            box(x, 6, 1, x + 2, 15, 3);
            box(x, 6, 3, x + 2, 9, 7, kWest | kEast | kUp | kDown);
            box(x, 12, 3, x + 2, 15, 7, kWest | kEast | kUp | kDown);
        }
    } else {
        box(6, 9, 7, 10, 12, 9, kWest | kEast | kNorth | kSouth);
        box(2, 6, 7, 14, 9, 9, kUp | kDown | kNorth | kSouth);
        box(2, 12, 7, 14, 15, 9, kUp | kDown | kNorth | kSouth);
    }
}

void add_cross(const Subject& s) {
    s.out.texture(s.listed(0));
    s.out.upright(0.8f, 0.8f, 15.2f, 15.2f, 0, 16, true);
    s.out.upright(0.8f, 15.2f, 15.2f, 0.8f, 0, 16, true);
}

void add_crop(const Subject& s) {
    s.out.texture(s.listed(0));
    for (const float at : {4.0f, 12.0f}) {
        s.out.upright(0, at, 16, at, -1, 15, true);
        s.out.upright(at, 0, at, 16, -1, 15, true);
    }
}

// A stick of 2 x 2 with its top painted at (7, 6) of the picture.
void add_torch(const Subject& s, bool wall) {
    s.out.texture(s.listed(0));
    s.out.follow_model(true);
    if (wall) {
        s.out.turn(float(s.side()));
        s.out.tilt(22.5f, 3.5f, 16);
    }
    const float y = wall ? 3.5f : 0.0f, z = wall ? 15.0f : 7.0f;
    // Texture coordinates are those of a torch on the floor.
    for (u32 f = 0; f < 6; ++f) {
        if (f == 2 && !wall) continue;
        ModelBuilder part;
        part.follow_model(true);
        part.texture(s.listed(0));
        part.box({7, 0, 7, 9, 10, 9}, 1u << f);
        std::array<Vec2, 4> uv;
        for (u32 i = 0; i < 4; ++i) {
            const ModelQuad& g = part.quads()[0].geometry;
            uv[i] = {float(g.corners[i].s) / 16, float(g.t[i]) / 16};
            if (f == 3) uv[i].y -= 1;
            if (f == 2) uv[i].y += 5;
        }
        s.out.box_with_uv({7, y, z, 9, y + 10, z + 2}, Face(f), uv);
    }
}

void add_door(const Subject& s) {
    const bool open = s.is_true("open"), right = s.get("hinge", "left") == "right";
    s.out.turn(float((s.side() + (open ? (right ? 3 : 1) : 0)) & 3));
    // The picture's left is the hinge, on both sides of the door.
    const bool hinge_east = right != open;
    s.out.follow_model(true);
    s.out.mirror(hinge_east);
    s.out.box({0, 0, 13, 16, 16, 16}, kSouth);
    s.out.mirror(!hinge_east);
    s.out.box({0, 0, 13, 16, 16, 16}, kNorth);
    s.out.mirror(false);
    s.out.box({0, 0, 13, 16, 16, 16}, kWest | kEast | kUp | kDown);
}

void add_trapdoor(const Subject& s) {
    if (s.is_true("open")) {
        s.out.turn(float(s.side()));
        s.out.box({0, 0, 13, 16, 16, 16});
    } else {
        const float y = s.get("half") == "top" ? 13.0f : 0.0f;
        s.out.box({0, y, 0, 16, y + 3, 16});
    }
}

void add_faces(const Subject& s) {
    s.out.texture(s.listed(0));
    for (int side = 0; side < 4; ++side) {
        if (!s.is_true(kSideNames[u32(side)])) continue;
        s.out.turn(float(side));
        s.out.box({0, 0, 0.8f, 16, 16, 0.8f});
    }
    s.out.turn(0);
    if (s.is_true("up")) s.out.box({0, 15.2f, 0, 16, 15.2f, 16});
    if (s.is_true("down")) s.out.box({0, 0.8f, 0, 16, 0.8f, 16});
}

void add_rail(const Subject& s) {
    const std::string_view shape = s.get("shape", "north_south");
    s.out.texture(s.listed(0));
    const auto sheet = [&](float turn, float north, float south) {
        s.out.turn(turn);
        s.out.sheet(north, south);
    };
    if (shape == "ascending_north") return sheet(0, 17, 1);
    if (shape == "ascending_east") return sheet(1, 17, 1);
    if (shape == "ascending_south") return sheet(2, 17, 1);
    if (shape == "ascending_west") return sheet(3, 17, 1);
    // A curve's picture joins south and east.
    const float turn = shape == "east_west" || shape == "south_west" ? 1.0f
                       : shape == "north_west"                       ? 2.0f
                       : shape == "north_east"                       ? 3.0f
                                                                     : 0.0f;
    sheet(turn, 1, 1);
}

void mount(const Subject& s) {
    const std::string_view face = s.get("face", "wall");
    s.out.mount(face == "floor"     ? ModelBuilder::Mount::floor
                : face == "ceiling" ? ModelBuilder::Mount::ceiling
                                    : ModelBuilder::Mount::wall);
    s.out.turn(float(s.side()));
}

void add_button(const Subject& s) {
    mount(s);
    s.out.box({5, 0, 6, 11, s.is_true("powered") ? 1.0f : 2.0f, 10});
}

void add_lever(const Subject& s) {
    mount(s);
    s.out.texture(s.listed(1));
    s.out.box({5, 0, 4, 11, 3, 12});
    s.out.texture(s.listed(0));
    s.out.tilt(s.is_true("powered") ? -40.0f : 40.0f, 1, 8);
    s.out.follow_model(true);
    s.out.box({7, 1, 7, 9, 11, 9}, ModelBuilder::kAllFaces & ~kDown);
}

void add_sign(const Subject& s) {
    s.out.turn(float(s.number("rotation", 0, 15, 0)) / 4 + 2); // 0 looks south
    s.out.follow_model(true);
    s.out.box({0, 8, 7.25f, 16, 16, 8.75f});
    s.out.box({7.25f, 0, 7.25f, 8.75f, 8, 8.75f}, kWest | kEast | kNorth | kSouth | kDown);
}

void add_chest(const Subject& s) {
    for (const ShapeBox& b : s.info.shape.pick)
        s.out.box({float(b.min[0]) / 4, float(b.min[1]) / 4, float(b.min[2]) / 4, float(b.max[0]) / 4,
                   float(b.max[1]) / 4, float(b.max[2]) / 4});
    const std::string_view type = s.get("type", "single");
    s.out.turn(float(s.side()));
    s.out.box({type == "left"    ? 15.0f
               : type == "right" ? 0.0f
                                 : 7.0f,
               7, 0,
               type == "left"    ? 16.0f
               : type == "right" ? 1.0f
                                 : 9.0f,
               11, 1},
              kWest | kEast | kUp | kDown | kNorth);
}

void add_bed(const Subject& s) {
    const bool head = s.get("part", "foot") == "head";
    s.out.turn(float(s.side()));
    s.out.follow_model(true);
    s.out.box({0, 3, 0, 16, 9, 16}, ModelBuilder::kAllFaces & ~(head ? kSouth : kNorth));
    s.out.texture(model_faces(s)[2]); // legs are of the wood below
    s.out.follow_model(false);
    const float z = head ? 0.0f : 13.0f;
    s.out.box({0, 0, z, 3, 3, z + 3}, ModelBuilder::kAllFaces & ~kUp);
    s.out.box({13, 0, z, 16, 3, z + 3}, ModelBuilder::kAllFaces & ~kUp);
}

void add_lantern(const Subject& s) {
    const float lift = s.is_true("hanging") ? 1.0f : 0.0f;
    s.out.box({5, lift, 5, 11, 7 + lift, 11});
    s.out.box({6, 7 + lift, 6, 10, 9 + lift, 10}, ModelBuilder::kAllFaces & ~kDown);
    if (lift > 0)
        s.out.box({7.5f, 10, 7.5f, 8.5f, 16, 8.5f}, kWest | kEast | kNorth | kSouth);
    else
        s.out.box({7, 9, 7.5f, 9, 10.5f, 8.5f}, ModelBuilder::kAllFaces & ~kDown);
}

void add_chain(const Subject& s) {
    const std::string_view axis = s.get("axis", "y");
    s.out.texture(s.listed(0));
    s.out.follow_model(true);
    if (axis != "y") s.out.mount(ModelBuilder::Mount::wall);
    if (axis == "x") s.out.turn(1);
    constexpr float a = 8 - 1.06066f, b = 8 + 1.06066f; // three wide, on the diagonals
    s.out.upright(a, a, b, b, 0, 16, false, 6.5f, 9.5f);
    s.out.upright(a, b, b, a, 0, 16, false, 6.5f, 9.5f);
}

void add_boxes(const Subject& s) {
    for (const BoxDef& def : s.info.look->boxes) {
        s.out.textures(model_faces(s));
        if (!def.texture.empty()) s.out.texture(s.registry.find_texture(def.texture).value_or(TextureId::unknown));
        const auto hold = [](float v) { return std::clamp(v, -64.0f, 64.0f); };
        s.out.box({hold(std::min(def.x0, def.x1)), hold(std::min(def.y0, def.y1)), hold(std::min(def.z0, def.z1)),
                   hold(std::max(def.x0, def.x1)), hold(std::max(def.y0, def.y1)), hold(std::max(def.z0, def.z1))});
    }
}

} // namespace

std::vector<BuiltQuad> build_shape(const StateInfo& info, const BlockRegistry& registry) {
    ModelBuilder out;
    const Subject s{info, registry, out};
    out.textures(model_faces(s));
    const int side = s.side();
    switch (info.look->shape) {
    case ShapeKind::none:
    case ShapeKind::liquid:
    case ShapeKind::count:
        break;
    case ShapeKind::cube:
    case ShapeKind::pillar:
        out.box({});
        break;
    case ShapeKind::slab:
    case ShapeKind::stairs:
        add_half_cells(s);
        break;
    case ShapeKind::fence:
        add_fence(s);
        break;
    case ShapeKind::wall:
        add_wall(s);
        break;
    case ShapeKind::fence_gate:
        add_gate(s);
        break;
    case ShapeKind::pane:
        add_pane(s);
        break;
    case ShapeKind::cross:
        add_cross(s);
        break;
    case ShapeKind::crop:
        add_crop(s);
        break;
    case ShapeKind::torch:
        add_torch(s, false);
        break;
    case ShapeKind::wall_torch:
        add_torch(s, true);
        break;
    case ShapeKind::door:
        add_door(s);
        break;
    case ShapeKind::trapdoor:
        add_trapdoor(s);
        break;
    case ShapeKind::layers:
        out.box({0, 0, 0, 16, float(2 * s.number("layers", 1, 8, 1)), 16});
        break;
    case ShapeKind::carpet:
        out.box({0, 0, 0, 16, 1, 16});
        break;
    case ShapeKind::ladder:
        out.turn(float(side));
        out.box({0, 0, 15.2f, 16, 16, 15.2f});
        break;
    case ShapeKind::faces:
        add_faces(s);
        break;
    case ShapeKind::rail:
        add_rail(s);
        break;
    case ShapeKind::button:
        add_button(s);
        break;
    case ShapeKind::lever:
        add_lever(s);
        break;
    case ShapeKind::pressure_plate:
        out.box({1, 0, 1, 15, s.is_true("powered") ? 0.5f : 1.0f, 15});
        break;
    case ShapeKind::sign:
        add_sign(s);
        break;
    case ShapeKind::wall_sign:
        out.turn(float(side));
        out.box({0, 4.5f, 14.25f, 16, 12.5f, 15.75f});
        break;
    case ShapeKind::chest:
        add_chest(s);
        break;
    case ShapeKind::bed:
        add_bed(s);
        break;
    case ShapeKind::lantern:
        add_lantern(s);
        break;
    case ShapeKind::chain:
        add_chain(s);
        break;
    case ShapeKind::lily_pad:
        out.texture(s.listed(0));
        out.sheet(0.25f, 0.25f);
        break;
    case ShapeKind::boxes:
        add_boxes(s);
        break;
    }
    return out.quads();
}

} // namespace vitrail::scene
