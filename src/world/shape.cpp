#include "world/shape.h"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace vitrail {

namespace {

constexpr i32 kCollisionTop = kShapeUnit * 3 / 2; // fences and walls stop jumps: the highest a box may reach

// Corners in 1/16 block, as Minecraft's own numbers are written; quarters of that are exact.
ShapeBox box(float x0, float y0, float z0, float x1, float y1, float z1) {
    const auto unit = [](float v) { return i16(std::lround(v * (kShapeUnit / 16))); };
    return {{unit(x0), unit(y0), unit(z0)}, {unit(x1), unit(y1), unit(z1)}};
}

// Seen from above, north to east.
ShapeBox quarter_turn(const ShapeBox& b) {
    return {{i16(kShapeUnit - b.max[2]), b.min[1], b.min[0]}, {i16(kShapeUnit - b.min[2]), b.max[1], b.max[0]}};
}

ShapeBox upside_down(const ShapeBox& b) {
    return {{b.min[0], i16(kShapeUnit - b.max[1]), b.min[2]}, {b.max[0], i16(kShapeUnit - b.min[1]), b.max[2]}};
}

enum Side { kNorth, kEast, kSouth, kWest };
constexpr const char* kSideNames[4] = {"north", "east", "south", "west"};

int facing_of(const BlockState& state) {
    const std::string_view facing = state.get("facing", "north");
    for (int i = 0; i < 4; ++i)
        if (facing == kSideNames[i]) return i;
    return kNorth;
}

// A box written for facing north, turned to another side.
ShapeBox turned(ShapeBox b, int side) {
    for (int i = 0; i < (side & 3); ++i)
        b = quarter_turn(b);
    return b;
}

i32 number_of(const BlockState& state, std::string_view property, i32 low, i32 high, i32 otherwise) {
    const std::string_view text = state.get(property);
    i32 v = otherwise;
    if (std::from_chars(text.data(), text.data() + text.size(), v).ec != std::errc{}) v = otherwise;
    return std::clamp(v, low, high);
}

bool is_true(const BlockState& state, std::string_view property) {
    return state.get(property) == "true";
}

struct Boxes {
    std::vector<ShapeBox> collision, pick;
    void both(const ShapeBox& b) {
        collision.push_back(b);
        pick.push_back(b);
    }
    void pick_only(const ShapeBox& b) { pick.push_back(b); }
};

void add_stairs(Boxes& out, const BlockState& state) {
    const int facing = facing_of(state); // the side that is high
    const std::string_view shape = state.get("shape", "straight");
    std::vector<ShapeBox> boxes{box(0, 0, 0, 16, 8, 16)};
    if (shape == "outer_left")
        boxes.push_back(turned(box(0, 8, 0, 8, 16, 8), facing));
    else if (shape == "outer_right")
        boxes.push_back(turned(box(8, 8, 0, 16, 16, 8), facing));
    else
        boxes.push_back(turned(box(0, 8, 0, 16, 16, 8), facing));
    if (shape == "inner_left") boxes.push_back(turned(box(0, 8, 8, 8, 16, 16), facing));
    if (shape == "inner_right") boxes.push_back(turned(box(8, 8, 8, 16, 16, 16), facing));
    const bool top = state.get("half") == "top";
    for (const ShapeBox& b : boxes)
        out.both(top ? upside_down(b) : b);
}

// Posts with arms to the sides whose property says so: fences, walls, panes. Sizes in 1/16, arms from the middle out.
void add_post(Boxes& out, const BlockState& state, float post, float arm, float collision_height, bool has_post) {
    const auto add = [&](float half, float pick_height, int side, bool is_arm) {
        const auto at = [&](float height) {
            const ShapeBox b = is_arm ? box(8 - half, 0, 0, 8 + half, height, 8)
                                      : box(8 - half, 0, 8 - half, 8 + half, height, 8 + half);
            return turned(b, side);
        };
        out.collision.push_back(at(collision_height));
        out.pick.push_back(at(pick_height));
    };
    bool any = false;
    for (int side = 0; side < 4; ++side) {
        const std::string_view v = state.get(kSideNames[side]);
        if (v != "true" && v != "low" && v != "tall" && v != "side") continue;
        any = true;
        add(arm, v == "low" ? 14 : 16, side, true);
    }
    if (has_post || !any) add(post, 16, 0, false);
}

void add_gate(Boxes& out, const BlockState& state) {
    const int facing = facing_of(state);
    out.pick_only(turned(box(0, 0, 6, 16, is_true(state, "in_wall") ? 13 : 16, 10), facing));
    if (!is_true(state, "open")) out.collision.push_back(turned(box(0, 0, 6, 16, 24, 10), facing));
}

void add_door(Boxes& out, const BlockState& state) {
    int side = facing_of(state);
    if (is_true(state, "open")) side += state.get("hinge", "left") == "right" ? 3 : 1;
    out.both(turned(box(0, 0, 13, 16, 16, 16), side));
}

void add_trapdoor(Boxes& out, const BlockState& state) {
    if (is_true(state, "open"))
        out.both(turned(box(0, 0, 13, 16, 16, 16), facing_of(state)));
    else if (state.get("half") == "top")
        out.both(box(0, 13, 0, 16, 16, 16));
    else
        out.both(box(0, 0, 0, 16, 3, 16));
}

void add_faces(Boxes& out, const BlockState& state) {
    for (int side = 0; side < 4; ++side)
        if (is_true(state, kSideNames[side])) out.pick_only(turned(box(0, 0, 0, 16, 16, 1), side));
    if (is_true(state, "up")) out.pick_only(box(0, 15, 0, 16, 16, 16));
    if (is_true(state, "down")) out.pick_only(box(0, 0, 0, 16, 1, 16));
    if (out.pick.empty()) out.pick_only(box(0, 0, 0, 16, 16, 16)); // else it could never be taken away
}

// Buttons and levers: `floor` is written for a floor, facing north; `wall` for a wall to the south, facing north.
void add_mounted(Boxes& out, const BlockState& state, const ShapeBox& floor, const ShapeBox& wall) {
    const std::string_view face = state.get("face", "wall");
    const int facing = facing_of(state);
    if (face == "floor")
        out.pick_only(turned(floor, facing));
    else if (face == "ceiling")
        out.pick_only(upside_down(turned(floor, facing)));
    else
        out.pick_only(turned(wall, facing));
}

void add_chest(Boxes& out, const BlockState& state) {
    const std::string_view type = state.get("type", "single");
    const int facing = facing_of(state);
    ShapeBox b = box(1, 0, 1, 15, 14, 15);
    if (type == "left") b.max[0] = kShapeUnit;
    if (type == "right") b.min[0] = 0;
    out.both(turned(b, facing));
}

void add_bed(Boxes& out, const BlockState& state) {
    const int side = facing_of(state) + (state.get("part", "foot") == "head" ? 0 : 2); // where the legs are
    out.both(box(0, 3, 0, 16, 9, 16));
    out.both(turned(box(0, 0, 0, 3, 3, 3), side));
    out.both(turned(box(13, 0, 0, 16, 3, 3), side));
}

void add_lantern(Boxes& out, const BlockState& state) {
    const float lift = is_true(state, "hanging") ? 1 : 0;
    out.both(box(5, lift, 5, 11, 7 + lift, 11));
    out.both(box(6, 7 + lift, 6, 10, 9 + lift, 10));
}

void add_chain(Boxes& out, const BlockState& state) {
    const std::string_view axis = state.get("axis", "y");
    if (axis == "x")
        out.both(box(0, 6.5f, 6.5f, 16, 9.5f, 9.5f));
    else if (axis == "z")
        out.both(box(6.5f, 6.5f, 0, 9.5f, 9.5f, 16));
    else
        out.both(box(6.5f, 0, 6.5f, 9.5f, 16, 9.5f));
}

// Boxes as content drew them. Flat ones are leaves and flames: they can be picked, but stop nobody. Parts beyond the
// cell are only drawn, since bodies and rays look for boxes in the cells they pass.
void add_boxes(Boxes& out, const BlockLook& look) {
    for (const BoxDef& def : look.boxes) {
        const auto unit = [](float v) { return i32(std::lround(std::clamp(v, -64.0f, 64.0f) * (kShapeUnit / 16))); };
        const i32 lo[3] = {unit(std::min(def.x0, def.x1)), unit(std::min(def.y0, def.y1)),
                           unit(std::min(def.z0, def.z1))};
        const i32 hi[3] = {unit(std::max(def.x0, def.x1)), unit(std::max(def.y0, def.y1)),
                           unit(std::max(def.z0, def.z1))};
        ShapeBox collide, pick;
        bool solid = true, seen = true;
        for (int a = 0; a < 3; ++a) {
            collide.min[a] = i16(std::clamp(lo[a], 0, kShapeUnit));
            collide.max[a] = i16(std::clamp(hi[a], 0, a == 1 ? kCollisionTop : kShapeUnit));
            solid &= collide.min[a] < collide.max[a];
            pick.min[a] = i16(std::clamp(lo[a], 0, kShapeUnit));
            pick.max[a] = i16(std::clamp(hi[a], 0, kShapeUnit));
            seen &= hi[a] >= 0 && lo[a] <= kShapeUnit;
            if (pick.min[a] == pick.max[a]) { // give a sheet one unit of thickness
                if (pick.max[a] < kShapeUnit)
                    ++pick.max[a];
                else
                    --pick.min[a];
            }
        }
        if (solid) out.collision.push_back(collide);
        if (seen) out.pick.push_back(pick);
    }
}

void add_kind(Boxes& out, const BlockLook& look, const BlockState& state) {
    const int facing = facing_of(state);
    switch (look.shape) {
    case ShapeKind::none:
        if (look.collision) out.both(box(0, 0, 0, 16, 16, 16)); // a barrier: felt, not seen
        break;
    case ShapeKind::slab: {
        const std::string_view type = state.get("type", "bottom");
        out.both(type == "double" ? box(0, 0, 0, 16, 16, 16)
                 : type == "top"  ? box(0, 8, 0, 16, 16, 16)
                                  : box(0, 0, 0, 16, 8, 16));
        break;
    }
    case ShapeKind::stairs:
        add_stairs(out, state);
        break;
    case ShapeKind::fence:
        add_post(out, state, 2, 2, 24, true);
        break;
    case ShapeKind::wall:
        add_post(out, state, 4, 3, 24, state.get("up", "true") == "true");
        break;
    case ShapeKind::fence_gate:
        add_gate(out, state);
        break;
    case ShapeKind::pane:
        add_post(out, state, 1, 1, 16, true);
        break;
    case ShapeKind::cross:
        out.pick_only(box(2, 0, 2, 14, 13, 14));
        break;
    case ShapeKind::crop:
        out.pick_only(box(0, 0, 0, 16, float(2 * number_of(state, "age", 0, 7, 7) + 2), 16));
        break;
    case ShapeKind::torch:
        out.pick_only(box(6, 0, 6, 10, 10, 10));
        break;
    case ShapeKind::wall_torch:
        out.pick_only(turned(box(5.5f, 3, 11, 10.5f, 13, 16), facing));
        break;
    case ShapeKind::door:
        add_door(out, state);
        break;
    case ShapeKind::trapdoor:
        add_trapdoor(out, state);
        break;
    case ShapeKind::liquid:
        break;
    case ShapeKind::layers: {
        const i32 layers = number_of(state, "layers", 1, 8, 1);
        out.pick_only(box(0, 0, 0, 16, float(2 * layers), 16));
        // One layer less to stand on, so that feet sink into snow.
        if (layers > 1) out.collision.push_back(box(0, 0, 0, 16, float(layers == 8 ? 16 : 2 * layers - 2), 16));
        break;
    }
    case ShapeKind::carpet:
        out.both(box(0, 0, 0, 16, 1, 16));
        break;
    case ShapeKind::ladder:
        out.both(turned(box(0, 0, 13, 16, 16, 16), facing));
        break;
    case ShapeKind::faces:
        add_faces(out, state);
        break;
    case ShapeKind::rail: {
        const bool rises = state.get("shape").starts_with("ascending");
        out.pick_only(box(0, 0, 0, 16, rises ? 8 : 2, 16));
        break;
    }
    case ShapeKind::button: {
        const float deep = is_true(state, "powered") ? 1 : 2;
        add_mounted(out, state, box(5, 0, 6, 11, deep, 10), box(5, 6, 16 - deep, 11, 10, 16));
        break;
    }
    case ShapeKind::lever:
        add_mounted(out, state, box(5, 0, 4, 11, 6, 12), box(5, 4, 10, 11, 12, 16));
        break;
    case ShapeKind::pressure_plate:
        out.pick_only(box(1, 0, 1, 15, is_true(state, "powered") ? 0.5f : 1, 15));
        break;
    case ShapeKind::sign:
        out.pick_only(box(4, 0, 4, 12, 16, 12));
        break;
    case ShapeKind::wall_sign:
        out.pick_only(turned(box(0, 4.5f, 14, 16, 12.5f, 16), facing));
        break;
    case ShapeKind::chest:
        add_chest(out, state);
        break;
    case ShapeKind::bed:
        add_bed(out, state);
        break;
    case ShapeKind::lantern:
        add_lantern(out, state);
        break;
    case ShapeKind::chain:
        add_chain(out, state);
        break;
    case ShapeKind::lily_pad:
        out.both(box(1, 0, 1, 15, 1.5f, 15));
        break;
    case ShapeKind::boxes:
        add_boxes(out, look);
        break;
    case ShapeKind::cube:
    case ShapeKind::pillar:
    case ShapeKind::count:
        out.both(box(0, 0, 0, 16, 16, 16));
        break;
    }
}

} // namespace

BlockShape make_shape(const BlockLook& look, const BlockState& state) {
    Boxes boxes;
    add_kind(boxes, look, state);
    BlockShape shape;
    shape.pick = std::move(boxes.pick);
    if (look.collision) shape.collision = std::move(boxes.collision);
    const std::vector<ShapeBox> unit{ShapeBox{}};
    shape.full_cube = shape.collision == unit && shape.pick == unit;
    return shape;
}

i32 liquid_height(i32 level) {
    if (level >= 8) return kShapeUnit;
    const i32 amount = 8 - std::max(level, 0); // of nine, so that a source lies a little below the cell's top
    return (amount * kShapeUnit + 4) / 9;
}

} // namespace vitrail
