#include "scene/pack_looks.h"

#include "scene/pack_names.h"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <set>

namespace vitrail::scene {

namespace {

constexpr std::size_t kMaxModelBytes = 1u << 20;

// Of a content picture that lies beneath a pack's model.
std::optional<Image> content_picture(const BlockRegistry& registry, const std::string& name) {
    if (name.empty() || name.find("..") != std::string::npos || name[0] == '/') return std::nullopt;
    for (const std::string& root : registry.content_roots) {
        std::ifstream file(root + "/textures/" + name + ".png", std::ios::binary | std::ios::ate);
        if (!file) continue;
        const std::streamoff size = file.tellg();
        if (size < 0 || size > (16 << 20)) continue;
        Bytes bytes{};
        bytes.resize(std::size_t(size));
        file.seekg(0);
        if (!file.read(reinterpret_cast<char*>(bytes.data()), size)) continue;
        if (Result<Image> image = decode_png(bytes)) return std::move(*image);
    }
    return std::nullopt;
}

} // namespace

struct PackLooks::Loader {
    PackLooks& out;
    const PackStack& packs;
    const BlockRegistry& registry;
    const PackLimits& limits;
    ModelLibrary library;
    std::unordered_map<const ResourcePack*, std::string> glow;
    std::unordered_map<std::string, TextureId> ids;           // by "namespace:path"
    std::unordered_map<std::string, TextureId> made;          // by recipe
    std::unordered_map<std::string, const BakedModel*> baked; // null: not to be had
    std::set<std::string> missing;
    u64 art_bytes = 0, decoded_bytes = 0;
    bool out_of_memory = false, out_of_layers = false, out_of_quads = false;

    Loader(PackLooks& o, const PackStack& p, const BlockRegistry& r, const PackLimits& l)
        : out(o)
        , packs(p)
        , registry(r)
        , limits(l)
        , library([this](const std::string& name) { return model_file(name); }) {}

    std::optional<Bytes> model_file(const std::string& name) {
        const auto parsed = parse_resource_name(name);
        if (!parsed) return std::nullopt;
        return packs.read(parsed->file("models", ".json"), kMaxModelBytes, out.report_);
    }

    static u64 bytes_of(const TextureArt& art) {
        return art.albedo.pixels.size() + art.normal.pixels.size() + art.roughness.pixels.size() +
               art.emission.pixels.size();
    }
    bool afford(const TextureArt& art) {
        if (art_bytes + bytes_of(art) > limits.art_bytes_most) {
            if (!std::exchange(out_of_memory, true))
                out.report_.say(
                    fmt::format("pictures beyond {} MiB are left out, from {}", limits.art_bytes_most >> 20, art.name));
            return false;
        }
        art_bytes += bytes_of(art);
        out.largest_side_ = std::max(out.largest_side_, art.side());
        return true;
    }

    // The topmost picture of this name. Its maps come from the same pack.
    std::optional<TextureArt> find_art(const std::string& space, const std::string& path) {
        if (decoded_bytes > limits.decoded_bytes_most) {
            if (!std::exchange(out_of_memory, true))
                out.report_.say(fmt::format("pictures of packs take too long: those from {} on are left out", path));
            return std::nullopt;
        }
        for (auto it = packs.packs().rbegin(); it != packs.packs().rend(); ++it) {
            const ResourcePack& pack = **it;
            std::vector<std::string> files{path};
            if (space == "minecraft" && path.starts_with("block/"))
                files = picture_files(std::string_view(path).substr(6), pack.info().old_names());
            for (const std::string& file : files) {
                const std::string whole = fmt::format("{}/textures/{}", space, file);
                if (!pack.contains(whole + ".png")) continue;
                const auto suffix = glow.try_emplace(&pack, std::string()).first;
                if (suffix->second.empty()) suffix->second = glow_suffix(pack);
                std::optional<TextureArt> art = load_art(pack, whole, suffix->second, limits.art, out.report_);
                if (!art) continue;
                decoded_bytes += art->decoded_bytes;
                if (afford(*art)) return art;
            }
        }
        return std::nullopt;
    }

