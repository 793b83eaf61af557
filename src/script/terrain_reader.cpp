#include "script/terrain_reader.h"

#include "script/terrain_values.h"
#include "terrain/tables.h"
#include "world/block_state.h"

#include <algorithm>
#include <fmt/format.h>

namespace vitrail {

using lua::Value;
using namespace terrain_values;

namespace {

// The same kind of bound as that of the tables, so that a script that adds rows without end is told so where it stands.
constexpr std::size_t kLayersMost = kStrataMost + kLooseMost, kRulesOfOneMost = 24, kBandsMost = 32,
                      kColumnLayersMost = 8;

const Value kNothing;

const Value& argument(std::span<const Value> arguments, std::size_t i) {
    return i < arguments.size() ? arguments[i] : kNothing;
}

tl::unexpected<Error> bad(std::string message) {
    return fail(ErrorCode::invalid_argument, std::move(message));
}

// Puts a row in the place of the one with its name, or behind the last. Errors: limit.
template <class T>
Result<> put(std::vector<T>& rows, T row, std::size_t most, const char* what) {
    for (T& old : rows)
        if (old.name == row.name) {
            old = std::move(row);
            return {};
        }
    if (rows.size() >= most) return fail(ErrorCode::limit, fmt::format("more than {} {}", most, what));
    rows.push_back(std::move(row));
    return {};
}

template <class T>
Read list_of(std::vector<T>& rows, std::size_t most, const char* what, Result<T> (*read)(const Value&)) {
    return [&rows, most, what, read](const Value& list) {
        return read_list(list, most, [&](const Value& value) -> Result<> {
            VX_TRY_ASSIGN(T row, read(value));
            return put(rows, std::move(row), most, what);
        });
    };
}

Result<TerrainDescription::Field> read_field(const Value& value) {
    TerrainDescription::Field field;
    VX_TRY(read_keys(value, {{"name", word(field.name), true}, {"noise", expression(field.noise), true}}));
    return field;
}

Result<TerrainDescription::Attribute> read_attribute(const Value& value) {
    TerrainDescription::Attribute a;
    VX_TRY(read_keys(value, {{"name", word(a.name), true},
                             {"field", word(a.field), true},
                             {"low", number(a.low, -100, 100), true},
                             {"high", number(a.high, -100, 100), true}}));
    return a;
}

Result<TerrainDescription::CaveAttribute> read_cave_attribute(const Value& value) {
    TerrainDescription::CaveAttribute a;
    VX_TRY(read_keys(value, {{"name", word(a.name), true},
                             {"offset", expression(a.offset)},
                             {"by_depth", flag(a.by_depth)},
                             {"low", number(a.low, -1000, 1000), true},
                             {"high", number(a.high, -1000, 1000), true}}));
    return a;
}

Result<TerrainDescription::SurfaceRule> read_rule(const Value& value) {
    TerrainDescription::SurfaceRule rule;
    VX_TRY(read_keys(value, {{"from", block_set(rule.from), true},
                             {"above", expression(rule.above)},
                             {"below", expression(rule.below)},
                             {"depth", whole(rule.depth, 0, 32)},
                             {"chance", number(rule.chance, 0, 1)},
                             {"to", block(rule.to)},
                             {"bands", blocks(rule.bands, kBandsMost)}}));
    if (rule.to.empty() == rule.bands.empty()) return bad("expected either to or bands");
    if (!rule.bands.empty() && rule.above.empty()) return bad("bands are counted from above, which is missing");
    return rule;
}

Result<TerrainDescription::CaveRule> read_cave_rule(const Value& value) {
    TerrainDescription::CaveRule rule;
    VX_TRY(read_keys(value, {{"place", word_of(rule.place, kCavePlaces), true},
                             {"from", block_set(rule.from), true},
                             {"to", block(rule.to), true},
                             {"depth", whole(rule.depth, 1, kCaveRuleDepthMost)},
                             {"chance", number(rule.chance, 0, 1)},
                             {"vein", expression(rule.vein)},
                             {"vein_width", number(rule.vein_width, 0, 1)}}));
    return rule;
}

template <class T>
Read rules_of(std::vector<T>& rules, Result<T> (*read)(const Value&)) {
    return [&rules, read](const Value& list) {
        return read_list(list, kRulesOfOneMost, [&](const Value& value) -> Result<> {
            VX_TRY_ASSIGN(T rule, read(value));
            rules.push_back(std::move(rule));
            return {};
        });
    };
}

// "features: vitrail:palm"
std::string row_name(const char* what, std::string_view name) {
    return name.empty() ? std::string(what) : fmt::format("{} {}", what, name);
}

Result<std::string> read_row_name(std::span<const Value> arguments, const char* what, bool space) {
    std::string out;
    const Read read = space ? name(out, "a name such as \"vitrail:mesa\"") : word(out);
    VX_TRY(named(what, read(argument(arguments, 0))));
    return out;
}

} // namespace

Result<> TerrainReader::define_terrain(std::span<const Value> arguments) {
    any_ = true;
    TerrainDescription& d = description_;
    TerrainDescription next = d;
    const Read warp = [&](const Value& value) -> Result<> {
        if (!value.table() || !value.table()->is_list() || value.table()->entries.size() != 2)
            return bad("expected two expressions, for x and z");
        VX_TRY(named("[1]", expression(next.warp_x)(value.table()->entries[0].second)));
        return named("[2]", expression(next.warp_z)(value.table()->entries[1].second));
    };
    VX_TRY(named("terrain",
                 read_keys(argument(arguments, 0),
                           {{"warp", warp},
                            {"fields", list_of(next.fields, kAttributesMost, "fields", read_field)},
                            {"attributes", list_of(next.attributes, kAttributesMost, "attributes", read_attribute)},
                            {"cave_attributes",
                             list_of(next.cave_attributes, kAttributesMost, "cave attributes", read_cave_attribute)},
                            {"materials", numbers(next.materials, 0, 100)}})));
    d = std::move(next);
    return {};
}

Result<> TerrainReader::define_layer(std::span<const Value> arguments) {
    any_ = true;
    TerrainDescription::Layer layer;
    VX_TRY_ASSIGN(layer.name, read_row_name(arguments, "terrain layer", false));
    std::string over;
    const std::string row = row_name("terrain layer", layer.name);
    VX_TRY(named(row, read_keys(argument(arguments, 1), {{"block", block(layer.block), true},
                                                         {"thickness", number(layer.thickness, 0, 384)},
                                                         {"loose", flag(layer.loose)},
                                                         {"amplitude", number(layer.amplitude, 0, 384)},
                                                         {"frequency", number(layer.frequency, 0, 0.5)},
                                                         {"hung", flag(layer.hung)},
                                                         {"remainder", flag(layer.remainder)},
                                                         {"repose", number(layer.repose_degrees, 1, 89)},
                                                         {"steepest", number(layer.steepest, 0.01, 100)},
                                                         {"over", word(over)}})));
    if (layer.loose && (layer.hung || layer.remainder))
        return bad(row + ": what is loose neither hangs nor takes the remainder");
    if (!layer.loose && layer.amplitude > 0 && layer.frequency == 0)
        return bad(row + ": amplitude: there is no frequency");
    std::vector<TerrainDescription::Layer>& layers = description_.layers;
    if (over.empty()) return named(row, put(layers, std::move(layer), kLayersMost, "layers"));
    std::erase_if(layers, [&](const auto& old) { return old.name == layer.name; });
    const auto below = std::find_if(layers.begin(), layers.end(), [&](const auto& l) { return l.name == over; });
    if (below == layers.end()) return bad(fmt::format("{}: over: there is no layer {}", row, over));
    if (layers.size() >= kLayersMost)
        return fail(ErrorCode::limit, fmt::format("{}: more than {} layers", row, kLayersMost));
    layers.insert(below + 1, std::move(layer));
    return {};
}

Result<> TerrainReader::define_biome(std::span<const Value> arguments) {
    any_ = true;
    TerrainDescription::Biome biome;
    VX_TRY_ASSIGN(biome.name, read_row_name(arguments, "terrain biome", true));
    const std::string row = row_name("terrain biome", biome.name);
    VX_TRY(named(row, read_keys(argument(arguments, 1), {{"wants", wants(biome.wants), true},
                                                         {"height", expression(biome.height), true},
                                                         {"materials", numbers(biome.materials, 0, 100)},
                                                         {"rules", rules_of(biome.rules, read_rule)}})));
    return named(row, put(description_.biomes, std::move(biome), kBiomesMost, "biomes"));
}

Result<> TerrainReader::define_cave_biome(std::span<const Value> arguments) {
    any_ = true;
    TerrainDescription::CaveBiome biome;
    VX_TRY_ASSIGN(biome.name, read_row_name(arguments, "cave biome", true));
    const std::string row = row_name("cave biome", biome.name);
    VX_TRY(named(row, read_keys(argument(arguments, 1), {{"wants", wants(biome.wants), true},
                                                         {"rules", rules_of(biome.rules, read_cave_rule)}})));
    return named(row, put(description_.cave_biomes, std::move(biome), kCaveBiomesMost, "cave biomes"));
}

Result<> TerrainReader::define_feature(std::span<const Value> arguments) {
    any_ = true;
    TerrainDescription::Feature f;
    VX_TRY_ASSIGN(f.name, read_row_name(arguments, "terrain feature", true));
    const std::string row = row_name("terrain feature", f.name);
    VX_TRY(named(row, read_keys(argument(arguments, 1), {{"shape", word(f.shape), true},
                                                         {"place", word_of(f.place, kFeaturePlaces)},
                                                         {"biome", name(f.biome, "a biome's name"), true},
                                                         {"cell", whole(f.cell, 1, 1024), true},
                                                         {"padding", whole(f.padding, 0, 512)},
                                                         {"chance", number(f.chance, 0, 1)},
                                                         {"layers", words(f.layers)},
                                                         {"least_thickness", number(f.least_thickness, 0, 384)},
                                                         {"lowest_y", whole(f.lowest_y, kTerrainMinY, kTerrainMaxY)},
                                                         {"highest_y", whole(f.highest_y, kTerrainMinY, kTerrainMaxY)},
                                                         {"least_height", whole(f.least_height, 0, kTerrainHeight)},
                                                         {"water_depth", whole(f.water_depth, 0, kTerrainSeaLevel)},
                                                         {"numbers", numbers(f.numbers, -1000, 1000)},
                                                         {"blocks", named_blocks(f.blocks)}})));
    if (2 * f.padding >= f.cell) return bad(fmt::format("{}: padding: nothing is left of the cell", row));
    if (f.lowest_y > f.highest_y) return bad(fmt::format("{}: lowest_y is above highest_y", row));
    if (f.layers.size() > kColumnLayersMost)
        return bad(fmt::format("{}: layers: more than {}", row, kColumnLayersMost));
    return named(row, put(description_.features, std::move(f), kFeaturesMost, "features"));
}

Result<> TerrainReader::define_decorator(std::span<const Value> arguments) {
    any_ = true;
    TerrainDescription::Decorator d;
    d.on = {"ground"};
    VX_TRY(named("decorator", read_keys(argument(arguments, 0), {{"biome", name(d.biome, "a biome's name"), true},
                                                                 {"place", word_of(d.place, kDecoratorPlaces)},
                                                                 {"block", block(d.block), true},
                                                                 {"upper", block(d.upper)},
                                                                 {"chance", number(d.chance, 0, 1), true},
                                                                 {"on", block_set(d.on)}})));
    for (TerrainDescription::Decorator& old : description_.decorators)
        if (old.biome == d.biome && old.place == d.place && old.block == d.block) {
            old = std::move(d);
            return {};
        }
    if (description_.decorators.size() >= kDecoratorsMost)
        return fail(ErrorCode::limit,
                    fmt::format("decorator of {}: more than {} decorators", d.biome, kDecoratorsMost));
    description_.decorators.push_back(std::move(d));
    return {};
}

namespace {

// What rows say of one another and of blocks.
class References {
public:
    References(const TerrainDescription& d, const BlockRegistry& registry)
        : d_(d)
        , registry_(registry) {}

