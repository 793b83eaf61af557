#include "rules/neighbors.h"

#include <algorithm>
#include <array>

namespace vitrail {

namespace {

constexpr const char* kFaceNames[6] = {"west", "east", "down", "up", "north", "south"};
constexpr Face kSides[4] = {Face::north, Face::east, Face::south, Face::west};

int axis_of(Face f) {
    return int(f) / 2;
}

// Whether the boxes that reach `face` cover the rectangle lo..hi (1/64, both other axes) of it.
bool covers(const BlockShape& shape, Face face, i32 lo, i32 hi) {
    const int a = axis_of(face), u = (a + 1) % 3, v = (a + 2) % 3;
    const bool far = int(face) % 2 == 1;
    // Box edges cut the rectangle into pieces; each must lie in some box.
    std::vector<i32> cuts[2] = {{lo, hi}, {lo, hi}};
    std::vector<const ShapeBox*> reaching;
    for (const ShapeBox& b : shape.collision) {
        if (far ? b.max[a] < kShapeUnit : b.min[a] > 0) continue;
        reaching.push_back(&b);
        for (int k = 0; k < 2; ++k)
            for (const i32 c : {i32(b.min[k ? v : u]), i32(b.max[k ? v : u])})
                if (c > lo && c < hi) cuts[k].push_back(c);
    }
    for (auto& list : cuts)
        std::sort(list.begin(), list.end());
    for (std::size_t i = 0; i + 1 < cuts[0].size(); ++i)
        for (std::size_t j = 0; j + 1 < cuts[1].size(); ++j) {
            const i32 p = cuts[0][i], q = cuts[1][j];
            if (p == cuts[0][i + 1] || q == cuts[1][j + 1]) continue;
            if (std::none_of(reaching.begin(), reaching.end(), [&](const ShapeBox* b) {
                    return b->min[u] <= p && b->max[u] > p && b->min[v] <= q && b->max[v] > q;
                }))
                return false;
        }
    return true;
}

bool is_plant(const StateInfo& info) {
    return (info.look->shape == ShapeKind::cross || info.look->shape == ShapeKind::crop) && info.look->viscosity == 0;
}

Face facing_of(const StateInfo& info) {
    return face_named(info.state.get("facing")).value_or(Face::north);
}

// ---- joining ----

bool joins(const StateInfo& self, const StateInfo& other, Face toward) {
    const ShapeKind mine = self.look->shape, theirs = other.look->shape;
    if (theirs == ShapeKind::fence_gate && mine != ShapeKind::pane) return axis_of(facing_of(other)) != axis_of(toward);
    if (mine == ShapeKind::fence && theirs == ShapeKind::fence) return self.look->material == other.look->material;
    if (mine == ShapeKind::pane && (theirs == ShapeKind::pane || theirs == ShapeKind::wall)) return true;
    if (mine == ShapeKind::wall && (theirs == ShapeKind::wall || theirs == ShapeKind::pane)) return true;
    if (theirs == ShapeKind::fence || theirs == ShapeKind::wall || theirs == ShapeKind::pane) return false;
    if (other.look->material == "leaves") return false;
    return is_sturdy(other.shape, opposite(toward));
}

BlockState with_arms(const EditView& view, BlockPos at, BlockState state, const StateInfo& self) {
    const bool tall_above = is_sturdy(view.info_at(neighbor(at, Face::up)).shape, Face::down) ||
                            view.info_at(neighbor(at, Face::up)).look->shape == ShapeKind::wall;
    bool arm[4];
    for (int i = 0; i < 4; ++i) {
        const char* name = name_of(kSides[i]);
        arm[i] = joins(self, view.info_at(neighbor(at, kSides[i])), kSides[i]);
        const std::string_view old = state.get(name);
        const bool boolean = old == "true" || old == "false" || self.look->shape != ShapeKind::wall;
        state.set(name, boolean ? (arm[i] ? "true" : "false") : !arm[i] ? "none" : tall_above ? "tall" : "low");
    }
    if (self.look->shape == ShapeKind::wall && !state.get("up").empty()) {
        const bool straight = arm[0] == arm[2] && arm[1] == arm[3] && arm[0] != arm[1];
        const StateInfo& above = view.info_at(neighbor(at, Face::up));
        const bool carries = !above.shape.collision.empty() || above.look->shape == ShapeKind::torch;
        state.set("up", !straight || (carries && above.look->shape != ShapeKind::wall) ? "true" : "false");
    }
    return state;
}

// Corners of stairs: round an outer corner by what is in front, into an inner one by what is behind.
BlockState with_corner(const EditView& view, BlockPos at, BlockState state) {
    const Face facing = face_named(state.get("facing")).value_or(Face::north);
    const std::string half(state.get("half", "bottom"));
    const auto stairs_at = [&](Face toward) -> const StateInfo* {
        const StateInfo& info = view.info_at(neighbor(at, toward));
        return info.look->shape == ShapeKind::stairs && info.state.get("half", "bottom") == half ? &info : nullptr;
    };
    // Stairs beside it that go on in the same way keep it straight.
    const auto goes_on = [&](Face toward) {
        const StateInfo* info = stairs_at(toward);
        return info && facing_of(*info) == facing;
    };
    std::string_view shape = "straight";
    const StateInfo *front = stairs_at(facing), *back = stairs_at(opposite(facing));
    if (front && axis_of(facing_of(*front)) != axis_of(facing) && !goes_on(opposite(facing_of(*front))))
        shape = facing_of(*front) == counterclockwise(facing) ? "outer_left" : "outer_right";
    else if (back && axis_of(facing_of(*back)) != axis_of(facing) && !goes_on(facing_of(*back)))
        shape = facing_of(*back) == counterclockwise(facing) ? "inner_left" : "inner_right";
    state.set("shape", shape);
    return state;
}

BlockState with_track(const EditView& view, BlockPos at, BlockState state, const StateInfo& self) {
    const auto is_rail = [&](BlockPos p) { return view.info_at(p).look->shape == ShapeKind::rail; };
    bool any[4], up[4];
    for (int i = 0; i < 4; ++i) {
        const BlockPos p = neighbor(at, kSides[i]);
        up[i] = is_rail(neighbor(p, Face::up));
        any[i] = up[i] || is_rail(p) || is_rail(neighbor(p, Face::down));
    }
    const auto allowed = [&](const char* value) {
        for (const PropertyDef& p : view.states().registry().blocks()[std::size_t(self.block)].properties)
            if (p.name == "shape") return std::find(p.values.begin(), p.values.end(), value) != p.values.end();
        return false;
    };
    const bool along_z = any[0] || any[2], along_x = any[1] || any[3];
    const char* shape = nullptr;
    if (along_z && along_x && !(any[0] && any[2]) && !(any[1] && any[3])) {
        shape = any[2] ? (any[1] ? "south_east" : "south_west") : (any[1] ? "north_east" : "north_west");
        if (!allowed(shape)) shape = nullptr;
    }
    if (!shape && along_z && !(along_x && any[1] && any[3]))
        shape = up[0] ? "ascending_north" : up[2] ? "ascending_south" : "north_south";
    if (!shape && along_x) shape = up[1] ? "ascending_east" : up[3] ? "ascending_west" : "east_west";
    if (shape && allowed(shape)) state.set("shape", shape);
    return state;
}

} // namespace

StateId EditView::id_at(BlockPos at) const {
    const auto it = pending_.find(at);
    return it != pending_.end() ? it->second : dimension_.contains(at) ? dimension_.state_at(at) : StateId::air;
}

Result<> EditView::set(BlockPos at, const BlockState& state) {
    VX_TRY_ASSIGN(const StateId id, states().intern_with_defaults(state));
    if (pending_.insert_or_assign(at, id).second) order_.push_back(at);
    return {};
}

EditBatch EditView::batch() const {
    EditBatch out;
    for (const BlockPos at : order_)
        if (const StateId id = pending_.at(at); id != dimension_.state_at(at)) out.edits.push_back({at, id});
    return out;
}

bool has_property(const StateInfo& info, std::string_view property) {
    return !info.state.get(property).empty();
}

std::optional<Face> face_named(std::string_view name) {
    for (int i = 0; i < 6; ++i)
        if (name == kFaceNames[i]) return Face(i);
    return std::nullopt;
}

const char* name_of(Face face) {
    return kFaceNames[int(face)];
}

Face clockwise(Face f) {
    switch (f) {
    case Face::north:
        return Face::east;
    case Face::east:
        return Face::south;
    case Face::south:
        return Face::west;
    case Face::west:
        return Face::north;
    default:
        return f;
    }
}

Face counterclockwise(Face f) {
    return f == Face::up || f == Face::down ? f : opposite(clockwise(f));
}

bool is_sturdy(const BlockShape& shape, Face face) {
    return shape.full_cube || covers(shape, face, 0, kShapeUnit);
}

bool holds_center(const BlockShape& shape, Face face) {
    return shape.full_cube || covers(shape, face, kShapeUnit * 7 / 16, kShapeUnit * 9 / 16);
}

std::optional<BlockPos> other_part(const StateInfo& info, BlockPos at) {
    const std::string_view half = info.state.get("half"), part = info.state.get("part");
    if (half == "upper") return neighbor(at, Face::down);
    if (half == "lower") return neighbor(at, Face::up);
    if (info.look->shape == ShapeKind::bed && !part.empty()) {
        const Face facing = facing_of(info);
        return neighbor(at, part == "foot" ? facing : opposite(facing));
    }
    return std::nullopt;
}

bool belong_together(const StateInfo& info, const StateInfo& other) {
    const char* property = has_property(info, "part") ? "part" : "half";
    return info.state.name == other.state.name && has_property(other, property) &&
           info.state.get(property) != other.state.get(property);
}

bool is_supported(const EditView& view, BlockPos at) {
    const StateInfo& info = view.info_at(at);
    if (info.block == BlockId::unknown) return true; // blocks we do not know keep as they came
    const auto next_to = [&](Face f) -> const StateInfo& { return view.info_at(neighbor(at, f)); };
    // Nothing is known of what lies in chunks that are not there: it may well hold.
    const auto known = [&](Face f) {
        return view.editable(neighbor(at, f)) || !view.dimension().contains(neighbor(at, f));
    };
    const auto stands = [&] { return !known(Face::down) || is_sturdy(next_to(Face::down).shape, Face::up); };
    const auto carried = [&](Face f) { return !known(f) || is_sturdy(next_to(f).shape, opposite(f)); };
    const auto centered = [&](Face f) { return !known(f) || holds_center(next_to(f).shape, opposite(f)); };
    const auto whole = [&] {
        const auto other = other_part(info, at);
        return !other || !view.editable(*other) || belong_together(info, view.info_at(*other));
    };
    switch (info.look->shape) {
    case ShapeKind::torch:
    case ShapeKind::sign:
        return centered(Face::down);
    case ShapeKind::wall_torch:
    case ShapeKind::wall_sign:
    case ShapeKind::ladder:
        return carried(opposite(facing_of(info)));
    case ShapeKind::lantern:
        return info.state.get("hanging") == "true" ? centered(Face::up) : centered(Face::down);
    case ShapeKind::button:
    case ShapeKind::lever: {
        const std::string_view face = info.state.get("face", "wall");
        return carried(face == "floor" ? Face::down : face == "ceiling" ? Face::up : opposite(facing_of(info)));
    }
    case ShapeKind::rail:
    case ShapeKind::pressure_plate:
        return !known(Face::down) || holds_center(next_to(Face::down).shape, Face::up);
    case ShapeKind::layers:
        return stands();
    case ShapeKind::carpet:
        return !known(Face::down) || !(view.states().flags(view.id_at(neighbor(at, Face::down))) & kAirLike);
    case ShapeKind::lily_pad:
        return !known(Face::down) || !(view.states().flags(view.id_at(neighbor(at, Face::down))) & kAirLike);
    case ShapeKind::door:
        return whole() && (info.state.get("half") == "upper" || stands());
    case ShapeKind::bed:
        return whole();
    case ShapeKind::cross:
    case ShapeKind::crop:
        if (!is_plant(info)) return true;
        if (!whole()) return false;
        if (info.state.get("half") == "upper") return true;
        // From the ground, on its own kind, or hanging.
        return centered(Face::down) || is_plant(next_to(Face::down)) || centered(Face::up) ||
               is_plant(next_to(Face::up)) || (has_property(info, "facing") && carried(opposite(facing_of(info))));
    case ShapeKind::faces: {
        bool any = false;
        for (int f = 0; f < 6; ++f)
            if (info.state.get(kFaceNames[f]) == "true") any |= carried(Face(f));
        return any || next_to(Face::up).state.name == info.state.name;
    }
    default:
        return true;
    }
}

BlockState connected(const EditView& view, BlockPos at, BlockState state) {
    const auto id = view.states().intern_with_defaults(state);
    if (!id) return state;
    const StateInfo& self = view.states().info(*id);
    switch (self.look->shape) {
    case ShapeKind::fence:
    case ShapeKind::wall:
    case ShapeKind::pane:
        return has_property(self, "north") ? with_arms(view, at, self.state, self) : state;
    case ShapeKind::stairs:
        return has_property(self, "shape") ? with_corner(view, at, self.state) : state;
    case ShapeKind::rail:
        return with_track(view, at, self.state, self);
    case ShapeKind::fence_gate:
        if (has_property(self, "in_wall")) {
            const Face side = clockwise(facing_of(self));
            const bool in_wall = view.info_at(neighbor(at, side)).look->shape == ShapeKind::wall ||
                                 view.info_at(neighbor(at, opposite(side))).look->shape == ShapeKind::wall;
            state.set("in_wall", in_wall ? "true" : "false");
        }
        return state;
    default:
        break;
    }
    if (has_property(self, "snowy")) {
        const StateInfo& above = view.info_at(neighbor(at, Face::up));
        state.set("snowy", above.look->material == "snow" || above.look->shape == ShapeKind::layers ? "true" : "false");
    }
    return state;
}

BlockState remains_of(const StateInfo& info) {
    if (info.in_water) return {"minecraft:water", {{"level", "0"}}};
    return {"minecraft:air", {}};
}

Result<> settle(EditView& view, std::vector<BlockPos> changed) {
    // Falling first: what falls changes what joins.
    for (std::size_t i = 0; i < changed.size(); ++i)
        for (int f = 0; f < 6; ++f) {
            const BlockPos at = neighbor(changed[i], Face(f));
            if (!view.editable(at) || view.id_at(at) == StateId::air || is_supported(view, at)) continue;
            VX_TRY(view.set(at, remains_of(view.info_at(at))));
            changed.push_back(at);
            if (changed.size() > kSettleMost) return fail(ErrorCode::limit, "too much hangs on this block");
        }
    for (const BlockPos at : changed)
        for (int f = 0; f < 6; ++f) {
            // Rails also join one step up and down.
            const BlockPos side = neighbor(at, Face(f));
            for (const BlockPos p : {side, neighbor(side, Face::up), neighbor(side, Face::down)}) {
                if (!view.editable(p)) continue;
                const StateInfo& info = view.info_at(p);
                if (info.block == BlockId::unknown || (!(p == side) && info.look->shape != ShapeKind::rail)) continue;
                BlockState joined = connected(view, p, info.state);
                if (!(joined == info.state)) VX_TRY(view.set(p, joined));
            }
        }
    return {};
}

} // namespace vitrail
