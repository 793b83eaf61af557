#include "terrain/compile/compile.h"

#include "terrain/compile/checks.h"
#include "terrain/compile/expression.h"
#include "terrain/compile/names.h"
#include "terrain/compile/shape_info.h"
#include "terrain/tiles.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace vitrail {

namespace {

using namespace compile_detail;

class Compiler {
public:
    Compiler(const TerrainDescription& description, u64 seed)
        : d_(description)
        , out_{std::make_unique<TerrainTables>(), {}, {}, {}, {}}
        , t_(*out_.tables)
        , builder_(t_) {
        t_.seed = seed;
    }

    Result<CompiledTerrain> run() {
        for (const char* name : {"minecraft:air", "minecraft:bedrock", "minecraft:water", "minecraft:lava"})
            out_.block_names.emplace_back(name);
        VX_TRY(fields());
        VX_TRY(attributes());
        VX_TRY(layers());
        VX_TRY(biomes());
        VX_TRY(caves());
        VX_TRY(surface_rules());
        VX_TRY(cave_rules());
        VX_TRY(features());
        VX_TRY(decorators());
        VX_TRY(cave_noises());
        traits();
        t_.blocks = u32(out_.block_names.size());
        return std::move(out_);
    }

private:
    // The index of a block text, new where it is new.
    Result<Block> block(std::string_view row, std::string_view text) {
        const auto fits = [](char c) {
            return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') ||
                   std::string_view("_:/.-[]=,").find(c) != std::string_view::npos;
        };
        if (text.find(':') == std::string_view::npos || text.size() > 200 ||
            !std::all_of(text.begin(), text.end(), fits))
            return wrong(row, fmt::format("block '{}'; expected a state such as minecraft:stone", text.substr(0, 200)));
        int at = index_of(out_.block_names, text);
        if (at < 0) {
            VX_TRY(check_count("blocks", out_.block_names.size() + 1, kBlocksMost));
            at = int(out_.block_names.size());
            out_.block_names.emplace_back(text);
        }
        return Block(at);
    }

    // "ground" (layers and what rules make of them), "rock", "loose", "water", "air", or blocks; none: "ground".
    Result<BlockSet> block_set(std::string_view row, const Names& from) {
        BlockSet set;
        VX_TRY(check_count("blocks in a set", from.size(), kBlocksMost));
        const auto add_all = [&](const BlockSet& more) {
            for (std::size_t i = 0; i < std::size(set.words); ++i)
                set.words[i] |= more.words[i];
        };
        if (from.empty()) add_all(ground_);
        for (const std::string& text : from) {
            if (text == "ground")
                add_all(ground_);
            else if (text == "rock")
                add_all(rock_);
            else if (text == "loose")
                add_all(loose_);
            else if (text == "water")
                set.add(kWater);
            else if (text == "air")
                set.add(kAir);
            else {
                VX_TRY_ASSIGN(const Block b, block(row, text));
                set.add(b);
            }
        }
        return set;
    }

    // Text to program; an empty one is no program.
    Result<Program> expression(std::string_view text, const std::string& owner) {
        if (text.empty()) return Program{};
        return compile_expression(text, owner, builder_);
    }

    RandomKey key(std::string_view purpose, u64 number = 0) const {
        return random_key(t_.seed, purpose_of(purpose, number));
    }
    // How many rows of this purpose stood before: rows that are alike still differ in chance.
    u64 ordinal(const std::string& purpose) {
        const auto n = std::count(purposes_.begin(), purposes_.end(), purpose);
        purposes_.push_back(purpose);
        return u64(n);
    }

    Result<> fields() {
        VX_TRY(check_count("fields", d_.fields.size(), kAttributesMost));
        VX_TRY_ASSIGN(t_.warp_x, expression(d_.warp_x, "warp_x"));
        VX_TRY_ASSIGN(t_.warp_z, expression(d_.warp_z, "warp_z"));
        for (const auto& field : d_.fields) {
            VX_TRY(check_name("field", field.name));
            if (index_of(fields_, field.name) >= 0) return wrong("field " + field.name, "exists already");
            if (field.noise.empty()) return wrong("field " + field.name, "expected noise such as F(.001)");
            VX_TRY_ASSIGN(t_.field[fields_.size()], expression(field.noise, "field " + field.name));
            fields_.push_back(field.name);
        }
        t_.fields = u32(fields_.size());
        return {};
    }