    std::optional<TextureId> add(TextureArt art) {
        if (out.art_.size() >= std::min(limits.textures_most, 65535u)) {
            if (!std::exchange(out_of_layers, true))
                out.report_.say(fmt::format("more than {} textures: those from {} on are left out",
                                            limits.textures_most, art.name));
            return std::nullopt;
        }
        out.alpha_.push_back(art.alpha);
        out.art_.emplace_back(std::move(art));
        return TextureId(out.art_.size() - 1);
    }

    void replace_content() {
        const auto& textures = registry.textures();
        out.art_.resize(std::max<std::size_t>(textures.size(), 1));
        out.alpha_.resize(out.art_.size(), AlphaKind::full);
        for (u32 id = 1; id < textures.size(); ++id) {
            const std::string& name = textures[id].name;
            if (is_sheet(name) || !parse_resource_name(name)) continue;
            std::optional<TextureArt> art = find_art("minecraft", "block/" + name);
            if (!art) continue;
            out.alpha_[id] = art->alpha;
            out.art_[id] = std::move(art);
            ++out.counts_.replaced_textures;
        }
    }

    TextureId texture(const std::string& name) {
        if (name.empty()) return TextureId::unknown; // counted with its model
        const auto known = ids.find(name);
        if (known != ids.end()) return known->second;
        const auto find = [&]() -> TextureId {
            const auto parsed = parse_resource_name(name);
            std::string_view bare = parsed->path;
            const bool block =
                parsed->space == "minecraft" && (bare.starts_with("block/") || bare.starts_with("blocks/"));
            if (block) bare.remove_prefix(bare.find('/') + 1);
            if (block && !is_sheet(bare)) // already read in place of content's?
                if (const auto id = registry.find_texture(bare); id && out.replaces(*id)) return *id;
            const std::string path = block ? "block/" + std::string(bare) : parsed->path;
            if (std::optional<TextureArt> art = find_art(parsed->space, path)) {
                if (const auto id = add(std::move(*art))) {
                    ++out.counts_.own_textures;
                    return *id;
                }
                return TextureId::unknown;
            }
            if (block)
                for (const std::string& ours : content_names(bare)) {
                    const auto id = registry.find_texture(ours);
                    if (!id || *id == TextureId::unknown) continue;
                    if (!out.replaces(*id))
                        if (const auto image = content_picture(registry, ours))
                            out.alpha_[u32(*id)] = alpha_kind(*image);
                    return *id;
                }
            missing.insert(name);
            return TextureId::unknown;
        };
        return ids.emplace(name, find()).first->second;
    }

    // Pictures that a FaceLook cannot say by itself are made. False: leave the face as content has it.
    bool choose_look(const PackFace& face, BakedModel::Look& look) {
        if (face.layers.size() == 1 && face.layers[0].plain()) {
            look = {face.layers[0].texture, face.layers[0].turns, face.layers[0].tint >= 0, false};
            return true;
        }
        std::string recipe;
        std::vector<FaceLayer> layers;
        for (const PackFace::Layer& layer : face.layers) {
            const TextureArt* art = out.art(layer.texture);
            if (!art) return false; // content's own pictures are not cut
            layers.push_back({art, layer.uv, layer.turns, layer.tint >= 0});
            recipe += fmt::format("{}:{},{},{},{}:{}:{};", u32(layer.texture), layer.uv[0], layer.uv[1], layer.uv[2],
                                  layer.uv[3], layer.turns, layer.tint >= 0);
        }
        const auto known = made.find(recipe);
        TextureId id{};
        if (known != made.end()) {
            id = known->second;
        } else {
            TextureArt art = compose_art(layers, fmt::format("made of {}", layers[0].art->name));
            if (!afford(art)) return false;
            const auto added = add(std::move(art));
            if (!added) return false;
            id = *added;
            made.emplace(recipe, id);
            ++out.counts_.made_textures;
        }
        bool tinted = false;
        for (const FaceLayer& layer : layers)
            tinted |= layer.tinted;
        look = {id, 0, tinted, out.art(id)->tint_mask};
        return true;
    }

