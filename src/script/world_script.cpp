#include "script/world_script.h"

#include "lua/sandbox.h"
#include "rules/neighbors.h"
#include "script/land_brush.h"
#include "script/terrain_values.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace vitrail {

using lua::Value;
namespace tv = terrain_values;

namespace {

constexpr std::size_t kTextMost = 500, kWithoutMost = 8, kBiomeAreasMost = 64, kCoversMost = 32, kBlockTextsMost = 4096;
constexpr double kReach = 4096;  // of places, as CanvasLimits has it
constexpr double kFarMost = 1e6; // of a coordinate as it is read; the canvas says what is allowed

tl::unexpected<Error> bad(std::string message) {
    return fail(ErrorCode::invalid_argument, std::move(message));
}

bool is_plain(const std::string& text, std::size_t most) {
    return !text.empty() && text.size() <= most &&
           std::all_of(text.begin(), text.end(), [](char c) { return (unsigned char)c >= ' ' && c != 127; });
}

tv::Read plain_text(std::string& out, std::size_t most) {
    return [&out, most](const Value& value) -> Result<> {
        if (!value.string() || !is_plain(*value.string(), most))
            return bad(fmt::format("expected a line of 1 to {} bytes", most));
        out = *value.string();
        return {};
    };
}

template <std::size_t N>
tv::Read numbers(std::array<double, N>& out, const char* what, double most) {
    return [&out, what, most](const Value& value) -> Result<> {
        const Value::Table* list = value.table();
        bool good = list && list->is_list() && list->entries.size() == N;
        for (std::size_t i = 0; good && i < N; ++i) {
            const Value& v = list->entries[i].second;
            out[i] = v.number();
            good = v.is_number() && std::abs(out[i]) <= most;
        }
        return good ? Result<>{} : bad(fmt::format("expected {}", what));
    };
}

// "effect.key=value" or "key=value", the words as settings have them.
bool is_setting(const std::string& text) {
    const std::size_t equals = text.find('=');
    return is_plain(text, 80) && equals != std::string::npos && equals > 0 && equals + 1 < text.size() &&
           text.find('=', equals + 1) == std::string::npos && std::all_of(text.begin(), text.end(), [](char c) {
               return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_' || c == '.' || c == '=' || c == '-';
           });
}

// The arguments of one call, read in order.
class Arguments {
public:
    Arguments(std::span<const Value> values, const char* form)
        : values_(values)
        , form_(form) {}

    tl::unexpected<Error> wrong(const std::string& what) const {
        return bad(fmt::format("{}: expected {}", what, form_));
    }
    bool more() const { return next_ < values_.size() && !values_[next_].is_nil(); }
    const Value* take() { return next_ < values_.size() ? &values_[next_++] : nullptr; }

    Result<double> number(const char* what) {
        const Value* value = take();
        if (!value || !value->is_number())
            return wrong(fmt::format("{} is {}", what, value ? value->type_name() : "missing"));
        if (!(std::abs(value->number()) <= kFarMost)) return wrong(fmt::format("{} is out of range", what));
        return value->number();
    }
    Result<i32> whole(const char* what) { // rounded down
        VX_TRY_ASSIGN(const double v, number(what));
        return i32(std::floor(v));
    }
    Result<BlockPos> position() {
        VX_TRY_ASSIGN(const i32 x, whole("x"));
        VX_TRY_ASSIGN(const i32 y, whole("y"));
        VX_TRY_ASSIGN(const i32 z, whole("z"));
        return BlockPos{x, y, z};
    }
    Result<BlockBox> box() {
        VX_TRY_ASSIGN(const BlockPos a, position());
        VX_TRY_ASSIGN(const BlockPos b, position());
        return BlockBox{{std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)},
                        {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)}};
    }
    // One radius for all axes or a list of them; at least 0.
    template <std::size_t N>
    Result<std::array<double, N>> radii() {
        const Value* value = take();
        std::array<double, N> out{};
        if (value && value->is_number())
            out.fill(value->number());
        else if (!value || !value->table() || !numbers(out, "", kFarMost)(*value))
            return wrong("radius");
        for (const double r : out)
            if (!(r >= 0 && r <= kFarMost)) return wrong("radius");
        return out;
    }
    // A nil at the end is as good as nothing there.
    Result<> end() const {
        for (std::size_t i = next_; i < values_.size(); ++i)
            if (!values_[i].is_nil()) return wrong("too much");
        return {};
    }

