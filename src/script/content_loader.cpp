#include "script/content_loader.h"

#include "lua/sandbox.h"
#include "script/block_reader.h"
#include "script/terrain_reader.h"

#include <algorithm>
#include <fmt/format.h>
#include <fstream>
#include <iterator>
#include <unordered_set>
#include <xxhash.h>

namespace vitrail {

using lua::Value;

namespace {

constexpr std::size_t kContentFilesMost = 1024;
constexpr std::uintmax_t kContentFileBytesMost = 4 << 20;
constexpr std::size_t kBiomesMost = 4096;
constexpr std::size_t kHotbarMost = 64;
constexpr std::size_t kLooksMost = 1u << 18, kBoxesInAllMost = 1u << 20;

tl::unexpected<Error> bad(std::string message) {
    return fail(ErrorCode::invalid_argument, std::move(message));
}

const Value kNothing;

const Value& argument(std::span<const Value> arguments, std::size_t i) {
    return i < arguments.size() ? arguments[i] : kNothing;
}

// What content has said so far.
class ContentBuilder {
public:
    Result<> define_block(std::span<const Value> arguments) {
        VX_TRY_ASSIGN(BlockDef def, read_block(argument(arguments, 0), argument(arguments, 1)));
        return add_block(std::move(def));
    }

    // The older way of saying it (one material a block, a number and a free name): vitrail:NAME.
    Result<> define_material(std::span<const Value> arguments) {
        const Value& id = argument(arguments, 0);
        const Value::Table* table = argument(arguments, 1).table();
        if (!id.is_number() || !table) return bad("expected define_material(number, {name = ..., texture = ...})");
        const Value* name = table->find("name");
        if (!name || !name->string()) return bad(fmt::format("material {}: expected a name", id.text()));
        std::string block_name = "vitrail:";
        for (const char c : *name->string())
            block_name += c == ' ' ? '_' : (c >= 'A' && c <= 'Z') ? char(c - 'A' + 'a') : c;
        Value rest{Value::Table{}};
        for (const Value::Entry& entry : table->entries)
            if (!entry.first.string() || *entry.first.string() != "name")
                std::get<Value::Table>(rest.data).entries.push_back(entry);
        VX_TRY_ASSIGN(BlockDef def, read_block(Value{block_name}, rest));
        return add_block(std::move(def));
    }

    Result<> define_texture(std::span<const Value> arguments) {
        TextureDef def;
        VX_TRY_ASSIGN(def.name, read_texture_name(argument(arguments, 0)));
        const Value::Table* table = argument(arguments, 1).table();
        if (!table)
            return bad(
                fmt::format("texture {}: expected a table, got {}", def.name, argument(arguments, 1).type_name()));
        for (const auto& [key, value] : table->entries) {
            if (key.text() != "frame_time") return bad(fmt::format("texture {}: unknown key {}", def.name, key.text()));
            const double ticks = value.number();
            if (!value.is_number() || !(ticks >= 1 && ticks <= 65535))
                return bad(fmt::format("texture {}: frame_time: expected server ticks from 1 to 65535", def.name));
            def.frame_time = u32(ticks);
        }
        if (registry_->textures().size() >= kContentTexturesMost)
            return fail(ErrorCode::limit, fmt::format("more than {} textures", kContentTexturesMost));
        registry_->add_texture(std::move(def));
        return {};
    }