    Result<> attributes() {
        VX_TRY(check_count("attributes", d_.attributes.size(), kAttributesMost));
        Names names;
        for (const auto& attribute : d_.attributes) {
            const std::string row = "attribute " + attribute.name;
            VX_TRY(check_name("attribute", attribute.name));
            if (index_of(names, attribute.name) >= 0) return wrong(row, "exists already");
            const int field = index_of(fields_, attribute.field);
            if (field < 0)
                return wrong(row,
                             fmt::format("field '{}'; expected one of {}", attribute.field, fmt::join(fields_, ", ")));
            VX_TRY(check_edges(row, attribute.low, attribute.high));
            t_.attribute[names.size()] = {u8(field), attribute.low, attribute.high};
            names.push_back(attribute.name);
        }
        t_.attributes = u32(names.size());
        t_.ocean = index_of(names, "ocean");
        builder_.inputs = names;
        builder_.inputs.resize(kInputs);
        return {};
    }

    static Result<> check_edges(std::string_view row, float low, float high) {
        VX_TRY(check_range(row, "low", low, -1e6, 1e6));
        VX_TRY(check_range(row, "high", high, -1e6, 1e6));
        if (std::abs(low - high) < 1e-6f) return wrong(row, "low and high are equal");
        return {};
    }

    Result<> layers() {
        VX_TRY(check_count("layers", d_.layers.size(), kStrataMost + kLooseMost));
        std::vector<const TerrainDescription::Layer*> strata;
        bool remainder = false;
        for (const bool hangs : {false, true})
            for (const auto& layer : d_.layers)
                if (!layer.loose && layer.hung == hangs) strata.push_back(&layer);
        for (const auto& layer : d_.layers) {
            const std::string row = "layer " + layer.name;
            VX_TRY(check_name("layer", layer.name));
            if (std::count_if(d_.layers.begin(), d_.layers.end(), [&](const auto& l) { return l.name == layer.name; }) >
                1)
                return wrong(row, "exists already");
            VX_TRY(check_range(row, "thickness", layer.thickness, 0, kTerrainHeight));
            if (layer.loose && (layer.hung || layer.remainder))
                return wrong(row, "a loose layer neither hangs nor takes what remains");
            if (layer.remainder && (remainder || layer.hung))
                return wrong(row, "only one layer that does not hang takes what remains");
            remainder |= layer.remainder;
        }
        VX_TRY(check_count("strata", strata.size(), kStrataMost));
        if (strata.empty()) return wrong("layers", "expected at least one that is not loose");
        for (const auto* layer : strata) {
            const std::string row = "layer " + layer->name;
            VX_TRY(check_range(row, "amplitude", layer->amplitude, 0, kTerrainHeight));
            StratumRow& s = t_.stratum[strata_.size()];
            const double frequency = layer->amplitude == 0 ? 0.01 : exact_frequency(layer->frequency);
            auto noise = builder_.add_noise(NoiseKind::simplex2, frequency, 5, purpose_of(row));
            if (!noise) return fail(noise.error().code, fmt::format("{}: {}", row, noise.error().message));
            VX_TRY_ASSIGN(s.block, block(row, layer->block));
            s.noise = *noise;
            s.hung = layer->hung ? 1 : 0;
            s.thickness = layer->thickness;
            s.amplitude = layer->amplitude;
            rock_.add(s.block);
            if (layer->remainder) t_.remainder = s.block;
            strata_.push_back(layer->name);
        }
        t_.deepest_stone = t_.stratum[0].block;
        t_.strata = u32(strata_.size());
        for (const auto& layer : d_.layers) {
            if (!layer.loose) continue;
            const std::string row = "layer " + layer.name;
            VX_TRY(check_count("loose layers", loose_names_.size() + 1, kLooseMost));
            VX_TRY(check_range(row, "repose_degrees", layer.repose_degrees, 1, 89));
            VX_TRY(check_range(row, "steepest", layer.steepest, 0.01, 1000));
            LooseRow& l = t_.loose_layer[loose_names_.size()];
            VX_TRY_ASSIGN(l.block, block(row, layer.block));
            l.thickness = layer.thickness;
            l.repose = float(tangent(double(layer.repose_degrees)));
            l.steepest = layer.steepest;
            loose_.add(l.block);
            loose_names_.push_back(layer.name);
        }
        t_.loose = u32(loose_names_.size());
        // Whole passes whose reach stays within the ring of land that a column knows.
        t_.erosion_passes = t_.loose == 0 ? 0 : (u32(kGroundReach) * 16 - 1) / t_.loose;
        ground_ = rock_;
        for (std::size_t i = 0; i < std::size(ground_.words); ++i)
            ground_.words[i] |= loose_.words[i];
        out_.layer_names = strata_;
        out_.layer_names.insert(out_.layer_names.end(), loose_names_.begin(), loose_names_.end());
        for (const auto& [name, weight] : d_.materials)
            VX_TRY(check_material("materials", name, weight));
        return {};
    }