private:
    std::span<const Value> values_;
    const char* form_;
    std::size_t next_ = 0;
};

BlockPos rounded(double x, double y, double z) {
    return {i32(std::floor(x)), i32(std::floor(y)), i32(std::floor(z))};
}

BlockPos rounded_up(double x, double y, double z) {
    return {i32(std::ceil(x)), i32(std::ceil(y)), i32(std::ceil(z))};
}

// Half the chord of an ellipse with half axes r, at `d` from its middle along the other axis.
double half_chord(double r, double other_r, double d) {
    if (other_r == 0) return d == 0 ? r : -1;
    const double rest = 1 - d * d / (other_r * other_r);
    return rest < 0 ? -1 : r * std::sqrt(rest);
}

BlockCanvas::Span span_around(double middle, double half) {
    if (half < 0) return {1, 0};
    return {i32(std::ceil(middle - half - 1e-9)), i32(std::floor(middle + half + 1e-9))};
}

class WorldScript {
public:
    WorldScript(std::shared_ptr<StateTable> states, BiomeTable& biomes, const CanvasLimits& limits)
        : canvas_(DimensionInfo{}, std::move(states), limits)
        , biomes_(biomes) {}

    Result<> world(std::span<const Value> a) {
        std::array<double, 3> spawn{spawn_.x + .5, double(spawn_.y), spawn_.z + .5};
        float yaw = spawn_yaw_;
        int time = int(time_);
        Arguments in(a, "world { name = ..., spawn = {x, y, z}, yaw = degrees, time = 0 to 23999 }");
        const Value* table = in.take();
        VX_TRY(in.end());
        VX_TRY(
            tv::named("world", tv::read_keys(table ? *table : Value{}, {{"name", plain_text(name_, 64)},
                                                                        {"spawn", numbers(spawn, "{x, y, z}", kReach)},
                                                                        {"yaw", tv::number(yaw, -360, 360)},
                                                                        {"time", tv::whole(time, 0, 23999)}})));
        spawn_ = rounded(spawn[0], spawn[1], spawn[2]);
        spawn_yaw_ = yaw;
        time_ = u64(time);
        return {};
    }

    Result<> set(std::span<const Value> a) {
        Arguments in(a, "set(x, y, z, block [, over])");
        VX_TRY_ASSIGN(const BlockPos at, in.position());
        return paint(in, {at, at}, nullptr);
    }

    Result<> fill(std::span<const Value> a) {
        Arguments in(a, "fill(x0, y0, z0, x1, y1, z1, block [, over])");
        VX_TRY_ASSIGN(const BlockBox box, in.box());
        return paint(in, box, nullptr);
    }

    Result<> shell(std::span<const Value> a) {
        Arguments in(a, "shell(x0, y0, z0, x1, y1, z1, block [, over])");
        VX_TRY_ASSIGN(const BlockBox box, in.box());
        VX_TRY_ASSIGN(const StateId state, block(in));
        VX_TRY_ASSIGN(const BrushOver over, over_of(in));
        VX_TRY(in.end());
        for (int axis = 0; axis < 3; ++axis)
            for (const bool far : {false, true}) {
                BlockBox side = box;
                i32 BlockPos::*along = axis == 0 ? &BlockPos::x : axis == 1 ? &BlockPos::y : &BlockPos::z;
                (far ? side.least : side.most).*along = (far ? box.most : box.least).*along;
                VX_TRY(canvas_.fill(side, state, over));
            }
        return {};
    }

    Result<> sphere(std::span<const Value> a) {
        Arguments in(a, "sphere(x, y, z, radius or {rx, ry, rz}, block [, over])");
        VX_TRY_ASSIGN(const double x, in.number("x"));
        VX_TRY_ASSIGN(const double y, in.number("y"));
        VX_TRY_ASSIGN(const double z, in.number("z"));
        VX_TRY_ASSIGN(const auto r, in.radii<3>());
        const auto row = [=](i32 by, i32 bz) {
            const double dy = by - y, dz = bz - z;
            const double v = r[1] > 0 ? dy / r[1] : dy == 0 ? 0 : 2, w = r[2] > 0 ? dz / r[2] : dz == 0 ? 0 : 2;
            const double rest = 1 - v * v - w * w;
            return span_around(x, rest < 0 ? -1 : r[0] * std::sqrt(rest));
        };
        return paint(in, {rounded(x - r[0], y - r[1], z - r[2]), rounded_up(x + r[0], y + r[1], z + r[2])}, row);
    }

