#include "rules/placement.h"

#include "math/mat.h"
#include "rules/collision.h"
#include "rules/neighbors.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace vitrail {

namespace {

// One placement while it is being decided.
struct Placing {
    EditView view;
    const PlaceRequest& request;
    BlockPos target;
    Face face;       // clicked; up where the target itself is replaced
    Face look;       // the nearest of six directions the player looks to
    Face ahead;      // the nearest of the horizontal four
    bool upper_half; // the click was nearer the cell's top
    const BlockDef* def = nullptr;
    BlockState state;

    bool has(std::string_view property) const { return !state.get(property).empty(); }
    bool allows(std::string_view property, std::string_view value) const {
        for (const PropertyDef& p : def->properties)
            if (p.name == property) return std::find(p.values.begin(), p.values.end(), value) != p.values.end();
        return false;
    }
    void set_if_allowed(const char* property, std::string_view value) {
        if (allows(property, value)) state.set(property, value);
    }
};

bool is_side(Face f) {
    return f != Face::up && f != Face::down;
}

Face nearest_face(Vec3 d) {
    const float a[3] = {std::abs(d.x), std::abs(d.y), std::abs(d.z)};
    const int axis = a[1] >= a[0] && a[1] >= a[2] ? 1 : a[0] >= a[2] ? 0 : 2;
    const float v = axis == 0 ? d.x : axis == 1 ? d.y : d.z;
    return Face(axis * 2 + (v > 0 ? 1 : 0));
}

// Torches, signs, heads and fans have a block of their own for walls: `x_torch` becomes `x_wall_torch`.
std::string wall_form(const BlockRegistry& registry, const std::string& name) {
    const std::size_t cut = name.find_last_of("_:");
    if (cut == std::string::npos) return {};
    std::string other = name.substr(0, cut + 1) + "wall_" + name.substr(cut + 1);
    return registry.find_block(other) == BlockId::unknown ? std::string() : other;
}

bool replaceable(const EditView& view, BlockPos at) {
    const StateId id = view.id_at(at);
    return view.editable(at) && id != StateId::hidden && (view.states().flags(id) & (kReplaceable | kAirLike)) &&
           view.info_at(at).shape.collision.empty();
}

// Slabs, snow and vines grow where more of the same is put to them. The grown state, or nothing.
std::optional<BlockState> grown(const Placing& p, BlockPos at, bool clicked) {
    const StateInfo& info = p.view.info_at(at);
    if (info.state.name != p.request.block || !p.view.editable(at)) return std::nullopt;
    BlockState state = info.state;
    if (info.look->shape == ShapeKind::slab) {
        const std::string_view type = state.get("type");
        if (type != "top" && type != "bottom") return std::nullopt;
        // Clicked: on its open face. Else the click was on a neighbor, on the level that is still free.
        const bool onto = clicked ? p.request.face == (type == "bottom" ? Face::up : Face::down)
                                  : p.request.face == (type == "bottom" ? Face::down : Face::up) ||
                                        (is_side(p.request.face) && p.upper_half == (type == "bottom"));
        if (!onto) return std::nullopt;
        state.set("type", "double");
        if (!state.get("waterlogged").empty()) state.set("waterlogged", "false");
        return state;
    }
    if (info.look->shape == ShapeKind::layers && (!clicked || p.request.face == Face::up)) {
        const std::string_view layers = state.get("layers");
        if (layers.size() != 1 || layers[0] < '1' || layers[0] > '7') return std::nullopt;
        state.set("layers", std::string(1, char(layers[0] + 1)));
        return state;
    }
    if (info.look->shape == ShapeKind::faces && is_side(p.request.face)) {
        const char* side = name_of(opposite(p.request.face));
        if (state.get(side) != "false") return std::nullopt;
        state.set(side, "true");
        return state;
    }
    return std::nullopt;
}

// facing, by what kind of thing it is.
void choose_facing(Placing& p, ShapeKind shape) {
    const auto set = [&](Face f) { p.set_if_allowed("facing", name_of(f)); };
    const std::string_view mounted = p.state.get("face");
    if (!mounted.empty()) { // buttons, levers
        p.state.set("face", p.face == Face::up ? "floor" : p.face == Face::down ? "ceiling" : "wall");
        set(is_side(p.face) ? p.face : p.ahead);
        return;
    }
    switch (shape) {
    case ShapeKind::stairs:
    case ShapeKind::door:
    case ShapeKind::fence_gate:
    case ShapeKind::bed:
        set(p.ahead);
        return;
    case ShapeKind::trapdoor:
        set(is_side(p.face) ? p.face : opposite(p.ahead));
        return;
    case ShapeKind::ladder:
    case ShapeKind::wall_torch:
    case ShapeKind::wall_sign:
        set(is_side(p.face) ? p.face : opposite(p.ahead));
        return;
    default:
        break;
    }
    const bool up = p.allows("facing", "up"), down = p.allows("facing", "down");
    if (up && down) { // rods and boxes stand on what was clicked; machines look at the player
        const bool stands = p.state.get("facing") == "up";
        set(stands ? p.face : opposite(p.look));
    } else if (down)
        set(p.face == Face::up || p.face == Face::down ? Face::down : opposite(p.face)); // hoppers
    else if (p.state.name.find("_wall_") != std::string::npos && is_side(p.face))
        set(p.face);
    else
        set(opposite(p.ahead));
}

void choose_axis(Placing& p) {
    static constexpr const char* names[3] = {"x", "y", "z"};
    const char* axis = names[int(p.face) / 2];
    if (!p.allows("axis", axis)) axis = int(p.ahead) / 2 == 0 ? "z" : "x"; // a sheet across the look
    p.set_if_allowed("axis", axis);
}

// The hinge: beside another door the two open together, else away from the more solid side, else as clicked.
void choose_hinge(Placing& p) {
    const Face left = counterclockwise(p.ahead), right = clockwise(p.ahead);
    const StateInfo &l = p.view.info_at(neighbor(p.target, left)), &r = p.view.info_at(neighbor(p.target, right));
    const bool door_left = l.look->shape == ShapeKind::door, door_right = r.look->shape == ShapeKind::door;
    bool hinge_right;
    if (door_left != door_right)
        hinge_right = door_left;
    else if (is_sturdy(l.shape, right) != is_sturdy(r.shape, left))
        hinge_right = is_sturdy(r.shape, left);
    else {
        const Vec3 q = p.request.point;
        hinge_right = p.ahead == Face::north   ? q.x > 0.5f
                      : p.ahead == Face::south ? q.x < 0.5f
                      : p.ahead == Face::east  ? q.z > 0.5f
                                               : q.z < 0.5f;
    }
    p.set_if_allowed("hinge", hinge_right ? "right" : "left");
}

Result<> join_chests(Placing& p) {
    const Face facing = face_named(p.state.get("facing")).value_or(Face::north);
    for (const bool left : {true, false}) {
        const BlockPos at = neighbor(p.target, left ? clockwise(facing) : counterclockwise(facing));
        const StateInfo& other = p.view.info_at(at);
        if (!p.view.editable(at) || other.state.name != p.state.name || other.state.get("type") != "single" ||
            other.state.get("facing") != p.state.get("facing"))
            continue;
        BlockState second = other.state;
        second.set("type", left ? "right" : "left");
        p.state.set("type", left ? "left" : "right");
        return p.view.set(at, second);
    }
    return {};
}

// The state from everything but the neighbors' joints.
void choose_state(Placing& p) {
    const ShapeKind shape = p.def->look.shape;
    if (p.has("facing")) choose_facing(p, shape);
    if (p.has("axis")) choose_axis(p);
    const bool high = p.face == Face::down || (is_side(p.face) && p.upper_half);
    if (shape == ShapeKind::slab) p.set_if_allowed("type", high ? "top" : "bottom");
    if (shape == ShapeKind::stairs || shape == ShapeKind::trapdoor) p.set_if_allowed("half", high ? "top" : "bottom");
    if (shape == ShapeKind::lantern || p.allows("hanging", "true"))
        p.set_if_allowed("hanging", p.face == Face::down ? "true" : "false");
    if (shape == ShapeKind::door) choose_hinge(p);
    if (shape == ShapeKind::rail) p.set_if_allowed("shape", int(p.ahead) / 2 == 0 ? "east_west" : "north_south");
    if (shape == ShapeKind::faces) p.set_if_allowed(name_of(opposite(p.face)), "true");
    if (p.allows("rotation", "15")) { // sixteenths of a turn, 0 looks south; it looks at the player
        const double turns = double(p.request.yaw) / 6.283185307179586 + 0.5;
        p.state.set("rotation", std::to_string(int(std::floor((turns - std::floor(turns)) * 16 + 0.5)) & 15));
    }
    p.set_if_allowed("persistent", "true"); // leaves put by hand do not wither
    const StateInfo& before = p.view.info_at(p.target);
    const bool water = before.in_water || (before.look->shape == ShapeKind::liquid && before.look->material == "water" &&
                                           before.liquid_level == 0);
    if (p.has("waterlogged")) p.state.set("waterlogged", water && p.state.get("type") != "double" ? "true" : "false");
}

bool body_in_way(const BlockShape& shape, BlockPos at, std::span<const BodyState> bodies) {
    for (const BodyState& body : bodies) {
        const FixedBox box = body_box(body.feet.at, height_of(body));
        for (const ShapeBox& b : shape.collision)
            if (box_of(b, at).overlaps(box)) return true;
    }
    return false;
}

Result<> check_bodies(const Placing& p, std::span<const BodyState> bodies) {
    for (const Edit& edit : p.view.batch().edits)
        if (body_in_way(p.view.states().info(edit.state).shape, edit.at, bodies))
            return fail(ErrorCode::denied, "someone stands there");
    return {};
}

Result<EditBatch> finished(Placing& p, std::span<const BodyState> bodies, std::vector<BlockPos> changed) {
    VX_TRY(check_bodies(p, bodies));
    if (!is_supported(p.view, p.target))
        return fail(ErrorCode::denied, fmt::format("{} does not hold there", p.state.name));
    VX_TRY(settle(p.view, std::move(changed)));
    return p.view.batch();
}

} // namespace