    // A frequency that came as a float, as the double of its shortest text: .0035 and not .00350000010803.
    static double exact_frequency(float f) {
        if (!(f > 0 && f < 1e6f)) return 0;
        return double(u64(double(f) * 1e9 + 0.5)) / 1e9;
    }

    Result<> check_material(std::string_view row, const std::string& name, float weight) const {
        if (index_of(out_.layer_names, name) < 0)
            return wrong(row,
                         fmt::format("material '{}'; expected one of {}", name, fmt::join(out_.layer_names, ", ")));
        return check_range(row, "material " + name, weight, 0, 100);
    }

    // A sign an attribute.
    static Result<> wants(std::string_view row, std::string_view text, std::size_t count, i8* out) {
        if (text.size() != count || text.find_first_not_of("+-.") != std::string_view::npos)
            return wrong(row, fmt::format("wants '{}'; expected {} signs of + - .", text.substr(0, 64), count));
        for (std::size_t i = 0; i < count; ++i)
            out[i] = text[i] == '+' ? i8(1) : text[i] == '-' ? i8(-1) : i8(0);
        return {};
    }

    Result<> biomes() {
        VX_TRY(check_count("biomes", d_.biomes.size(), kBiomesMost));
        if (d_.biomes.empty()) return wrong("biomes", "expected at least one");
        for (const auto& biome : d_.biomes) {
            const std::string row = "biome " + biome.name;
            VX_TRY(check_name("biome", biome.name));
            if (index_of(biomes_, biome.name) >= 0) return wrong(row, "exists already");
            SurfaceBiomeRow& b = t_.biome[biomes_.size()];
            VX_TRY(wants(row, biome.wants, t_.attributes, b.wants));
            if (biome.height.empty()) return wrong(row, "expected a height");
            VX_TRY_ASSIGN(b.height, expression(biome.height, row + " height"));
            for (const auto& [name, weight] : biome.materials)
                VX_TRY(check_material(row, name, weight));
            const auto weight_of = [&](const std::string& layer) {
                if (const auto own = biome.materials.find(layer); own != biome.materials.end()) return own->second;
                const auto usual = d_.materials.find(layer);
                return usual == d_.materials.end() ? 1.0f : usual->second;
            };
            for (std::size_t i = 0; i < strata_.size(); ++i)
                b.strata[i] = weight_of(strata_[i]);
            for (std::size_t i = 0; i < loose_names_.size(); ++i)
                b.loose[i] = weight_of(loose_names_[i]);
            biomes_.push_back(biome.name);
            out_.biome_names.push_back(biome.name);
        }
        t_.biomes = u32(biomes_.size());
        // What follows may ask for the height that comes of it all.
        builder_.inputs[kInputHeight] = "height";
        return {};
    }

