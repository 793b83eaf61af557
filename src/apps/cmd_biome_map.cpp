// `vitrail biome-map`: generated land seen from above, in the colors of its blocks or of its biomes.
#include "apps/commands.h"

#include "pipeline/land_map.h"
#include "pipeline/new_world.h"
#include "render/image.h"
#include "script/content_loader.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <thread>

namespace vitrail::apps {

namespace {

float linear_of(u8 v) {
    const float c = float(v) / 255;
    return c <= 0.04045f ? c / 12.92f : std::pow((c + 0.055f) / 1.055f, 2.4f);
}
MapColor linear_of(const std::array<u8, 3>& c) {
    return {linear_of(c[0]), linear_of(c[1]), linear_of(c[2])};
}

// The mean color of a texture's first frame and how much of it is drawn at all; gray where there is none.
std::pair<MapColor, float> mean_of_texture(const BlockRegistry& registry, const std::string& name) {
    std::error_code ignored;
    for (const std::string& root : registry.content_roots) {
        const std::string path = root + "/textures/" + name + ".png";
        if (!std::filesystem::exists(path, ignored)) continue;
        const auto image = render::read_png(path);
        if (!image) continue;
        MapColor sum;
        float weight = 0;
        const u32 side = std::min(image->width, image->height);
        for (u32 y = 0; y < side; ++y)
            for (u32 x = 0; x < side; ++x) {
                const u8* p = image->at(x, y);
                const float a = image->channels == 4 ? float(p[3]) / 255 : 1;
                sum.r += linear_of(p[0]) * a, sum.g += linear_of(p[1]) * a, sum.b += linear_of(p[2]) * a;
                weight += a;
            }
        if (weight <= 0) return {{}, 0.0f};
        return {{sum.r / weight, sum.g / weight, sum.b / weight}, weight / float(side * side)};
    }
    return {{0.35f, 0.35f, 0.35f}, 1.0f};
}

Result<std::vector<MapPalette::BlockLook>> block_looks(const Content& content, const TerrainGenerator& generator) {
    StateTable states(content.registry);
    BiomeTable biomes;
    VX_TRY_ASSIGN(const TerrainPalette ids, make_terrain_palette(states, biomes, generator));
    std::vector<MapPalette::BlockLook> out;
    for (StateId id : ids.blocks) {
        const StateInfo& info = states.info(id);
        MapPalette::BlockLook look;
        if (info.look && !(states.flags(id) & kAirLike)) {
            const auto texture = std::size_t(info.face_textures[std::size_t(Face::up)]);
            const auto [color, drawn] = mean_of_texture(*content.registry, content.registry->textures()[texture].name);
            look.color = color;
            // Leaves and grass are drawn with holes; seen from above a plant hides what its picture covers, a full
            // block all.
            look.cover = info.look->shape == ShapeKind::cube || info.look->shape == ShapeKind::pillar
                             ? std::max(drawn, 0.9f)
                             : 0.5f * drawn;
            if (info.look->tint == TintKind::fixed) {
                const MapColor tint = linear_of(info.look->tint_color);
                look.color = {color.r * tint.r, color.g * tint.g, color.b * tint.b};
            }
            look.tint = info.look->tint == TintKind::grass     ? 1
                        : info.look->tint == TintKind::foliage ? 2
                        : info.look->tint == TintKind::water   ? 3
                                                               : 0;
        } else {
            look.cover = 0;
        }
        out.push_back(look);
    }
    return out;
}

// Hue 0..1, saturation, lightness: colors that stand apart, seas blue.
MapColor color_of(float hue, float saturation, float lightness) {
    const auto channel = [&](float shift) {
        const float k = std::fmod(shift + hue * 12, 12.0f);
        const float a = saturation * std::min(lightness, 1 - lightness);
        return u8(255 * (lightness - a * std::max(-1.0f, std::min({k - 3, 9 - k, 1.0f}))));
    };
    return linear_of(std::array<u8, 3>{channel(0), channel(8), channel(4)});
}

std::vector<MapPalette::BiomeLook> biome_looks(const Content& content, const TerrainGenerator& generator) {
    const TerrainTables& tables = generator.tables();
    std::vector<MapPalette::BiomeLook> out;
    const auto& attributes = content.terrain->attributes;
    const auto beach = std::find_if(attributes.begin(), attributes.end(), [](const auto& a) { return a.name == "beach"; });
    u32 sea = 0, shore = 0, land = 0;
    for (u32 b = 0; b < tables.biomes; ++b) {
        MapPalette::BiomeLook look;
        const BiomeDef& def = content.registry->biome_named(generator.biome_names()[b]);
        look.tints = {linear_of(def.grass), linear_of(def.foliage), linear_of(def.water)};
        if (tables.ocean >= 0 && tables.biome[b].wants[tables.ocean] > 0) {
            if (beach != attributes.end() && tables.biome[b].wants[beach - attributes.begin()] > 0) {
                look.color = color_of(0.12f + 0.02f * float(shore), 0.45f, 0.60f + 0.08f * float(shore));
                ++shore;
                out.push_back(look);
                continue;
            }
            look.color = color_of(0.50f + 0.025f * float(sea), 0.6f, 0.42f + 0.12f * float(sea % 3));
            ++sea;
        } else {
            look.color = color_of(std::fmod(0.08f + 0.618034f * float(land), 1.0f), land % 2 ? 0.75f : 0.5f,
                                  0.40f + 0.1f * float(land % 3));
            ++land;
        }
        out.push_back(look);
    }
    return out;
}

std::string hex_of(MapColor c) {
    const auto byte = [](float v) {
        return int(std::lround(255 * (v <= 0.0031308f ? v * 12.92f : 1.055f * std::pow(v, 1 / 2.4f) - 0.055f)));
    };
    return fmt::format("#{:02x}{:02x}{:02x}", byte(c.r), byte(c.g), byte(c.b));
}

Result<LandMapOptions> parse(const BiomeMapOptions& options) {
    LandMapOptions out;
    VX_TRY_ASSIGN(const auto center, parse_numbers("--center", options.center, 2));
    out.size = options.size;
    for (double v : center)
        if (v != std::floor(v) || std::abs(v) > double(kWorldEdge) - options.size)
            return fail(ErrorCode::invalid_argument,
                        fmt::format("--center wants whole blocks inside the world, not '{}'", options.center));
    out.first_x = i32(center[0]) - options.size / 2;
    out.first_z = i32(center[1]) - options.size / 2;
    out.scale = options.scale > 0 ? options.scale : (options.size + 1023) / 1024;
    if (out.scale > options.size) return fail(ErrorCode::invalid_argument, "--scale is larger than --size");
    if (i64(options.size / out.scale) * (options.size / out.scale) > 64'000'000)
        return fail(ErrorCode::limit, "--size and --scale give more than 64 million pixels");
    out.mode = options.mode == "biomes" ? MapMode::biomes : MapMode::blocks;
    out.threads = std::max(1u, std::thread::hardware_concurrency());
    return out;
}

} // namespace

Result<> run_biome_map(const BiomeMapOptions& options) {
    VX_TRY_ASSIGN(LandMapOptions map_options, parse(options));
    VX_TRY(check_writable(options.output));
    VX_TRY_ASSIGN(const Content content, load_base_content());
    VX_TRY_ASSIGN(const auto generator,
                  open_generator(kGeneratorName, kGeneratorVersion, content.terrain.get(), options.seed));
    MapPalette palette;
    VX_TRY_ASSIGN(palette.blocks, block_looks(content, *generator));
    palette.biomes = biome_looks(content, *generator);
    map_options.stop = &stop_on_signals();
    VX_TRY_ASSIGN(LandMap map, draw_land_map(*generator, palette, map_options));
    VX_TRY(render::write_png(options.output, render::Image{map.side, map.side, 3, std::move(map.pixels)}));
    fmt::print("{} x {} blocks from {},{}, {} blocks a pixel, {}\n", options.size, options.size, map_options.first_x,
               map_options.first_z, map_options.scale, map.every_block ? "every block made" : "surface alone");
    u64 all = 0;
    for (u64 count : map.biome_counts)
        all += count;
    for (u32 b = 0; b < map.biome_counts.size(); ++b)
        fmt::print("{} {:5.2f} % {}\n", hex_of(palette.biomes[b].color),
                   100 * double(map.biome_counts[b]) / double(std::max<u64>(all, 1)), generator->biome_names()[b]);
    return {};
}

} // namespace vitrail::apps
