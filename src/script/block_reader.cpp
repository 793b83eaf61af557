#include "script/block_reader.h"

#include "script/block_variants.h"
#include "script/content_loader.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace vitrail {

using lua::Value;

namespace {

constexpr std::size_t kNameSizeMost = 64;
constexpr std::size_t kBoxesMost = 64;
constexpr std::size_t kPropertiesMost = 32;
constexpr std::size_t kVariantsMost = 1024;

tl::unexpected<Error> bad(std::string message) {
    return fail(ErrorCode::invalid_argument, std::move(message));
}

tl::unexpected<Error> expected(const char* what, const Value& got) {
    const std::string text = got.text();
    if (text.empty() || text.size() > 64) return bad(fmt::format("expected {}, got {}", what, got.type_name()));
    return bad(fmt::format("expected {}, got {}", what, got.string() ? "\"" + text + "\"" : text));
}

bool is_word(std::string_view text) {
    return !text.empty() && text.size() <= kNameSizeMost && std::all_of(text.begin(), text.end(), [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_' || c == '.' || c == '-';
    });
}

Result<float> read_number(const Value& value, double least, double most) {
    const double v = value.number();
    if (!value.is_number() || !(v >= least && v <= most))
        return expected(fmt::format("a number from {} to {}", least, most).c_str(), value);
    return float(v);
}

Result<u8> read_whole(const Value& value, int least, int most) {
    const double v = value.number();
    if (!value.is_number() || !(v >= least && v <= most) || v != std::floor(v))
        return expected(fmt::format("a whole number from {} to {}", least, most).c_str(), value);
    return u8(v);
}

Result<bool> read_bool(const Value& value) {
    if (!value.boolean()) return expected("true or false", value);
    return *value.boolean();
}

// One of `names`; its place.
Result<std::size_t> read_choice(const Value& value, std::span<const char* const> names) {
    if (value.string())
        for (std::size_t i = 0; i < names.size(); ++i)
            if (*value.string() == names[i]) return i;
    return expected(fmt::format("one of {}", fmt::join(names, ", ")).c_str(), value);
}

Result<std::vector<std::string>> read_textures(const Value& value) {
    std::vector<std::string> out;
    if (value.string()) {
        VX_TRY_ASSIGN(std::string one, read_texture_name(value));
        out.push_back(std::move(one));
        return out;
    }
    const Value::Table* list = value.table();
    if (!list || !list->is_list() || list->entries.empty() || list->entries.size() > 6)
        return expected("a texture's name or a list of 1 to 6", value);
    for (const auto& entry : list->entries) {
        VX_TRY_ASSIGN(std::string one, read_texture_name(entry.second));
        out.push_back(std::move(one));
    }
    return out;
}

Result<std::vector<BoxDef>> read_boxes(const Value& value) {
    const Value::Table* list = value.table();
    if (!list || !list->is_list() || list->entries.size() > kBoxesMost)
        return expected("a list of at most 64 boxes {x0, y0, z0, x1, y1, z1[, texture]}", value);
    std::vector<BoxDef> out;
    for (const auto& entry : list->entries) {
        const Value::Table* box = entry.second.table();
        if (!box || !box->is_list() || box->entries.size() < 6 || box->entries.size() > 7)
            return expected("a box {x0, y0, z0, x1, y1, z1[, texture]}", entry.second);
        float c[6];
        for (std::size_t i = 0; i < 6; ++i) {
            VX_TRY_ASSIGN(c[i], read_number(box->entries[i].second, -32, 48));
        }
        if (c[0] > c[3] || c[1] > c[4] || c[2] > c[5])
            return bad(fmt::format("box {}: its first corner must be the lower one", out.size() + 1));
        BoxDef def{c[0], c[1], c[2], c[3], c[4], c[5], {}};
        if (box->entries.size() == 7) {
            VX_TRY_ASSIGN(def.texture, read_texture_name(box->entries[6].second));
        }
        out.push_back(std::move(def));
    }
    return out;
}

Result<> read_tint(const Value& value, BlockLook& look) {
    if (value.table()) {
        VX_TRY_ASSIGN(look.tint_color, read_triple(value, 255, false));
        look.tint = TintKind::fixed;
        return {};
    }
    static constexpr const char* names[] = {"none", "grass", "foliage", "water"};
    const auto choice = read_choice(value, names);
    if (!choice) return expected("none, grass, foliage, water or {r, g, b}", value);
    look.tint = TintKind(*choice);
    return {};
}

Result<std::array<float, 3>> read_absorption(const Value& value) {
    const Value::Table* list = value.table();
    if (!list || !list->is_list() || list->entries.size() != 3)
        return expected("{red, green, blue}, each 0 to 100 a block", value);
    std::array<float, 3> out{};
    for (std::size_t i = 0; i < 3; ++i) {
        VX_TRY_ASSIGN(out[i], read_number(list->entries[i].second, 0, 100));
    }
    return out;
}

// A look while it is being laid together: whether opacity was said or follows from the rest.
struct LookBuilder {
    BlockLook look;
    bool opacity_said = false;