    Result<> caves() {
        VX_TRY(check_count("cave attributes", d_.cave_attributes.size(), kAttributesMost));
        VX_TRY(check_count("cave biomes", d_.cave_biomes.size(), kCaveBiomesMost));
        Names names;
        for (const auto& attribute : d_.cave_attributes) {
            const std::string row = "cave attribute " + attribute.name;
            VX_TRY(check_name("cave attribute", attribute.name));
            if (index_of(names, attribute.name) >= 0) return wrong(row, "exists already");
            CaveAttributeRow& a = t_.cave_attribute[names.size()];
            VX_TRY_ASSIGN(a.offset, expression(attribute.offset, row));
            VX_TRY(check_edges(row, attribute.low, attribute.high));
            a.with_depth = attribute.by_depth ? 1.0f : 0.0f;
            a.low = attribute.low;
            a.high = attribute.high;
            names.push_back(attribute.name);
        }
        t_.cave_attributes = u32(names.size());
        for (const auto& biome : d_.cave_biomes) {
            const std::string row = "cave biome " + biome.name;
            VX_TRY(check_name("cave biome", biome.name));
            if (index_of(cave_biomes_, biome.name) >= 0 || index_of(biomes_, biome.name) >= 0)
                return wrong(row, "exists already");
            VX_TRY(wants(row, biome.wants, names.size(), t_.cave_biome[cave_biomes_.size()].wants));
            cave_biomes_.push_back(biome.name);
            out_.biome_names.push_back(biome.name);
        }
        t_.cave_biomes = u32(cave_biomes_.size());
        return {};
    }

    Result<> surface_rules() {
        for (std::size_t i = 0; i < d_.biomes.size(); ++i) {
            for (const auto& rule : d_.biomes[i].rules) {
                VX_TRY(check_count("surface rules", t_.surface_rules + 1, kRulesMost));
                VX_TRY(surface_rule(t_.surface_rule[t_.surface_rules], u8(i), rule));
                ++t_.surface_rules;
            }
        }
        return {};
    }

    Result<> surface_rule(SurfaceRuleRow& r, u8 biome, const TerrainDescription::SurfaceRule& rule) {
        const std::string same =
            fmt::format("biome {} rule to {}", d_.biomes[biome].name, rule.bands.empty() ? rule.to : rule.bands[0]);
        const u64 number = ordinal(same);
        const std::string row = number == 0 ? same : fmt::format("{} ({})", same, number + 1);
        r.biome = biome;
        VX_TRY_ASSIGN(r.from, block_set(row, rule.from));
        VX_TRY_ASSIGN(r.above, expression(rule.above, row + " above"));
        VX_TRY_ASSIGN(r.below, expression(rule.below, row + " below"));
        VX_TRY(check_range(row, "depth", rule.depth, 0, kTerrainHeight));
        VX_TRY(check_range(row, "chance", rule.chance, 0, 1));
        r.depth = i16(rule.depth);
        r.chance = rule.chance;
        r.key = key(same, number);
        if (rule.bands.empty()) {
            VX_TRY_ASSIGN(r.to[0], block(row, rule.to));
        } else {
            VX_TRY(check_count("bands", rule.bands.size(), std::size(r.to)));
            if (!rule.to.empty() || rule.above.empty()) return wrong(row, "bands want `above` and no `to`");
            for (std::size_t i = 0; i < rule.bands.size(); ++i) {
                VX_TRY_ASSIGN(r.to[i], block(row, rule.bands[i]));
            }
            r.bands = u8(rule.bands.size());
        }
        for (u32 i = 0; i < std::max<u32>(r.bands, 1); ++i)
            made_by_rules_.add(r.to[i]);
        return {};
    }

    Result<> cave_rules() {
        for (std::size_t i = 0; i < d_.cave_biomes.size(); ++i) {
            for (const auto& rule : d_.cave_biomes[i].rules) {
                VX_TRY(check_count("cave rules", t_.cave_rules + 1, kRulesMost));
                VX_TRY(cave_rule(t_.cave_rule[t_.cave_rules], u8(i), rule));
                ++t_.cave_rules;
            }
        }
        // From here on "ground" holds what rules made of it too, so that plants may stand on it.
        for (std::size_t i = 0; i < std::size(ground_.words); ++i)
            ground_.words[i] |= made_by_rules_.words[i];
        return {};
    }