    const BakedModel* bake(const ModelVariantJson& variant) {
        const std::string key = fmt::format("{}|{}|{}|{}", variant.model, variant.x, variant.y, variant.uv_lock);
        const auto known = baked.find(key);
        if (known != baked.end()) return known->second;
        const auto make = [&]() -> const BakedModel* {
            const auto model = library.resolve(variant.model);
            if (!model) {
                ++out.counts_.unresolved_models;
                // That Minecraft's own models are nowhere is as it should be.
                if (model.error().code != ErrorCode::not_found) out.report_.say(model.error().message);
                return nullptr;
            }
            if ((*model)->elements.empty()) return nullptr; // drawn by code there, by content's shape here
            for (const std::string& texture_key : (*model)->missing)
                missing.insert(fmt::format("{} of {}", texture_key.empty() ? "(none)" : texture_key, variant.model));
            auto quads = std::make_unique<BakedModel>(
                bake_model(**model, variant, [this](const std::string& name) { return texture(name); }));
            if (out.counts_.quads + quads->quads.size() > limits.quads_most) {
                if (!std::exchange(out_of_quads, true))
                    out.report_.say(fmt::format("more than {} quads in models: those from {} on are left out",
                                                limits.quads_most, variant.model));
                return nullptr;
            }
            out.counts_.quads += quads->quads.size();
            if (quads->cube)
                for (u32 f = 0; f < 6; ++f)
                    if (!choose_look((*quads->cube)[f], quads->looks[f])) {
                        quads->cube.reset();
                        break;
                    }
            ++out.counts_.models;
            out.models_.push_back(std::move(quads));
            return out.models_.back().get();
        };
        return baked.emplace(key, make()).first->second;
    }

    void read_blockstates(const std::string& space, const std::string& name, const std::string& file) {
        const auto bytes = packs.read(file, kMaxModelBytes, out.report_);
        if (!bytes) return;
        const auto parsed = parse_blockstates(*bytes);
        if (!parsed) return out.report_.say(fmt::format("{}: {}", file, parsed.error().message));
        add_block(space + ":" + name, *parsed);
    }

    void add_block(const std::string& name, const BlockstatesJson& states) {
        Block block;
        block.multipart = states.multipart;
        for (const BlockstatesJson::Case& one : states.cases) {
            Case c;
            c.when = one.when;
            for (const ModelVariantJson& variant : one.apply)
                c.apply.push_back({variant.weight, bake(variant)});
            block.cases.push_back(std::move(c));
        }
        out.blocks_.insert_or_assign(name, std::move(block));
        ++out.counts_.blockstates;
    }

    void read_all_blockstates() {
        std::set<std::string> files;
        for (const auto& pack : packs.packs()) {
            if (pack->info().old_names()) continue;
            for (const std::string& path : pack->list("", ".json")) {
                const std::size_t slash = path.find('/');
                if (path.compare(slash, 13, "/blockstates/") == 0) files.insert(path);
            }
        }
        for (const std::string& path : files) {
            if (out.blocks_.size() >= limits.blockstates_most) {
                out.report_.say(fmt::format("blockstates beyond {} are left out", limits.blockstates_most));
                break;
            }
            const std::size_t slash = path.find('/');
            const std::string name = path.substr(slash + 13, path.size() - slash - 13 - 5);
            read_blockstates(path.substr(0, slash), name, path);
        }
        // The side of grass is painted in content; in packs it is dirt under a gray overlay that takes the biome's
        // color.
        const auto side = registry.find_texture("grass_block_side");
        if (side && out.replaces(*side) && !out.blocks_.contains("minecraft:grass_block") &&
            find_art("minecraft", "block/grass_block_side_overlay")) {
            BlockstatesJson grass;
            grass.cases.push_back({{{{"snowy", {"false"}, false}}}, {{"minecraft:block/grass_block", 0, 0, false, 1}}});
            grass.cases.push_back({{{{"snowy", {"true"}, false}}}, {{"minecraft:block/air", 0, 0, false, 1}}});
            add_block("minecraft:grass_block", grass);
            --out.counts_.blockstates;
        }
    }