    BlockLook finished() const {
        BlockLook out = look;
        const bool full = out.shape == ShapeKind::cube || out.shape == ShapeKind::pillar;
        if (!opacity_said) out.opacity = full && out.layer == RenderLayer::solid ? 15 : 0;
        return out;
    }

    // False where the key is none of a look's.
    Result<bool> set(const std::string& key, const Value& value) {
        static constexpr const char* layers[] = {"solid", "cutout", "cutout_mipped", "translucent"};
        static constexpr const char* tint_faces[] = {"all", "top"};
        if (key == "texture" || key == "textures") {
            VX_TRY_ASSIGN(look.textures, read_textures(value));
        } else if (key == "shape") {
            VX_TRY_ASSIGN(const std::size_t kind, read_choice(value, kShapeKindNames));
            look.shape = ShapeKind(kind);
        } else if (key == "boxes") {
            VX_TRY_ASSIGN(look.boxes, read_boxes(value));
        } else if (key == "layer") {
            VX_TRY_ASSIGN(const std::size_t layer, read_choice(value, layers));
            look.layer = RenderLayer(layer);
        } else if (key == "transparency") {
            VX_TRY_ASSIGN(look.transparency, read_number(value, 0, 1));
        } else if (key == "opacity") {
            VX_TRY_ASSIGN(look.opacity, read_whole(value, 0, 15));
            opacity_said = true;
        } else if (key == "light") {
            VX_TRY_ASSIGN(look.light, read_triple(value, 15, true));
        } else if (key == "hardness") {
            VX_TRY_ASSIGN(look.hardness, read_number(value, -1, 1e6));
        } else if (key == "viscosity") {
            VX_TRY_ASSIGN(look.viscosity, read_number(value, 0, 1));
        } else if (key == "collision") {
            VX_TRY_ASSIGN(look.collision, read_bool(value));
        } else if (key == "tint") {
            VX_TRY(read_tint(value, look));
        } else if (key == "tint_faces") {
            VX_TRY_ASSIGN(const std::size_t faces, read_choice(value, tint_faces));
            look.tint_faces = TintFaces(faces);
        } else if (key == "material") {
            if (!value.string() || !is_word(*value.string())) return expected("a material's name", value);
            look.material = *value.string();
        } else if (key == "replaceable") {
            VX_TRY_ASSIGN(look.replaceable, read_bool(value));
        } else if (key == "climbable") {
            VX_TRY_ASSIGN(look.climbable, read_bool(value));
        } else if (key == "sway") {
            VX_TRY_ASSIGN(look.sway, read_bool(value));
        } else if (key == "optics") {
            VX_TRY_ASSIGN(const std::size_t kind, read_choice(value, kOpticsKindNames));
            look.optics = OpticsKind(kind);
        } else if (key == "ior") {
            VX_TRY_ASSIGN(look.ior, read_number(value, 1, 4));
        } else if (key == "absorption") {
            VX_TRY_ASSIGN(look.absorption, read_absorption(value));
        } else
            return false;
        return true;
    }