    Result<> define_biome(std::span<const Value> arguments) {
        BiomeDef def;
        VX_TRY_ASSIGN(def.name, read_name(argument(arguments, 0), "a biome's name such as \"minecraft:plains\""));
        const Value::Table* table = argument(arguments, 1).table();
        if (!table)
            return bad(fmt::format("biome {}: expected a table, got {}", def.name, argument(arguments, 1).type_name()));
        for (const auto& [key, value] : table->entries) {
            const std::string name = key.text();
            std::array<u8, 3>* color = name == "grass"     ? &def.grass
                                       : name == "foliage" ? &def.foliage
                                       : name == "water"   ? &def.water
                                       : name == "sky"     ? &def.sky
                                       : name == "fog"     ? &def.fog
                                                           : nullptr;
            float* number = name == "temperature" ? &def.temperature : name == "downfall" ? &def.downfall : nullptr;
            if (color) {
                auto triple = read_triple(value, 255, false);
                if (!triple) return bad(fmt::format("biome {}: {}: {}", def.name, name, triple.error().message));
                *color = *triple;
            } else if (number) {
                if (!value.is_number() || !(value.number() >= -10 && value.number() <= 10))
                    return bad(fmt::format("biome {}: {}: expected a number from -10 to 10", def.name, name));
                *number = float(value.number());
            } else
                return bad(fmt::format("biome {}: unknown key {}", def.name, name));
        }
        if (++biomes_ > kBiomesMost) return fail(ErrorCode::limit, fmt::format("more than {} biomes", kBiomesMost));
        registry_->add_biome(std::move(def));
        return {};
    }

    Result<> define_hotbar(std::span<const Value> arguments) {
        const Value::Table* list = argument(arguments, 0).table();
        if (!list || !list->is_list() || list->entries.size() > kHotbarMost)
            return bad("hotbar: expected a list of block names");
        std::vector<std::string> names;
        for (const auto& entry : list->entries) {
            VX_TRY_ASSIGN(std::string name, read_name(entry.second, "a block's name"));
            if (registry_->find_block(name) == BlockId::unknown)
                return bad(fmt::format("hotbar: there is no block {}", name));
            names.push_back(std::move(name));
        }
        registry_->hotbar = std::move(names);
        return {};
    }

    Result<> define_terrain(std::span<const Value> a) { return terrain_.define_terrain(a); }
    Result<> define_terrain_layer(std::span<const Value> a) { return terrain_.define_layer(a); }
    Result<> define_terrain_biome(std::span<const Value> a) { return terrain_.define_biome(a); }
    Result<> define_cave_biome(std::span<const Value> a) { return terrain_.define_cave_biome(a); }
    Result<> define_terrain_feature(std::span<const Value> a) { return terrain_.define_feature(a); }
    Result<> define_decorator(std::span<const Value> a) { return terrain_.define_decorator(a); }

    // Errors: those of TerrainReader::finish.
    Result<Content> take() {
        VX_TRY_ASSIGN(auto terrain, terrain_.finish(*registry_));
        return Content{std::move(registry_), std::move(terrain)};
    }

private:
    // Counted before anything is kept: a few lines of Lua can ask for much.
    Result<> add_block(BlockDef def) {
        std::unordered_set<std::string_view> names;
        const auto note = [&](const BlockLook& look) {
            names.insert(look.textures.begin(), look.textures.end());
            for (const BoxDef& box : look.boxes)
                names.insert(box.texture);
            boxes_ += look.boxes.size();
        };
        note(def.look);
        for (const BlockVariant& variant : def.variants)
            note(variant.look);
        looks_ += def.variants.size() + 1;
        const auto over = [](const char* what, std::size_t most) {
            return fail(ErrorCode::limit, fmt::format("more than {} {}", most, what));
        };
        if (registry_->blocks().size() >= kContentBlocksMost) return over("blocks", kContentBlocksMost);
        if (looks_ > kLooksMost) return over("looks of states", kLooksMost);
        if (boxes_ > kBoxesInAllMost) return over("boxes", kBoxesInAllMost);
        if (registry_->textures().size() + names.size() > kContentTexturesMost)
            return over("textures", kContentTexturesMost);
        registry_->add_block(std::move(def));
        return {};
    }