    Result<> cylinder(std::span<const Value> a) {
        return upright(a, "cylinder(x, y, z, radius or {rx, rz}, height, block [, over])", false);
    }
    Result<> cone(std::span<const Value> a) {
        return upright(a, "cone(x, y, z, radius or {rx, rz}, height, block [, over])", true);
    }

    Result<> line(std::span<const Value> a) {
        Arguments in(a, "line(x0, y0, z0, x1, y1, z1, block [, over])");
        VX_TRY_ASSIGN(const BlockPos from, in.position());
        VX_TRY_ASSIGN(const BlockPos to, in.position());
        VX_TRY_ASSIGN(const StateId state, block(in));
        VX_TRY_ASSIGN(const BrushOver over, over_of(in));
        VX_TRY(in.end());
        VX_TRY(canvas_.check({from, from}));
        VX_TRY(canvas_.check({to, to}));
        const i32 n = std::max({std::abs(to.x - from.x), std::abs(to.y - from.y), std::abs(to.z - from.z), 1});
        for (i32 i = 0; i <= n; ++i) {
            const double t = double(i) / n;
            VX_TRY(canvas_.set(rounded(from.x + (to.x - from.x) * t + .5, from.y + (to.y - from.y) * t + .5,
                                       from.z + (to.z - from.z) * t + .5),
                               state, over));
        }
        return {};
    }

    Result<> stairs(std::span<const Value> a) {
        Arguments in(a, "stairs(x, y, z, facing, width, count, block [, below])");
        VX_TRY_ASSIGN(const BlockPos at, in.position());
        const Value* way = in.take();
        const auto facing = way && way->string() ? face_named(*way->string()) : std::nullopt;
        if (!facing || *facing == Face::up || *facing == Face::down) return in.wrong("facing");
        VX_TRY_ASSIGN(const i32 width, in.whole("width"));
        VX_TRY_ASSIGN(const i32 count, in.whole("count"));
        if (width < 1 || count < 1 || width > 256 || count > 384) return in.wrong("width 1 to 256 or count 1 to 384");
        const Value* step = in.take();
        if (!step || !step->string()) return in.wrong("block");
        VX_TRY_ASSIGN(BlockState state, parse_block_state(*step->string()));
        state.set("facing", name_of(*facing));
        VX_TRY_ASSIGN(const StateId stair, state_of(state.to_string()));
        std::optional<StateId> below;
        if (in.more()) {
            VX_TRY_ASSIGN(below, block(in));
        }
        VX_TRY(in.end());
        const IVec3 on = kFaceNormal[u8(*facing)], side = kFaceNormal[u8(clockwise(*facing))];
        for (i32 i = 0; i < count; ++i) {
            const BlockPos a0{at.x + on.x * i, at.y + i, at.z + on.z * i};
            const BlockPos b0{a0.x + side.x * (width - 1), a0.y, a0.z + side.z * (width - 1)};
            BlockBox box{{std::min(a0.x, b0.x), a0.y, std::min(a0.z, b0.z)},
                         {std::max(a0.x, b0.x), a0.y, std::max(a0.z, b0.z)}};
            VX_TRY(canvas_.fill(box, stair));
            if (!below || i == 0) continue;
            box.least.y = at.y, box.most.y = a0.y - 1;
            VX_TRY(canvas_.fill(box, *below));
        }
        return {};
    }