    Result<> cave_rule(CaveRuleRow& r, u8 biome, const TerrainDescription::CaveRule& rule) {
        const std::string same =
            fmt::format("cave biome {} rule {} to {}", d_.cave_biomes[biome].name, rule.place, rule.to);
        const u64 number = ordinal(same);
        const std::string row = number == 0 ? same : fmt::format("{} ({})", same, number + 1);
        r.biome = biome;
        VX_TRY_ASSIGN(const u32 place, choice(row, "place", rule.place, kCavePlaces));
        r.place = CavePlace(place);
        VX_TRY_ASSIGN(r.from, block_set(row, rule.from));
        VX_TRY_ASSIGN(r.to, block(row, rule.to));
        VX_TRY(check_range(row, "depth", rule.depth, 1, kCaveRuleDepthMost));
        VX_TRY(check_range(row, "chance", rule.chance, 0, 1));
        r.depth = u8(rule.depth);
        r.chance = rule.chance;
        r.key = key(same, number);
        made_by_rules_.add(r.to);
        if (rule.vein.empty()) return {};
        VX_TRY(check_range(row, "vein_width", rule.vein_width, 0, 2));
        VX_TRY_ASSIGN(const FractalText fractal, parse_fractal(rule.vein, row + " vein"));
        VX_TRY_ASSIGN(const u16 index,
                      noise(row + " vein", number, NoiseKind::simplex3, fractal.frequency, fractal.octaves));
        r.vein = index;
        r.veins = u16(fractal.octaves);
        r.vein_width = rule.vein_width;
        return {};
    }

    template <std::size_t N>
    static Result<u32> choice(std::string_view row, std::string_view what, std::string_view value,
                              const char* const (&names)[N]) {
        for (u32 i = 0; i < N; ++i)
            if (value == names[i]) return i;
        return wrong(row, fmt::format("{} '{}'; expected one of {}", what, value, fmt::join(names, ", ")));
    }
    static Result<u8> row_index(std::string_view row, std::string_view what, const std::string& name,
                                const Names& names) {
        const int at = index_of(names, name);
        if (at < 0) return wrong(row, fmt::format("{} '{}'; expected one of {}", what, name, fmt::join(names, ", ")));
        return u8(at);
    }

    Result<> features() {
        VX_TRY(check_count("features", d_.features.size(), kFeaturesMost));
        for (const auto& feature : d_.features) {
            VX_TRY(check_name("feature", feature.name));
            if (index_of(out_.feature_names, feature.name) >= 0)
                return wrong("feature " + feature.name, "exists already");
            VX_TRY(this->feature(t_.feature[t_.features], feature));
            out_.feature_names.push_back(feature.name);
            ++t_.features;
        }
        return {};
    }

    Result<> feature(FeatureRow& r, const TerrainDescription::Feature& feature) {
        const std::string row = "feature " + feature.name;
        const auto infos = shape_infos();
        const auto info =
            std::find_if(infos.begin(), infos.end(), [&](const ShapeInfo& i) { return feature.shape == i.name; });
        if (info == infos.end()) {
            Names names;
            for (const ShapeInfo& i : infos)
                names.emplace_back(i.name);
            return wrong(row, fmt::format("shape '{}'; expected one of {}", feature.shape, fmt::join(names, ", ")));
        }
        r.shape = Shape(info - infos.begin());
        VX_TRY_ASSIGN(const u32 place, choice(row, "place", feature.place, kFeaturePlaces));
        r.place = FeaturePlace(place);
        const bool cave = r.place == FeaturePlace::cave_floor || r.place == FeaturePlace::cave_ceiling;
        VX_TRY_ASSIGN(r.biome,
                      row_index(row, cave ? "cave biome" : "biome", feature.biome, cave ? cave_biomes_ : biomes_));
        VX_TRY(check_range(row, "cell", feature.cell, 2, 1024));
        VX_TRY(check_range(row, "padding", feature.padding, 0, (feature.cell - 1) / 2));
        VX_TRY(check_range(row, "chance", feature.chance, 0, 1));
        VX_TRY(check_range(row, "least_thickness", feature.least_thickness, 0, kTerrainHeight));
        VX_TRY(check_range(row, "lowest_y", feature.lowest_y, kTerrainMinY, kTerrainMaxY - 1));
        VX_TRY(check_range(row, "highest_y", feature.highest_y, feature.lowest_y, kTerrainMaxY - 1));
        VX_TRY(check_range(row, "least_height", feature.least_height, 0, kTerrainHeight));
        VX_TRY(check_range(row, "water_depth", feature.water_depth, 0, kTerrainSeaLevel));
        VX_TRY(check_range(row, "reach", info->reach, 0, kFeatureReach * 16 - 1));
        VX_TRY(check_range(row, "least bound", info->bound_low, -kTerrainHeight, 0));
        VX_TRY(check_range(row, "greatest bound", info->bound_high, 0, kTerrainHeight));
        r.cell = u16(feature.cell);
        r.padding = u16(feature.padding);
        r.chance = feature.chance;
        r.least_thickness = feature.least_thickness;
        r.lowest_y = i16(feature.lowest_y);
        r.highest_y = i16(feature.highest_y);
        r.least_height = u16(feature.least_height);
        r.water_depth = u16(feature.water_depth);
        r.reach = info->reach;
        r.bound_low = info->bound_low;
        r.bound_high = info->bound_high;
        r.key = key(row);
        for (const std::string& layer : feature.layers) {
            VX_TRY_ASSIGN(const u8 at, row_index(row, "layer", layer, loose_names_));
            r.layers |= 1u << at;
        }
        VX_TRY(numbers(r, row, *info, feature));
        return blocks(r, row, *info, feature);
    }

