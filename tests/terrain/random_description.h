// Descriptions that nobody would write and that compile_terrain takes: every table filled at random up to its limits,
// numbers at the edges of their ranges, expressions that overflow, give no number or jump.
#pragma once

#include "base/rng.h"
#include "terrain/compile/expression.h"
#include "terrain/compile/shape_info.h"
#include "terrain/description.h"
#include "terrain/tables.h"

#include <fmt/format.h>
#include <iterator>
#include <memory>

namespace vitrail {

class RandomDescription {
public:
    explicit RandomDescription(u64 seed)
        : rng_(seed) {}

    TerrainDescription make() {
        TerrainDescription d;
        attributes_ = rng_.below(4) == 0 ? kAttributesMost : rng_.below(4);
        names_.clear();
        d.warp_x = expression();
        d.warp_z = rng_.below(3) == 0 ? "" : expression();
        for (u32 i = 0; i < attributes_; ++i)
            d.fields.push_back({fmt::format("f{}", i), expression()});
        for (u32 i = 0; i < attributes_; ++i) {
            const std::string name = i == 0 && rng_.below(2) == 0 ? "ocean" : fmt::format("a{}", char('a' + i));
            d.attributes.push_back({name, fmt::format("f{}", rng_.below(attributes_)), edge(), edge() + 0.5f});
            if (d.attributes.back().low == d.attributes.back().high) d.attributes.back().high += 1;
            names_.push_back(name);
        }
        layers(d);
        const u32 biomes = rng_.below(6) == 0 ? kBiomesMost : 1 + rng_.below(6);
        for (u32 i = 0; i < biomes; ++i)
            d.biomes.push_back({fmt::format("x:b{}", i), wants(attributes_), expression(), materials(), {}});
        names_.push_back("height");
        for (auto& biome : d.biomes)
            for (u32 i = rng_.below(biomes > 6 ? 2 : 4); i > 0; --i)
                biome.rules.push_back(surface_rule());
        cave_attributes_ = rng_.below(4) == 0 ? kAttributesMost : rng_.below(4);
        for (u32 i = 0; i < cave_attributes_; ++i) {
            const float low = edge();
            d.cave_attributes.push_back({fmt::format("c{}", char('a' + i)), rng_.below(3) == 0 ? "" : expression(),
                                         rng_.below(3) != 0, low, low + (rng_.below(2) == 0 ? 1 : -40)});
        }
        const u32 caves = rng_.below(4) == 0 ? kCaveBiomesMost : rng_.below(5);
        for (u32 i = 0; i < caves; ++i) {
            d.cave_biomes.push_back({fmt::format("x:c{}", i), wants(cave_attributes_), {}});
            for (u32 k = rng_.below(4); k > 0; --k)
                d.cave_biomes.back().rules.push_back(cave_rule());
        }
        const u32 features = rng_.below(4) == 0 ? kFeaturesMost : rng_.below(24);
        for (u32 i = 0; i < features; ++i)
            d.features.push_back(feature(d, i));
        for (u32 i = rng_.below(4) == 0 ? kDecoratorsMost : rng_.below(12); i > 0; --i)
            d.decorators.push_back(decorator(d));
        return d;
    }

private:
    template <class T, std::size_t N>
    const T& one_of(const T (&list)[N]) {
        return list[rng_.below(u32(N))];
    }
    float between(float low, float high) {
        const u32 kind = rng_.below(4);
        return kind == 0 ? low : kind == 1 ? high : low + (high - low) * rng_.unit();
    }
    float edge() {
        static constexpr float values[] = {0, 1, -1, .01f, -.05f, 100, -100, 19, 72, -999000, 999000};
        return one_of(values);
    }
    std::string block() { return fmt::format("x:s{}", rng_.below(40)); }

    std::string term(u32 depth) {
        static constexpr const char* leaves[] = {
            "0",       "1",      "140",   "-90",   "1000000", "384",         "F(.01)",      "F3(.5)",       "G8(.5)",
            "W(.016)", "E(.07)", "R(.2)", "S(.3)", "F(.003)", "pow(10, 30)", "140+9F(.02)", "128+90F(.004)"};
        static constexpr const char* ways[] = {"({} + {})",
                                               "({} - {})",
                                               "({} * {})",
                                               "({} / {})",
                                               "min({}, {})",
                                               "max({}, {})",
                                               "pow({}, {})",
                                               "ss({}, {}, .5)",
                                               "(pow({}, 99) - pow({}, 99))",
                                               "(sqrt({}) * abs({}))",
                                               "({})^3 * ({})^-2",
                                               "warp({}, {}, F(.01))"};
        if (depth == 0 || rng_.below(3) == 0)
            return !names_.empty() && rng_.below(4) == 0 ? names_[rng_.below(u32(names_.size()))] : one_of(leaves);
        const char* way = one_of(ways);
        const std::string a = term(depth - 1), b = term(depth - 1);
        // A warp stands in no other.
        if (std::string_view(way).starts_with("warp") && (a + b).find("warp") != std::string::npos) return a;
        return fmt::format(fmt::runtime(way), a, b);
    }
    // Many are no number or infinite somewhere. Those that the compiler refuses are not the point here.
    std::string expression() {
        if (rng_.below(6) == 0) return "a = (1000000 F(.01))^9; b = a a a; c = b b; min(200, c) + (c - c) W(.1)";
        const auto tables = std::make_unique<TerrainTables>();
        TableBuilder builder(*tables);
        builder.inputs = names_;
        if (std::string text = term(rng_.below(4)); compile_expression(text, "random", builder)) return text;
        return "140 + 20F(.008)";
    }