    Result<> check() const {
        for (const auto& a : d_.attributes)
            if (!has(d_.fields, a.field))
                return bad(fmt::format("terrain attribute {}: there is no field {}", a.name, a.field));
        VX_TRY(materials("terrain", d_.materials));
        for (const auto& layer : d_.layers)
            VX_TRY(named(row_name("terrain layer", layer.name), block_there(layer.block)));
        for (const auto& biome : d_.biomes) {
            const std::string row = row_name("terrain biome", biome.name);
            VX_TRY(wants(row, biome.wants, d_.attributes.size()));
            VX_TRY(materials(row, biome.materials));
            for (std::size_t i = 0; i < biome.rules.size(); ++i) {
                const auto& rule = biome.rules[i];
                const std::string rule_row = fmt::format("{}: rules: [{}]", row, i + 1);
                VX_TRY(named(rule_row, blocks_there(rule.from)));
                VX_TRY(named(rule_row, blocks_there(rule.bands)));
                if (!rule.to.empty()) VX_TRY(named(rule_row, block_there(rule.to)));
            }
        }
        for (const auto& biome : d_.cave_biomes) {
            const std::string row = row_name("cave biome", biome.name);
            VX_TRY(wants(row, biome.wants, d_.cave_attributes.size()));
            for (std::size_t i = 0; i < biome.rules.size(); ++i) {
                const std::string rule_row = fmt::format("{}: rules: [{}]", row, i + 1);
                VX_TRY(named(rule_row, blocks_there(biome.rules[i].from)));
                VX_TRY(named(rule_row, block_there(biome.rules[i].to)));
            }
        }
        for (const auto& f : d_.features) {
            const std::string row = row_name("terrain feature", f.name);
            VX_TRY(biome_there(row, f.biome, f.place.starts_with("cave")));
            for (const std::string& layer : f.layers)
                if (!has(d_.layers, layer)) return bad(fmt::format("{}: layers: there is no layer {}", row, layer));
            for (const auto& [part, block] : f.blocks)
                VX_TRY(named(fmt::format("{}: blocks: {}", row, part), block_there(block)));
        }
        for (const auto& d : d_.decorators) {
            const std::string row = fmt::format("decorator {} of {}", d.block, d.biome);
            VX_TRY(biome_there(row, d.biome, d.place.starts_with("cave")));
            VX_TRY(named(row, block_there(d.block)));
            if (!d.upper.empty()) VX_TRY(named(row, block_there(d.upper)));
            VX_TRY(named(row, blocks_there(d.on)));
        }
        return {};
    }

private:
    template <class T>
    static bool has(const std::vector<T>& rows, std::string_view name) {
        return std::any_of(rows.begin(), rows.end(), [&](const T& row) { return row.name == name; });
    }
    Result<> block_there(const std::string& text) const {
        VX_TRY_ASSIGN(const BlockState state, parse_block_state(text));
        const BlockId id = registry_.find_block(state.name);
        if (id == BlockId::unknown) return bad(fmt::format("there is no block {}", state.name));
        for (const auto& [property, value] : state.properties) {
            const auto& known = registry_.blocks()[std::size_t(id)].properties;
            const auto found =
                std::find_if(known.begin(), known.end(), [&](const PropertyDef& p) { return p.name == property; });
            if (found == known.end() ||
                std::find(found->values.begin(), found->values.end(), value) == found->values.end())
                return bad(fmt::format("block {} has no {}={}", state.name, property, value));
        }
        return {};
    }
    Result<> blocks_there(const std::vector<std::string>& texts) const {
        for (const std::string& text : texts)
            if (!is_block_word(text)) VX_TRY(block_there(text));
        return {};
    }
    Result<> materials(const std::string& row, const std::map<std::string, float>& weights) const {
        for (const auto& [layer, weight] : weights)
            if (!has(d_.layers, layer)) return bad(fmt::format("{}: materials: there is no layer {}", row, layer));
        return {};
    }
    static Result<> wants(const std::string& row, const std::string& signs, std::size_t attributes) {
        if (signs.size() > attributes)
            return bad(fmt::format("{}: wants: {} signs for {} attributes", row, signs.size(), attributes));
        return {};
    }
    Result<> biome_there(const std::string& row, const std::string& biome, bool cave) const {
        if (cave ? !has(d_.cave_biomes, biome) : !has(d_.biomes, biome))
            return bad(fmt::format("{}: there is no {} {}", row, cave ? "cave biome" : "terrain biome", biome));
        return {};
    }

    const TerrainDescription& d_;
    const BlockRegistry& registry_;
};

} // namespace

Result<std::shared_ptr<const TerrainDescription>> TerrainReader::finish(const BlockRegistry& registry) {
    if (!any_) return nullptr;
    VX_TRY(References(description_, registry).check());
    auto out = std::make_shared<TerrainDescription>(std::move(description_));
    description_ = {};
    any_ = false;
    for (auto& biome : out->biomes)
        biome.wants.resize(out->attributes.size(), '.');
    for (auto& biome : out->cave_biomes)
        biome.wants.resize(out->cave_attributes.size(), '.');
    return out;
}

} // namespace vitrail