    Result<> land(std::span<const Value> a) {
        Arguments in(a,
                     "land { x =, z =, step =, width =, heights = {...}, bottom =, rock =, cover = {...}, water = }");
        const Value* table = in.take();
        VX_TRY(in.end());
        LandBrush land;
        int x = 0, z = 0, step = 8, width = 0, bottom = 0, water = canvas_.info().min_y - 1;
        const int low = canvas_.info().min_y, high = canvas_.info().max_y - 1;
        const auto one = [this](StateId& out) {
            return [this, &out](const Value& value) -> Result<> {
                if (!value.string()) return bad("expected a block");
                VX_TRY_ASSIGN(out, state_of(*value.string()));
                return {};
            };
        };
        const auto heights = [&](const Value& value) -> Result<> {
            return tv::read_list(value, lua::kValueEntriesMost, tv::Read([&](const Value& v) {
                                     return tv::number(land.heights.emplace_back(), low, high)(v);
                                 }));
        };
        const auto cover = [&](const Value& value) -> Result<> {
            LandCover& c = land.covers.emplace_back();
            int depth = 1;
            std::optional<StateId> under;
            VX_TRY(tv::read_keys(value, {{"top", one(c.top), true},
                                         {"under", [&](const Value& v) { return one(under.emplace())(v); }},
                                         {"depth", tv::whole(depth, 1, 64)},
                                         {"above", tv::number(c.above, -1000, 1000)},
                                         {"below", tv::number(c.below, -1000, 1000)},
                                         {"steeper", tv::number(c.steeper, 0, 1000)},
                                         {"flatter", tv::number(c.flatter, 0, 1000)},
                                         {"wander", tv::number(c.wander, 0, 64)}}));
            c.depth = depth;
            c.under = under.value_or(c.top);
            return {};
        };
        VX_TRY_ASSIGN(land.rock, state_of("minecraft:stone"));
        VX_TRY_ASSIGN(land.water, state_of("minecraft:water"));
        constexpr int far = int(kReach);
        VX_TRY(tv::named(
            "land", tv::read_keys(table ? *table : Value{},
                                  {{"x", tv::whole(x, -far, far), true},
                                   {"z", tv::whole(z, -far, far), true},
                                   {"step", tv::whole(step, 1, 64)},
                                   {"width", tv::whole(width, 2, 2048), true},
                                   {"heights", heights, true},
                                   {"bottom", tv::whole(bottom, low, high)},
                                   {"rock", one(land.rock)},
                                   {"water", tv::whole(water, low, high)},
                                   {"cover", [&](const Value& v) { return tv::read_list(v, kCoversMost, cover); }}})));
        if (land.heights.size() % std::size_t(width) != 0 || land.heights.size() / std::size_t(width) < 2 ||
            land.heights.size() / std::size_t(width) > 2048)
            return bad(fmt::format("land: heights: expected 2 to 2048 rows of {} numbers, got {} numbers", width,
                                   land.heights.size()));
        land.x = x, land.z = z, land.step = step, land.width = u32(width), land.bottom = bottom,
        land.water_level = water;
        return paint_land(canvas_, land);
    }

    Result<> biome(std::span<const Value> a) {
        Arguments in(a, "biome(name [, x0, z0, x1, z1])");
        const Value* named = in.take();
        if (!named || !named->string()) return in.wrong("name");
        const std::string name =
            named->string()->find(':') == std::string::npos ? "minecraft:" + *named->string() : *named->string();
        if (canvas_.states().registry().biome_named(name).name != name)
            return bad(fmt::format("there is no biome {}", name.substr(0, 64)));
        BiomeArea area;
        if (in.more()) {
            VX_TRY_ASSIGN(const i32 x0, in.whole("x0"));
            VX_TRY_ASSIGN(const i32 z0, in.whole("z0"));
            VX_TRY_ASSIGN(const i32 x1, in.whole("x1"));
            VX_TRY_ASSIGN(const i32 z1, in.whole("z1"));
            area = {std::min(x0, x1), std::min(z0, z1), std::max(x0, x1), std::max(z0, z1), BiomeId::none};
        }
        VX_TRY(in.end());
        if (areas_.size() >= kBiomeAreasMost)
            return fail(ErrorCode::limit, fmt::format("more than {} areas of biomes", kBiomeAreasMost));
        VX_TRY_ASSIGN(area.biome, biomes_.intern(name));
        areas_.push_back(area);
        return {};
    }

    Result<> station(std::span<const Value> a) {
        Arguments in(
            a, "station { name =, effect =, at = {x, y, z}, look = {yaw, pitch}, fov =, time =, text =, without = }");
        const Value* table = in.take();
        VX_TRY(in.end());
        Station s;
        std::array<double, 2> look{};
        const auto without = [&](const Value& value) -> Result<> {
            const auto one = [&](const Value& v) -> Result<> {
                if (!v.string() || !is_setting(*v.string()))
                    return bad("expected a setting such as \"shadows.on=false\"");
                s.without.push_back(*v.string());
                return {};
            };
            return value.table() ? tv::read_list(value, kWithoutMost, one) : one(value);
        };
        VX_TRY(tv::named("station",
                         tv::read_keys(table ? *table : Value{}, {{"name", tv::word(s.name), true},
                                                                  {"effect", tv::word(s.effect), true},
                                                                  {"at", numbers(s.at, "{x, y, z}", kReach), true},
                                                                  {"look", numbers(look, "{yaw, pitch}", 360), true},
                                                                  {"fov", tv::number(s.fov, 5, 150)},
                                                                  {"time", tv::number(s.time, 0, 24000)},
                                                                  {"text", plain_text(s.text, kTextMost)},
                                                                  {"without", without}})));
        if (std::abs(look[1]) > 90) return bad("station: look: expected a pitch from -90 to 90");
        s.yaw = float(look[0]), s.pitch = float(look[1]);
        if (stations_.size() >= kStationsMost)
            return fail(ErrorCode::limit, fmt::format("more than {} stations", kStationsMost));
        for (const Station& other : stations_)
            if (other.name == s.name) return bad(fmt::format("station: there are two named {}", s.name));
        stations_.push_back(std::move(s));
        return {};
    }