    void read_color_maps() {
        const auto read = [&](const char* path) -> Image {
            const auto bytes = packs.read(path, ArtLimits::kMaxPictureBytes, out.report_);
            if (!bytes) return {};
            Result<Image> image = decode_png(*bytes);
            if (image) return std::move(*image);
            out.report_.say(fmt::format("{}: {}", path, image.error().message));
            return {};
        };
        out.grass_map_ = read("minecraft/textures/colormap/grass.png");
        out.foliage_map_ = read("minecraft/textures/colormap/foliage.png");
    }
};

PackLooks::~PackLooks() = default;

std::shared_ptr<const PackLooks> PackLooks::load(const PackStack& packs, const BlockRegistry& registry,
                                                 const PackLimits& limits) {
    std::shared_ptr<PackLooks> out(new PackLooks);
    out->counts_.packs = u32(packs.packs().size());
    Loader loader(*out, packs, registry, limits);
    loader.replace_content();
    loader.read_all_blockstates();
    loader.read_color_maps();
    out->missing_.assign(loader.missing.begin(), loader.missing.end());
    return out;
}

const BakedModel* PackStateLook::heaviest() const {
    const auto best = std::max_element(choices.begin(), choices.end(),
                                       [](const PackChoice& a, const PackChoice& b) { return a.weight < b.weight; });
    return best == choices.end() ? nullptr : best->model;
}

// Walls say low and tall where older packs say true.
static bool matches(std::string_view have, std::string_view wanted) {
    return have == wanted || (wanted == "true" && (have == "low" || have == "tall")) ||
           (wanted == "false" && have == "none");
}

// How many terms speak of properties that the state lacks, or nothing where another one fails.
static std::optional<u32> unknown_terms(const std::vector<StateTerm>& terms, const BlockState& state) {
    u32 unknown = 0;
    for (const StateTerm& term : terms) {
        const std::string_view have = state.get(term.property);
        if (have.empty()) {
            ++unknown;
            continue;
        }
        const bool any = std::any_of(term.values.begin(), term.values.end(),
                                     [&](const std::string& wanted) { return matches(have, wanted); });
        if (any == term.negated) return std::nullopt;
    }
    return unknown;
}

PackStateLook PackLooks::look(const StateInfo& info) const {
    PackStateLook out;
    const std::size_t colon = info.state.name.find(':');
    if (colon == std::string::npos) return out;
    const Block* block = nullptr;
    for (const std::string& name : block_names(std::string_view(info.state.name).substr(colon + 1))) {
        const auto it = blocks_.find(info.state.name.substr(0, colon + 1) + name);
        if (it == blocks_.end()) continue;
        block = &it->second;
        break;
    }
    if (!block) return out;
    const Case* best = nullptr;
    u32 best_unknown = ~0u;
    for (const Case& one : block->cases) {
        std::optional<u32> unknown;
        if (one.when.empty()) unknown = 0;
        for (const auto& terms : one.when)
            if (const auto u = unknown_terms(terms, info.state); u && (!unknown || *u < *unknown)) unknown = u;
        if (!unknown) continue;
        if (block->multipart) {
            if (*unknown > 0) continue; // a part that hangs on what we do not know is not there
            const auto heaviest =
                std::max_element(one.apply.begin(), one.apply.end(),
                                 [](const PackChoice& a, const PackChoice& b) { return a.weight < b.weight; });
            if (heaviest == one.apply.end()) continue;
            if (!heaviest->model) return {}; // a part that is nowhere: better all in content's shape
            out.parts.push_back(heaviest->model);
        } else if (*unknown < best_unknown) {
            best = &one, best_unknown = *unknown;
        }
    }
    if (best) out.choices = best->apply;
    return out;
}

std::optional<std::array<u8, 3>> PackLooks::grass(const BiomeDef& biome) const {
    if (grass_map_.width == 0 || biome_has_own_colors(biome.name)) return std::nullopt;
    return map_color(grass_map_, biome.temperature, biome.downfall);
}

std::optional<std::array<u8, 3>> PackLooks::foliage(const BiomeDef& biome) const {
    if (foliage_map_.width == 0 || biome_has_own_colors(biome.name)) return std::nullopt;
    return map_color(foliage_map_, biome.temperature, biome.downfall);
}

} // namespace vitrail::scene