    static Result<> numbers(FeatureRow& r, const std::string& row, const ShapeInfo& info,
                            const TerrainDescription::Feature& feature) {
        Names names;
        for (const ShapeNumber& number : info.numbers)
            names.emplace_back(number.name ? number.name : "");
        for (const auto& [name, value] : feature.numbers)
            if (name.empty() || index_of(names, name) < 0) return wrong(row, no_such("number", name, names));
        for (u32 i = 0; i < kFeatureNumbers; ++i) {
            const ShapeNumber& number = info.numbers[i];
            if (!number.name) continue;
            const auto given = feature.numbers.find(number.name);
            r.numbers[i] = given == feature.numbers.end() ? number.fallback : given->second;
            VX_TRY(check_range(row, number.name, r.numbers[i], number.least, number.most));
        }
        // Builders draw from X_least to X_most, counts too: the other way round there is no such range.
        for (u32 i = 0; i < kFeatureNumbers; ++i) {
            if (!names[i].ends_with("_least")) continue;
            const int most = index_of(names, names[i].substr(0, names[i].size() - 5) + "most");
            if (most < 0) continue;
            VX_TRY(check_range(row, names[i], r.numbers[i], info.numbers[i].least, r.numbers[std::size_t(most)]));
        }
        return {};
    }

    Result<> blocks(FeatureRow& r, const std::string& row, const ShapeInfo& info,
                    const TerrainDescription::Feature& feature) {
        Names names;
        for (const char* name : info.blocks)
            names.emplace_back(name ? name : "");
        for (const auto& [name, text] : feature.blocks)
            if (name.empty() || index_of(names, name) < 0) return wrong(row, no_such("block", name, names));
        for (u32 i = 0; i < kFeatureBlocks; ++i) {
            if (names[i].empty()) continue;
            const auto given = feature.blocks.find(names[i]);
            if (given == feature.blocks.end()) return wrong(row, fmt::format("expected a block '{}'", names[i]));
            VX_TRY_ASSIGN(r.blocks[i], block(row, given->second));
        }
        return {};
    }

    static std::string no_such(std::string_view what, std::string_view name, Names names) {
        std::erase(names, "");
        if (names.empty()) return fmt::format("{} '{}'; the shape takes none", what, name);
        return fmt::format("{} '{}'; expected one of {}", what, name, fmt::join(names, ", "));
    }