    Result<Value> get(std::span<const Value> a) {
        Arguments in(a, "get(x, y, z)");
        VX_TRY_ASSIGN(const BlockPos at, in.position());
        VX_TRY(in.end());
        VX_TRY(canvas_.check({at, at}));
        return Value{canvas_.states().info(canvas_.get(at)).state.to_string()};
    }

    Result<Value> top(std::span<const Value> a) {
        Arguments in(a, "top(x, z)");
        VX_TRY_ASSIGN(const i32 x, in.whole("x"));
        VX_TRY_ASSIGN(const i32 z, in.whole("z"));
        VX_TRY(in.end());
        VX_TRY(canvas_.charge(64));
        return Value{i64(canvas_.top(x, z))};
    }

    Result<Value> noise(std::span<const Value> a) {
        Arguments in(a, "noise(x, z [, size [, seed [, octaves 1 to 8]]])");
        double size = 1;
        i32 seed = 0, octaves = 1;
        VX_TRY_ASSIGN(const double x, in.number("x"));
        VX_TRY_ASSIGN(const double z, in.number("z"));
        if (in.more()) {
            VX_TRY_ASSIGN(size, in.number("size"));
        }
        if (in.more()) {
            VX_TRY_ASSIGN(seed, in.whole("seed"));
        }
        if (in.more()) {
            VX_TRY_ASSIGN(octaves, in.whole("octaves"));
        }
        VX_TRY(in.end());
        if (!(size >= 1e-3) || octaves < 1 || octaves > 8) return in.wrong("size or octaves");
        return Value{script_noise(x / size, z / size, u64(i64(seed)), u32(octaves))};
    }

    // Errors: those of BlockCanvas::take; a limit that was passed, whatever the script did about it.
    Result<ScriptedWorld> finish() {
        if (canvas_.exceeded()) return tl::unexpected(*canvas_.exceeded());
        VX_TRY_ASSIGN(Dimension dimension, canvas_.take([this](i32 x, i32, i32 z) {
            for (auto area = areas_.rbegin(); area != areas_.rend(); ++area)
                if (x + 3 >= area->x0 && x <= area->x1 && z + 3 >= area->z0 && z <= area->z1) return area->biome;
            return BiomeId::none;
        }));
        return ScriptedWorld{name_, spawn_, spawn_yaw_,          time_, std::move(dimension), std::move(stations_),
                             {},    0,      canvas_.cells_used()};
    }

private:
    struct BiomeArea {
        i32 x0 = INT32_MIN, z0 = INT32_MIN, x1 = INT32_MAX, z1 = INT32_MAX;
        BiomeId biome{};
    };

    // The state of a text, which must be one of the content's, with values that it knows.
    Result<StateId> state_of(const std::string& text) {
        if (const auto known = texts_.find(text); known != texts_.end()) return known->second;
        VX_TRY_ASSIGN(BlockState state, parse_block_state(text));
        StateTable& states = canvas_.states();
        const BlockId id = states.registry().find_block(state.name);
        if (id == BlockId::unknown) return bad(fmt::format("there is no block {}", state.name.substr(0, 100)));
        const BlockDef& def = states.registry().blocks()[u32(id)];
        for (const auto& [name, value] : state.properties) {
            const auto property = std::find_if(def.properties.begin(), def.properties.end(),
                                               [&](const PropertyDef& p) { return p.name == name; });
            if (property == def.properties.end())
                return bad(fmt::format("{} has no property {}", def.name, name.substr(0, 64)));
            if (std::find(property->values.begin(), property->values.end(), value) == property->values.end())
                return bad(fmt::format("{}: {} is one of {}, not {}", def.name, name, fmt::join(property->values, " "),
                                       value.substr(0, 64)));
        }
        VX_TRY_ASSIGN(const StateId made, states.intern_with_defaults(std::move(state)));
        if (texts_.size() >= kBlockTextsMost) texts_.clear();
        return texts_[text] = made;
    }