Result<EditBatch> place_block(const Dimension& dimension, const PlaceRequest& request,
                              std::span<const BodyState> bodies) {
    for (const float v : {request.point.x, request.point.y, request.point.z, request.yaw, request.pitch})
        if (!(v - v == 0.0f)) return fail(ErrorCode::invalid_argument, "a number is not finite");
    if (int(request.face) > 5) return fail(ErrorCode::invalid_argument, "no such face");
    const BlockRegistry& registry = dimension.states().registry();
    const BlockId block = registry.find_block(request.block);
    if (block == BlockId::unknown)
        return fail(ErrorCode::not_found, fmt::format("there is no block {}", request.block));
    const Vec3 look = look_direction(request.yaw, request.pitch);
    Vec3 level = look_direction(request.yaw, 0);
    level.y = 0;
    Placing p{EditView(dimension),    request,
              request.against,        request.face,
              nearest_face(look),     nearest_face(level),
              request.point.y > 0.5f, &registry.blocks()[std::size_t(block)],
              {request.block, {}}};
    if (p.def->look.shape == ShapeKind::none)
        return fail(ErrorCode::denied, fmt::format("{} cannot be placed", request.block));
    if (!p.view.editable(request.against)) return fail(ErrorCode::not_found, "the place is not loaded");

    if (p.view.states().flags(p.view.id_at(request.against)) & kAirLike)
        return fail(ErrorCode::denied, "there is nothing to build on");

    // Onto the clicked block itself, into it, or beside it.
    if (auto state = grown(p, request.against, true)) {
        VX_TRY(p.view.set(request.against, *state));
        return finished(p, bodies, {request.against});
    }
    if (replaceable(p.view, request.against) && p.view.info_at(request.against).state.name != request.block) {
        p.face = Face::up;
    } else {
        p.target = neighbor(request.against, request.face);
        if (!p.view.editable(p.target)) return fail(ErrorCode::not_found, "the place is not loaded");
        if (auto state = grown(p, p.target, false)) {
            VX_TRY(p.view.set(p.target, *state));
            return finished(p, bodies, {p.target});
        }
        if (!replaceable(p.view, p.target)) return fail(ErrorCode::denied, "the place is taken");
    }

    if (const std::string wall = wall_form(registry, request.block); !wall.empty() && is_side(p.face)) {
        p.def = &registry.blocks()[std::size_t(registry.find_block(wall))];
        p.state.name = wall;
    }
    for (const PropertyDef& property : p.def->properties)
        p.state.set(property.name, property.default_value);
    choose_state(p);
    if (p.def->look.shape == ShapeKind::chest && p.has("type") && !request.sneaking) VX_TRY(join_chests(p));
    p.state = connected(p.view, p.target, p.state);
    VX_TRY(p.view.set(p.target, p.state));
    std::vector<BlockPos> changed{p.target};

    // Doors, tall plants and beds bring their other part.
    const StateInfo& placed = p.view.info_at(p.target);
    if (const auto other = other_part(placed, p.target)) {
        if (!replaceable(p.view, *other)) return fail(ErrorCode::denied, "there is no room for the whole of it");
        BlockState second = placed.state;
        if (const std::string_view half = second.get("half"); half == "lower" || half == "upper")
            second.set("half", half == "lower" ? "upper" : "lower");
        else
            second.set("part", second.get("part") == "foot" ? "head" : "foot");
        if (has_property(placed, "waterlogged")) second.set("waterlogged", "false");
        VX_TRY(p.view.set(*other, second));
        changed.push_back(*other);
    }
    return finished(p, bodies, std::move(changed));
}

} // namespace vitrail