    void layers(TerrainDescription& d) {
        layer_names_.clear();
        loose_names_.clear();
        const u32 strata = 1 + rng_.below(rng_.below(3) == 0 ? kStrataMost : 3), loose = rng_.below(kLooseMost + 1);
        const u32 remainder = rng_.below(strata + 1);
        for (u32 i = 0; i < strata + loose; ++i) {
            TerrainDescription::Layer l;
            l.name = fmt::format("l{}", i);
            l.block = block();
            l.thickness = between(0, rng_.below(2) == 0 ? 6 : 384);
            l.loose = i >= strata;
            l.remainder = i == remainder && !l.loose;
            l.hung = !l.loose && !l.remainder && rng_.below(3) == 0;
            l.amplitude = rng_.below(2) == 0 ? between(0, 384) : 0;
            l.frequency = between(.001f, .03f);
            l.repose_degrees = between(1, 89);
            l.steepest = between(.01f, 1000);
            layer_names_.push_back(l.name);
            if (l.loose) loose_names_.push_back(l.name);
            d.layers.push_back(l);
        }
        d.materials = materials();
    }
    std::map<std::string, float> materials() {
        std::map<std::string, float> out;
        for (const std::string& name : layer_names_)
            if (rng_.below(3) == 0) out[name] = rng_.below(3) == 0 ? 100.0f : between(0, 3);
        return out;
    }
    std::string wants(u32 attributes) {
        std::string out;
        for (u32 i = 0; i < attributes; ++i)
            out += one_of("+-...");
        std::replace(out.begin(), out.end(), '\0', '.');
        return out;
    }
    std::vector<std::string> from() {
        static constexpr const char* words[] = {"ground", "rock", "loose", "water", "air"};
        std::vector<std::string> out;
        for (u32 i = rng_.below(3); i > 0; --i)
            out.push_back(rng_.below(3) == 0 ? block() : one_of(words));
        return out;
    }
    TerrainDescription::SurfaceRule surface_rule() {
        TerrainDescription::SurfaceRule r;
        r.from = from();
        if (rng_.below(2) == 0) r.above = expression();
        if (rng_.below(2) == 0) r.below = expression();
        r.depth = i32(rng_.below(3) == 0 ? kTerrainHeight : rng_.below(4));
        r.chance = between(0, 1);
        if (!r.above.empty() && rng_.below(2) == 0)
            for (u32 i = 1 + rng_.below(32); i > 0; --i)
                r.bands.push_back(block());
        else
            r.to = rng_.below(8) == 0 ? "minecraft:lava" : block();
        return r;
    }
    TerrainDescription::CaveRule cave_rule() {
        TerrainDescription::CaveRule r;
        r.place = one_of(kCavePlaces);
        r.from = from();
        r.to = block();
        r.depth = 1 + i32(rng_.below(kCaveRuleDepthMost));
        r.chance = between(0, 1);
        if (rng_.below(2) == 0) {
            r.vein = rng_.below(2) == 0 ? "F3(.05)" : "F8(.5)";
            r.vein_width = between(0, 2);
        }
        return r;
    }
    TerrainDescription::Feature feature(const TerrainDescription& d, u32 number) {
        TerrainDescription::Feature f;
        const ShapeInfo& info = shape_infos()[rng_.below(u32(shape_infos().size()))];
        f.name = fmt::format("x:f{}", number);
        f.shape = info.name;
        f.place = d.cave_biomes.empty() ? kFeaturePlaces[rng_.below(3)] : one_of(kFeaturePlaces);
        const bool cave = f.place.starts_with("cave");
        f.biome = cave ? d.cave_biomes[rng_.below(u32(d.cave_biomes.size()))].name
                       : d.biomes[rng_.below(u32(d.biomes.size()))].name;
        f.cell = i32(rng_.below(3) == 0 ? 2 : rng_.below(8) == 0 ? 1024 : 2 + rng_.below(40));
        f.padding = i32(rng_.below(2) == 0 ? 0 : u32((f.cell - 1) / 2));
        f.chance = between(0, 1);
        for (const std::string& layer : loose_names_)
            if (rng_.below(4) == 0) f.layers.push_back(layer);
        f.least_thickness = rng_.below(2) == 0 ? 0 : between(0, 2);
        for (const ShapeNumber& n : info.numbers)
            if (n.name) f.numbers[n.name] = between(n.least, n.most);
        for (const ShapeNumber& n : info.numbers) {
            const std::string name = n.name ? n.name : "";
            if (!name.ends_with("_least")) continue;
            const std::string most = name.substr(0, name.size() - 5) + "most";
            if (f.numbers[name] > f.numbers[most]) std::swap(f.numbers[name], f.numbers[most]);
        }
        for (const char* part : info.blocks)
            if (part) f.blocks[part] = block();
        return f;
    }
    TerrainDescription::Decorator decorator(const TerrainDescription& d) {
        TerrainDescription::Decorator out;
        out.place = d.cave_biomes.empty() ? kDecoratorPlaces[rng_.below(2)] : one_of(kDecoratorPlaces);
        out.biome = out.place.starts_with("cave") ? d.cave_biomes[rng_.below(u32(d.cave_biomes.size()))].name
                                                  : d.biomes[rng_.below(u32(d.biomes.size()))].name;
        out.block = block();
        if (rng_.below(2) == 0) out.upper = block();
        out.chance = between(0, 1);
        out.on = from();
        return out;
    }

    Rng rng_;
    u32 attributes_ = 0, cave_attributes_ = 0;
    std::vector<std::string> names_, layer_names_, loose_names_; // names_: what expressions may read
};

} // namespace vitrail