    Result<StateId> block(Arguments& in) {
        const Value* value = in.take();
        if (!value || !value->string()) return in.wrong("block");
        return state_of(*value->string());
    }

    Result<BrushOver> over_of(Arguments& in) {
        if (!in.more()) return BrushOver{};
        const Value* value = in.take();
        if (!value->string()) return in.wrong("over");
        VX_TRY_ASSIGN(const StateId state, state_of(*value->string()));
        if (value->string()->find('[') != std::string::npos) return BrushOver{BrushOver::state, {}, state};
        return BrushOver{BrushOver::block, canvas_.states().info(state).block, {}};
    }

    // The last arguments, block and over, painted into a body.
    Result<> paint(Arguments& in, const BlockBox& box, const BlockCanvas::RowOf& row) {
        VX_TRY_ASSIGN(const StateId state, block(in));
        VX_TRY_ASSIGN(const BrushOver over, over_of(in));
        VX_TRY(in.end());
        return canvas_.fill_rows(box, row, state, over);
    }

    Result<> upright(std::span<const Value> a, const char* form, bool pointed) {
        Arguments in(a, form);
        VX_TRY_ASSIGN(const double x, in.number("x"));
        VX_TRY_ASSIGN(const i32 y, in.whole("y"));
        VX_TRY_ASSIGN(const double z, in.number("z"));
        VX_TRY_ASSIGN(const auto r, in.radii<2>());
        VX_TRY_ASSIGN(const i32 height, in.whole("height"));
        if (height < 1) return in.wrong("height");
        const auto row = [=](i32 by, i32 bz) {
            const double size = pointed ? 1 - double(by - y) / height : 1;
            return span_around(x, half_chord(r[0] * size, r[1] * size, bz - z));
        };
        const BlockPos least = rounded(x - r[0], y, z - r[1]), most = rounded_up(x + r[0], y, z + r[1]);
        return paint(in, {least, {most.x, y + height - 1, most.z}}, row);
    }

    BlockCanvas canvas_;
    BiomeTable& biomes_;
    std::string name_ = "World";
    BlockPos spawn_{0, 64, 0};
    float spawn_yaw_ = 0;
    u64 time_ = 1000;
    std::unordered_map<std::string, StateId> texts_;
    std::vector<BiomeArea> areas_;
    std::vector<Station> stations_;
};

} // namespace

Result<ScriptedWorld> run_world_script(std::string_view text, const std::string& name,
                                       std::shared_ptr<StateTable> states, BiomeTable& biomes,
                                       const WorldScriptLimits& limits) {
    lua::SandboxLimits sandbox_limits;
    sandbox_limits.instructions_most = limits.instructions_most;
    sandbox_limits.memory_bytes_most = limits.memory_bytes_most;
    sandbox_limits.cpu_seconds_most = limits.cpu_seconds_most;
    WorldScript script(std::move(states), biomes, limits.canvas); // outlives the sandbox, which calls it
    VX_TRY_ASSIGN(auto sandbox, lua::Sandbox::create(sandbox_limits));
    const auto give = [&](const char* word, Result<> (WorldScript::*function)(std::span<const Value>)) {
        sandbox->set_function(word, [&script, function](std::span<const Value> a) { return (script.*function)(a); });
    };
    const auto answer = [&](const char* word, Result<Value> (WorldScript::*function)(std::span<const Value>)) {
        sandbox->set_query(word, [&script, function](std::span<const Value> a) { return (script.*function)(a); });
    };
    give("world", &WorldScript::world);
    give("set", &WorldScript::set);
    give("fill", &WorldScript::fill);
    give("shell", &WorldScript::shell);
    give("sphere", &WorldScript::sphere);
    give("cylinder", &WorldScript::cylinder);
    give("cone", &WorldScript::cone);
    give("line", &WorldScript::line);
    give("stairs", &WorldScript::stairs);
    give("land", &WorldScript::land);
    give("biome", &WorldScript::biome);
    give("station", &WorldScript::station);
    answer("get", &WorldScript::get);
    answer("top", &WorldScript::top);
    answer("noise", &WorldScript::noise);
    VX_TRY(sandbox->run(text, name));
    Result<ScriptedWorld> world = script.finish();
    if (!world) return fail(world.error().code, name + ": " + world.error().message);
    world->output = sandbox->output();
    world->instructions = sandbox->instructions_used();
    return world;
}

} // namespace vitrail