    std::shared_ptr<BlockRegistry> registry_ = std::make_shared<BlockRegistry>();
    TerrainReader terrain_;
    std::size_t biomes_ = 0, looks_ = 0, boxes_ = 0;
};

Result<std::string> read_text(const std::filesystem::path& path) {
    std::error_code error;
    const std::uintmax_t size = std::filesystem::file_size(path, error);
    if (error) return fail(ErrorCode::io, fmt::format("{}: {}", path.string(), error.message()));
    if (size > kContentFileBytesMost)
        return fail(ErrorCode::limit, fmt::format("{}: longer than {} bytes", path.string(), kContentFileBytesMost));
    std::ifstream file(path, std::ios::binary);
    std::string text(std::size_t(size), '\0');
    if (!file.read(text.data(), std::streamsize(size)))
        return fail(ErrorCode::io, fmt::format("{}: cannot be read", path.string()));
    return text;
}

} // namespace

Result<Content> load_content_texts(std::span<const ContentFile> files, u64 instructions_most) {
    lua::SandboxLimits limits;
    limits.instructions_most = instructions_most;
    limits.source_bytes_most = kContentFileBytesMost;
    VX_TRY_ASSIGN(auto sandbox, lua::Sandbox::create(limits));
    ContentBuilder builder;
    const auto give = [&](const char* name, Result<> (ContentBuilder::*function)(std::span<const Value>)) {
        sandbox->set_function(
            name, [&builder, function](std::span<const Value> arguments) { return (builder.*function)(arguments); });
    };
    give("define_block", &ContentBuilder::define_block);
    give("define_material", &ContentBuilder::define_material);
    give("define_texture", &ContentBuilder::define_texture);
    give("define_biome", &ContentBuilder::define_biome);
    give("define_hotbar", &ContentBuilder::define_hotbar);
    give("define_terrain", &ContentBuilder::define_terrain);
    give("define_terrain_layer", &ContentBuilder::define_terrain_layer);
    give("define_terrain_biome", &ContentBuilder::define_terrain_biome);
    give("define_cave_biome", &ContentBuilder::define_cave_biome);
    give("define_terrain_feature", &ContentBuilder::define_terrain_feature);
    give("define_decorator", &ContentBuilder::define_decorator);
    u64 hash = 0;
    for (const ContentFile& file : files) {
        hash = XXH3_64bits_withSeed(file.name.data(), file.name.size(), hash);
        hash = XXH3_64bits_withSeed(file.text.data(), file.text.size(), hash);
        VX_TRY(sandbox->run(file.text, file.name));
    }
    VX_TRY_ASSIGN(Content content, builder.take());
    content.registry->content_hash = hash;
    return content;
}

Result<Content> load_content(std::span<const std::filesystem::path> roots) {
    std::vector<ContentFile> files;
    for (const std::filesystem::path& root : roots) {
        std::error_code error;
        std::vector<std::filesystem::path> paths;
        std::filesystem::directory_iterator it(root, error);
        if (error)
            return fail(ErrorCode::not_found, fmt::format("content folder {}: {}", root.string(), error.message()));
        for (; it != std::filesystem::directory_iterator(); it.increment(error)) {
            if (it->path().extension() == ".lua") paths.push_back(it->path());
            if (files.size() + paths.size() > kContentFilesMost)
                return fail(ErrorCode::limit,
                            fmt::format("content folder {}: more than {} files", root.string(), kContentFilesMost));
        }
        if (error) return fail(ErrorCode::io, fmt::format("content folder {}: {}", root.string(), error.message()));
        std::sort(paths.begin(), paths.end());
        // Lua cuts long names of chunks, so a file is called by its folder and name.
        const std::filesystem::path folder = root.filename().empty() ? root.parent_path().filename() : root.filename();
        for (const std::filesystem::path& path : paths) {
            VX_TRY_ASSIGN(std::string text, read_text(path));
            files.push_back({(folder / path.filename()).string(), std::move(text)});
        }
    }
    VX_TRY_ASSIGN(Content content, load_content_texts(files));
    for (auto root = roots.rbegin(); root != roots.rend(); ++root)
        content.registry->content_roots.push_back(root->string());
    return content;
}

} // namespace vitrail