    Result<> decorators() {
        VX_TRY(check_count("decorators", d_.decorators.size(), kDecoratorsMost));
        for (const auto& decorator : d_.decorators) {
            const std::string row = fmt::format("decorator {} in {}", decorator.block, decorator.biome);
            const std::string same = fmt::format("{} at {}", row, decorator.place);
            DecoratorRow& r = t_.decorator[t_.decorators++];
            VX_TRY_ASSIGN(const u32 place, choice(row, "place", decorator.place, kDecoratorPlaces));
            r.place = DecoratorPlace(place);
            const bool cave = r.place == DecoratorPlace::cave_floor || r.place == DecoratorPlace::cave_ceiling;
            VX_TRY_ASSIGN(
                r.biome, row_index(row, cave ? "cave biome" : "biome", decorator.biome, cave ? cave_biomes_ : biomes_));
            VX_TRY_ASSIGN(r.block, block(row, decorator.block));
            if (!decorator.upper.empty()) {
                VX_TRY_ASSIGN(r.upper, block(row, decorator.upper));
            }
            VX_TRY(check_range(row, "chance", decorator.chance, 0, 1));
            r.chance = decorator.chance;
            VX_TRY_ASSIGN(r.on, block_set(row, decorator.on));
            r.key = key(same, ordinal(same));
        }
        return {};
    }

    Result<u16> noise(const std::string& name, u64 number, NoiseKind kind, double frequency, u32 octaves) {
        auto index = builder_.add_noise(kind, frequency, octaves, purpose_of(name, number));
        if (!index) return fail(index.error().code, fmt::format("{}: {}", name, index.error().message));
        return *index;
    }

    // The shapes of caves and ravines (cells of .005 and .0015 a block), and what roughens features.
    Result<> cave_noises() {
        const struct {
            Noise* to;
            const char* name;
            NoiseKind kind;
            double frequency;
            u32 octaves;
        } wanted[] = {
            {&t_.cave_cells, "cave_cells", NoiseKind::cellular, .005, 1},
            {&t_.cave_warp_x, "cave_warp_x", NoiseKind::simplex3, .8 * .005, 5},
            {&t_.cave_warp_y, "cave_warp_y", NoiseKind::simplex3, .8 * .005, 5},
            {&t_.cave_warp_z, "cave_warp_z", NoiseKind::simplex3, .8 * .005, 5},
            {&t_.cave_width, "cave_width", NoiseKind::simplex3, 4 * .005, 4},
            {&t_.cave_gate, "cave_gate", NoiseKind::simplex3, .07 * .005, 4},
            {&t_.ravine_cells, "ravine_cells", NoiseKind::cellular, .0015, 1},
            {&t_.ravine_warp, "ravine_warp", NoiseKind::simplex2, 10 * .0015, 4},
            {&t_.ravine_depth, "ravine_depth", NoiseKind::simplex2, 8 * .0015, 4},
            {&t_.ravine_gate, "ravine_gate", NoiseKind::simplex2, 3 * .0015, 4},
        };
        for (const auto& w : wanted) {
            VX_TRY_ASSIGN(const u16 index, noise(w.name, 0, w.kind, w.frequency, w.octaves));
            *w.to = builder_.noise(index);
        }
        VX_TRY_ASSIGN(t_.shape_noise[0], noise("shape_noise fine", 0, NoiseKind::simplex3, .13, 3));
        VX_TRY_ASSIGN(t_.shape_noise[1], noise("shape_noise coarse", 0, NoiseKind::simplex3, .035, 3));
        t_.pick_key = key("surface material");
        t_.cave_pick_key = key("cave material");
        return {};
    }

    void traits() {
        for (u32 i = 0; i < t_.decorators; ++i)
            for (const Block b : {t_.decorator[i].block, t_.decorator[i].upper})
                if (!ground_.has(b) && b > kLava) t_.traits[b] = trait_open;
        for (u32 b = 0; b < kBlocksMost; ++b)
            if (ground_.has(b)) t_.traits[b] |= trait_ground;
        t_.traits[kAir] = trait_open;
        t_.traits[kBedrock] = trait_ground;
        t_.traits[kWater] = t_.traits[kLava] = trait_liquid;
    }

    const TerrainDescription& d_;
    CompiledTerrain out_;
    TerrainTables& t_;
    TableBuilder builder_;
    Names fields_, strata_, loose_names_, biomes_, cave_biomes_;
    Names purposes_;
    BlockSet rock_, loose_, ground_, made_by_rules_;
};

} // namespace

Result<CompiledTerrain> compile_terrain(const TerrainDescription& description, u64 seed) {
    return Compiler(description, seed).run();
}

} // namespace vitrail