    Result<> set_all(const Value::Table& fields) {
        for (const auto& [key, value] : fields.entries) {
            if (!key.string()) return bad("keys are names");
            Result<bool> known = set(*key.string(), value);
            if (!known) return bad(*key.string() + ": " + known.error().message);
            if (!*known) return bad(fmt::format("unknown key {}", *key.string()));
        }
        return {};
    }
};

Result<std::vector<PropertyDef>> read_properties(const Value& value) {
    std::vector<PropertyDef> out;
    const Value::Table* table = value.table();
    if (!table || table->entries.size() > kPropertiesMost)
        return expected("a table of at most 32 properties name = {values}", value);
    u64 states = 1;
    for (const auto& [key, list] : table->entries) {
        if (!key.string() || !is_word(*key.string())) return expected("a property's name", key);
        PropertyDef def{*key.string(), {}, {}};
        if (!list.table() || !list.table()->is_list() || list.table()->entries.empty() ||
            list.table()->entries.size() > 64)
            return bad(fmt::format("{}: expected a list of 1 to 64 values", def.name));
        for (const auto& entry : list.table()->entries) {
            std::string text = entry.second.text();
            if (!is_word(text))
                return bad(fmt::format("{}: a value is a short name, a whole number or a boolean", def.name));
            if (std::find(def.values.begin(), def.values.end(), text) != def.values.end())
                return bad(fmt::format("{}: the value {} is there twice", def.name, text));
            def.values.push_back(std::move(text));
        }
        def.default_value = def.values.front();
        states *= def.values.size();
        if (states > kBlockStatesMost)
            return fail(ErrorCode::limit, fmt::format("more than {} states", kBlockStatesMost));
        out.push_back(std::move(def));
    }
    return out;
}

Result<> read_defaults(const Value& value, std::vector<PropertyDef>& properties) {
    if (!value.table()) return expected("a table of values by property", value);
    for (const auto& [key, given] : value.table()->entries) {
        const auto property = std::find_if(properties.begin(), properties.end(), [&](const PropertyDef& p) {
            return key.string() && p.name == *key.string();
        });
        if (property == properties.end()) return bad(fmt::format("there is no property {}", key.text()));
        const std::string text = given.text();
        if (std::find(property->values.begin(), property->values.end(), text) == property->values.end())
            return expected(fmt::format("one of {} for {}", fmt::join(property->values, ", "), property->name).c_str(),
                            given);
        property->default_value = text;
    }
    return {};
}

Result<std::vector<WrittenVariant>> read_variants(const Value& value, const std::vector<PropertyDef>& properties) {
    if (!value.table() || value.table()->entries.size() > kVariantsMost)
        return expected("a table of at most 1024 variants", value);
    std::vector<WrittenVariant> out;
    for (const auto& [key, fields] : value.table()->entries) {
        if (!key.string()) return expected("a key such as \"lit=true\"", key);
        if (!fields.table())
            return bad(fmt::format("\"{}\": expected a table of overrides, got {}", *key.string(), fields.type_name()));
        VX_TRY_ASSIGN(auto when, parse_conditions(*key.string(), properties));
        out.push_back({*key.string(), std::move(when), fields.table()});
    }
    return out;
}

Result<> read_definition(const Value::Table& table, BlockDef& def) {
    const auto in = [](const char* key, Error error) {
        error.message = std::string(key) + ": " + error.message;
        return tl::unexpected(std::move(error));
    };
    LookBuilder base;
    const Value *defaults = nullptr, *variants = nullptr;
    for (const auto& [key, value] : table.entries) { // properties first: the others refer to them
        if (!key.string()) return bad("keys are names");
        if (*key.string() != "properties") continue;
        auto properties = read_properties(value);
        if (!properties) return in("properties", properties.error());
        def.properties = std::move(*properties);
    }
    for (const auto& [key, value] : table.entries) {
        const std::string& name = *key.string();
        if (name == "properties") continue;
        if (name == "default")
            defaults = &value;
        else if (name == "variants")
            variants = &value;
        else if (name == "hidden_from_hotbar") {
            auto hidden = read_bool(value);
            if (!hidden) return in(name.c_str(), hidden.error());
            def.in_hotbar_list = !*hidden;
        } else {
            auto known = base.set(name, value);
            if (!known) return in(name.c_str(), known.error());
            if (!*known) return bad(fmt::format("unknown key {}", name));
        }
    }
    if (defaults)
        if (auto done = read_defaults(*defaults, def.properties); !done) return in("default", done.error());
    def.look = base.finished();
    if (!variants) return {};
    auto written = read_variants(*variants, def.properties);
    if (!written) return in("variants", written.error());
    auto resolved = resolve_variants(def.properties, std::move(*written), [&](const auto& layers) -> Result<BlockLook> {
        LookBuilder look = base;
        for (const WrittenVariant* layer : layers)
            if (auto done = look.set_all(*layer->fields); !done)
                return bad(fmt::format("\"{}\": {}", layer->key, done.error().message));
        return look.finished();
    });
    if (!resolved) return in("variants", resolved.error());
    def.variants = std::move(*resolved);
    return {};
}

} // namespace

Result<std::string> read_name(const Value& name, const char* what) {
    if (!name.string()) return expected(what, name);
    std::string text = *name.string();
    if (text.find(':') == std::string::npos) text = "minecraft:" + text;
    const std::size_t colon = text.find(':');
    std::string path = text.substr(colon + 1);
    std::replace(path.begin(), path.end(), '/', '_');
    if (!is_word(text.substr(0, colon)) || !is_word(path)) return expected(what, name);
    return text;
}

Result<std::string> read_texture_name(const Value& name) {
    const std::string* text = name.string();
    if (!text || text->size() > kNameSizeMost || text->starts_with('/') || text->find("..") != std::string::npos)
        return expected("a texture's name", name);
    std::string plain = *text;
    std::replace(plain.begin(), plain.end(), '/', '_');
    if (!is_word(plain)) return expected("a texture's name", name);
    return *text;
}

Result<std::array<u8, 3>> read_triple(const Value& value, int most, bool one_number) {
    if (one_number && value.is_number()) {
        VX_TRY_ASSIGN(const u8 v, read_whole(value, 0, most));
        return std::array<u8, 3>{v, v, v};
    }
    const Value::Table* list = value.table();
    if (!list || !list->is_list() || list->entries.size() != 3)
        return expected(
            fmt::format("{}{{red, green, blue}} of 0 to {}", one_number ? "a number or " : "", most).c_str(), value);
    std::array<u8, 3> out{};
    for (std::size_t i = 0; i < 3; ++i) {
        VX_TRY_ASSIGN(out[i], read_whole(list->entries[i].second, 0, most));
    }
    return out;
}

Result<BlockDef> read_block(const Value& name, const Value& definition) {
    BlockDef def;
    VX_TRY_ASSIGN(def.name, read_name(name, "a block's name such as \"minecraft:stone\""));
    if (!definition.table()) return bad(fmt::format("{}: expected a table, got {}", def.name, definition.type_name()));
    if (Result<> done = read_definition(*definition.table(), def); !done) {
        Error error = std::move(done).error();
        error.message = def.name + ": " + error.message;
        return tl::unexpected(std::move(error));
    }
    return def;
}

} // namespace vitrail
