// `vitrail generate --list`: everything the generator knows, one line each, as the content describes it.
#include "apps/list_terrain.h"

#include "pipeline/new_world.h"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace vitrail::apps {

namespace {

std::string weights_text(const std::map<std::string, float>& weights) {
    std::string out;
    for (const auto& [name, weight] : weights)
        out += fmt::format("{}{} {:g}", out.empty() ? "" : ", ", name, weight);
    return out;
}

// Expressions may be written over several lines.
std::string in_one_line(const std::string& text) {
    std::string out;
    for (const char c : text)
        if (c != ' ' && c != '\n' && c != '\t')
            out += c;
        else if (!out.empty() && out.back() != ' ')
            out += ' ';
    return out;
}

std::string rule_text(const TerrainDescription::SurfaceRule& rule) {
    std::string out = fmt::format("{} becomes {}", fmt::join(rule.from, ", "),
                                  rule.bands.empty() ? rule.to : fmt::format("{} bands", rule.bands.size()));
    if (rule.depth > 0) out += fmt::format(", the top {}", rule.depth);
    if (!rule.above.empty()) out += fmt::format(", above {}", in_one_line(rule.above));
    if (!rule.below.empty()) out += fmt::format(", below {}", in_one_line(rule.below));
    if (rule.chance < 1) out += fmt::format(", chance {:g}", rule.chance);
    return out;
}

void list_stages() {
    fmt::print("stage land: reach 0 columns; attributes, weights and height of the land\n"
               "stage ground: reach {} columns; loose layers laid and eroded, zones of {} x {} columns on a CPU\n"
               "stage lattice: reach 0 columns; cave fields every {} blocks\n"
               "stage caves: reach 1 column; caves and ravines, flattened into layers\n"
               "stage features: reach 0 columns; placements of features and their solids\n"
               "stage blocks: reach {} columns; layers, rules, features, decorators\n",
               kGroundReach, kZoneColumns, kZoneColumns, kLatticeStep, kFeatureReach);
}

void list_surface(const TerrainDescription& d) {
    for (const auto& a : d.attributes)
        fmt::print("attribute {}: field {}, {:g} .. {:g}\n", a.name, a.field, a.low, a.high);
    for (const auto& l : d.layers) {
        if (l.loose)
            fmt::print("layer {}: {}, loose, {:g} thick, repose {:g} degrees, steepest {:g}\n", l.name, l.block,
                       l.thickness, l.repose_degrees, l.steepest);
        else
            fmt::print("layer {}: {}, {}, {:g} +- {:g} thick, frequency {:g}\n", l.name, l.block,
                       l.remainder ? "stratum that takes what remains"
                       : l.hung    ? "hung under the loose layers"
                                   : "stratum",
                       l.thickness, l.amplitude, l.frequency);
    }
    for (const auto& b : d.biomes) {
        fmt::print("biome {}: wants {}, height {}", b.name, b.wants, in_one_line(b.height));
        if (!b.materials.empty()) fmt::print("; {}", weights_text(b.materials));
        fmt::print("\n");
        for (const auto& rule : b.rules)
            fmt::print("rule {}: {}\n", b.name, rule_text(rule));
    }
}

void list_caves(const TerrainDescription& d) {
    for (const auto& a : d.cave_attributes)
        fmt::print("cave attribute {}: {}{:g} .. {:g}\n", a.name, a.by_depth ? "by depth, " : "", a.low, a.high);
    for (const auto& b : d.cave_biomes) {
        fmt::print("cave biome {}: wants {}\n", b.name, b.wants);
        for (const auto& r : b.rules) {
            fmt::print("cave rule {}: {}, {} becomes {}, chance {:g}", b.name, r.place, fmt::join(r.from, ", "), r.to,
                       r.chance);
            if (!r.vein.empty()) fmt::print(", veins of {}", in_one_line(r.vein));
            fmt::print("\n");
        }
    }
}

void list_things(const TerrainDescription& d) {
    for (const auto& f : d.features) {
        fmt::print("feature {}: {} in {}, {}, cell {} padding {} chance {:g}", f.name, f.shape, f.biome, f.place,
                   f.cell, f.padding, f.chance);
        if (!f.layers.empty()) fmt::print(", on {} of {:g}", fmt::join(f.layers, ", "), f.least_thickness);
        if (f.least_height > 0) fmt::print(", caves of {} and more", f.least_height);
        if (f.water_depth > 0) fmt::print(", water of {} and more", f.water_depth);
        fmt::print("\n");
    }
    for (const auto& x : d.decorators)
        fmt::print("decorator {}: {}{}{} in {}, chance {:g}\n", x.place, x.block, x.upper.empty() ? "" : " under ",
                   x.upper, x.biome, x.chance);
}

} // namespace

Result<> list_terrain(const TerrainDescription& description, const TerrainGenerator& generator) {
    const auto count = [&](auto of) { return std::count_if(description.layers.begin(), description.layers.end(), of); };
    fmt::print("generator {}, version {}: {} surface biomes, {} cave biomes, {} layers ({} loose), {} features, {} "
               "decorators, {} blocks\n",
               kGeneratorName, kGeneratorVersion, description.biomes.size(), description.cave_biomes.size(),
               description.layers.size(), count([](const auto& l) { return l.loose; }), description.features.size(),
               description.decorators.size(), generator.block_names().size());
    fmt::print("world {} <= y < {}, sea level {}, lava level {}\n", kTerrainMinY, kTerrainMaxY, kTerrainSeaLevel,
               kTerrainLavaLevel);
    list_stages();
    list_surface(description);
    list_caves(description);
    list_things(description);
    for (const std::string& name : generator.block_names())
        fmt::print("block {}\n", name);
    return {};
}

} // namespace vitrail::apps
