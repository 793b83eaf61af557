#include "formats/block_model_json.h"

#include "formats/json_bounds.h"
#include "formats/resource_pack.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace vitrail {

using nlohmann::json;

namespace {

constexpr std::size_t kMaxName = 256;

Result<std::string> text_of(const json& value, const char* what) {
    if (!value.is_string()) return fail(ErrorCode::damaged, fmt::format("{} is no text", what));
    const std::string& text = value.get_ref<const std::string&>();
    if (text.size() > kMaxName) return fail(ErrorCode::limit, fmt::format("{} is too long", what));
    return text;
}

Result<std::string> name_of(const json& value, const char* what) {
    VX_TRY_ASSIGN(const std::string text, text_of(value, what));
    VX_TRY_ASSIGN(const ResourceName name, parse_resource_name(text));
    return name.text();
}

Result<float> number_of(const json& value, const char* what, float low, float high) {
    if (!value.is_number()) return fail(ErrorCode::damaged, fmt::format("{} is no number", what));
    const double v = value.get<double>();
    if (!std::isfinite(v)) return fail(ErrorCode::damaged, fmt::format("{} is no number", what));
    return float(std::clamp(v, double(low), double(high)));
}

template <std::size_t N>
Result<std::array<float, N>> numbers_of(const json& value, const char* what, float low, float high) {
    if (!value.is_array() || value.size() != N)
        return fail(ErrorCode::damaged, fmt::format("{} is no list of {} numbers", what, N));
    std::array<float, N> out{};
    for (std::size_t i = 0; i < N; ++i) {
        VX_TRY_ASSIGN(out[i], number_of(value[i], what, low, high));
    }
    return out;
}

std::optional<u8> direction_of(std::string_view name) {
    constexpr std::array<std::string_view, 6> kNames{"west", "east", "down", "up", "north", "south"};
    if (name == "bottom") name = "down";
    if (name == "top") name = "up";
    for (u8 i = 0; i < 6; ++i)
        if (kNames[i] == name) return i;
    return std::nullopt;
}

Result<ModelFaceJson> parse_face(const json& value) {
    if (!value.is_object()) return fail(ErrorCode::damaged, "a face is no object");
    ModelFaceJson face;
    if (const auto it = value.find("texture"); it != value.end()) {
        VX_TRY_ASSIGN(face.texture, text_of(*it, "a face's texture"));
    }
    if (const auto it = value.find("uv"); it != value.end()) {
        VX_TRY_ASSIGN(face.uv, (numbers_of<4>(*it, "uv", -256, 256)));
    }
    if (const auto it = value.find("rotation"); it != value.end()) {
        VX_TRY_ASSIGN(const float degrees, number_of(*it, "a face's rotation", -3600, 3600));
        face.turns = u8(((i32(std::lround(degrees / 90)) % 4) + 4) % 4);
    }
    if (const auto it = value.find("cullface"); it != value.end()) {
        VX_TRY_ASSIGN(const std::string side, text_of(*it, "cullface"));
        face.cull = direction_of(side).value_or(6);
    }
    if (const auto it = value.find("tintindex"); it != value.end() && it->is_number()) {
        VX_TRY_ASSIGN(const float index, number_of(*it, "tintindex", -1, 255));
        face.tint = i32(index);
    }
    return face;
}

Result<ModelElementJson> parse_element(const json& value) {
    if (!value.is_object()) return fail(ErrorCode::damaged, "an element is no object");
    ModelElementJson element;
    if (!value.contains("from") || !value.contains("to"))
        return fail(ErrorCode::damaged, "an element has no from and to");
    VX_TRY_ASSIGN(element.from, (numbers_of<3>(value["from"], "from", -16, 32)));
    VX_TRY_ASSIGN(element.to, (numbers_of<3>(value["to"], "to", -16, 32)));
    if (const auto it = value.find("rotation"); it != value.end() && it->is_object()) {
        ModelElementJson::Rotation r;
        if (const auto origin = it->find("origin"); origin != it->end()) {
            VX_TRY_ASSIGN(r.origin, (numbers_of<3>(*origin, "origin", -256, 256)));
        }
        if (const auto axis = it->find("axis"); axis != it->end()) {
            VX_TRY_ASSIGN(const std::string name, text_of(*axis, "axis"));
            if (name != "x" && name != "y" && name != "z")
                return fail(ErrorCode::damaged, "a rotation's axis is not x, y or z");
            r.axis = u8(name[0] - 'x');
        }
        if (const auto angle = it->find("angle"); angle != it->end()) {
            VX_TRY_ASSIGN(r.degrees, number_of(*angle, "angle", -360, 360));
        }
        if (const auto rescale = it->find("rescale"); rescale != it->end() && rescale->is_boolean())
            r.rescale = rescale->get<bool>();
        if (r.degrees != 0) element.rotation = r;
    }
    if (const auto it = value.find("shade"); it != value.end() && it->is_boolean()) element.shade = it->get<bool>();
    if (const auto it = value.find("faces"); it != value.end()) {
        if (!it->is_object()) return fail(ErrorCode::damaged, "faces is no object");
        for (const auto& [side, face] : it->items()) {
            const auto direction = direction_of(side);
            if (!direction) continue;
            VX_TRY_ASSIGN(element.faces[*direction], parse_face(face));
        }
    }
    return element;
}

Result<ModelVariantJson> parse_variant(const json& value) {
    if (!value.is_object() || !value.contains("model")) return fail(ErrorCode::damaged, "a variant names no model");
    ModelVariantJson out;
    VX_TRY_ASSIGN(out.model, name_of(value["model"], "model"));
    const auto turn = [&](const char* key, u16& into) -> Result<> {
        const auto it = value.find(key);
        if (it == value.end()) return {};
        VX_TRY_ASSIGN(const float degrees, number_of(*it, key, -3600, 3600));
        into = u16(((i32(std::lround(degrees / 90)) % 4) + 4) % 4 * 90);
        return {};
    };
    VX_TRY(turn("x", out.x));
    VX_TRY(turn("y", out.y));
    if (const auto it = value.find("uvlock"); it != value.end() && it->is_boolean()) out.uv_lock = it->get<bool>();
    if (const auto it = value.find("weight"); it != value.end()) {
        VX_TRY_ASSIGN(const float weight, number_of(*it, "weight", 1, 65535));
        out.weight = u32(weight);
    }
    return out;
}

Result<ModelChoice> parse_choice(const json& value) {
    ModelChoice out;
    if (!value.is_array()) {
        VX_TRY_ASSIGN(out.emplace_back(), parse_variant(value));
        return out;
    }
    if (value.empty() || value.size() > BlockstatesJson::kMaxChoices)
        return fail(ErrorCode::limit, "a list of variants is empty or too long");
    for (const json& one : value) {
        VX_TRY_ASSIGN(out.emplace_back(), parse_variant(one));
    }
    return out;
}

StateTerm term_of(std::string property, std::string_view values) {
    StateTerm term;
    term.property = std::move(property);
    if (values.starts_with('!')) term.negated = true, values.remove_prefix(1);
    for (;;) {
        const std::size_t bar = values.find('|');
        if (term.values.size() < BlockstatesJson::kMaxTerms) term.values.emplace_back(values.substr(0, bar));
        if (bar == std::string_view::npos) break;
        values.remove_prefix(bar + 1);
    }
    return term;
}

// "a=b,c=d"; "" and "normal" match all.
Result<StateCondition> parse_key(std::string_view key) {
    std::vector<StateTerm> terms;
    if (key.size() > 1024) return fail(ErrorCode::limit, "a variant's name is too long");
    while (!key.empty()) {
        const std::string_view part = key.substr(0, key.find(','));
        key.remove_prefix(std::min(part.size() + 1, key.size()));
        const std::size_t equals = part.find('=');
        if (equals != std::string_view::npos)
            terms.push_back(term_of(std::string(part.substr(0, equals)), part.substr(equals + 1)));
    }
    return terms.empty() ? StateCondition{} : StateCondition{std::move(terms)};
}

// An object of terms, or {"OR": [...]}, {"AND": [...]}, nested. Brought to a list of lists, which stays small or is an
// error.
Result<StateCondition> parse_when(const json& value, int depth) {
    if (!value.is_object() || depth > 8) return fail(ErrorCode::damaged, "a condition is no object");
    StateCondition out;
    if (const auto it = value.find("OR"); it != value.end() && it->is_array()) {
        for (const json& one : *it) {
            VX_TRY_ASSIGN(StateCondition part, parse_when(one, depth + 1));
            if (part.empty()) part.emplace_back();
            out.insert(out.end(), part.begin(), part.end());
            if (out.size() > BlockstatesJson::kMaxTerms) return fail(ErrorCode::limit, "a condition is too large");
        }
        return out;
    }
    if (const auto it = value.find("AND"); it != value.end() && it->is_array()) {
        out.emplace_back();
        for (const json& one : *it) {
            VX_TRY_ASSIGN(StateCondition part, parse_when(one, depth + 1));
            if (part.empty()) part.emplace_back();
            StateCondition both;
            for (const auto& a : out)
                for (const auto& b : part) {
                    if (both.size() >= BlockstatesJson::kMaxTerms || a.size() + b.size() > BlockstatesJson::kMaxTerms)
                        return fail(ErrorCode::limit, "a condition is too large");
                    both.push_back(a);
                    both.back().insert(both.back().end(), b.begin(), b.end());
                }
            out = std::move(both);
        }
        return out;
    }
    std::vector<StateTerm> terms;
    for (const auto& [property, wanted] : value.items()) {
        if (terms.size() >= BlockstatesJson::kMaxTerms || property.size() > kMaxName)
            return fail(ErrorCode::limit, "a condition is too large");
        if (wanted.is_string())
            terms.push_back(term_of(property, wanted.get_ref<const std::string&>()));
        else if (wanted.is_boolean() || wanted.is_number_integer())
            terms.push_back(term_of(property, wanted.dump()));
        else
            return fail(ErrorCode::damaged, fmt::format("the condition on {} is no text", property));
    }
    if (!terms.empty()) out.push_back(std::move(terms));
    return out;
}

} // namespace

Result<BlockModelJson> parse_block_model(ByteView text) {
    VX_TRY_ASSIGN(const json root, parse_json(text));
    if (!root.is_object()) return fail(ErrorCode::damaged, "a model is no object");
    BlockModelJson model;
    if (const auto it = root.find("parent"); it != root.end()) {
        VX_TRY_ASSIGN(model.parent, name_of(*it, "parent"));
    }
    if (const auto it = root.find("ambientocclusion"); it != root.end() && it->is_boolean())
        model.ambient_occlusion = it->get<bool>();
    if (const auto it = root.find("textures"); it != root.end()) {
        if (!it->is_object() || it->size() > BlockModelJson::kMaxTextures)
            return fail(ErrorCode::damaged, "textures is no object, or too large");
        for (const auto& [key, value] : it->items()) {
            const json* name = &value;
            if (value.is_object()) { // {"sprite": name, "force_translucent": ...}
                const auto sprite = value.find("sprite");
                if (sprite == value.end()) continue;
                name = &*sprite;
            }
            VX_TRY_ASSIGN(model.textures[key], text_of(*name, "a texture's name"));
        }
    }
    if (const auto it = root.find("elements"); it != root.end()) {
        if (!it->is_array()) return fail(ErrorCode::damaged, "elements is no list");
        if (it->size() > BlockModelJson::kMaxElements)
            return fail(ErrorCode::limit, fmt::format("{} elements are too many", it->size()));
        model.elements.emplace();
        for (const json& one : *it) {
            VX_TRY_ASSIGN(model.elements->emplace_back(), parse_element(one));
        }
    }
    return model;
}

Result<BlockstatesJson> parse_blockstates(ByteView text) {
    VX_TRY_ASSIGN(const json root, parse_json(text));
    if (!root.is_object()) return fail(ErrorCode::damaged, "blockstates are no object");
    BlockstatesJson out;
    if (const auto it = root.find("multipart"); it != root.end()) {
        if (!it->is_array() || it->size() > BlockstatesJson::kMaxCases)
            return fail(ErrorCode::damaged, "multipart is no list, or too long");
        out.multipart = true;
        for (const json& part : *it) {
            if (!part.is_object() || !part.contains("apply")) return fail(ErrorCode::damaged, "a part applies nothing");
            BlockstatesJson::Case one;
            if (const auto when = part.find("when"); when != part.end()) {
                VX_TRY_ASSIGN(one.when, parse_when(*when, 0));
            }
            VX_TRY_ASSIGN(one.apply, parse_choice(part["apply"]));
            out.cases.push_back(std::move(one));
        }
        return out;
    }
    const auto variants = root.find("variants");
    if (variants == root.end() || !variants->is_object())
        return fail(ErrorCode::damaged, "there are neither variants nor parts");
    if (variants->size() > BlockstatesJson::kMaxCases) return fail(ErrorCode::limit, "too many variants");
    for (const auto& [key, value] : variants->items()) {
        BlockstatesJson::Case one;
        VX_TRY_ASSIGN(one.when, parse_key(key));
        VX_TRY_ASSIGN(one.apply, parse_choice(value));
        out.cases.push_back(std::move(one));
    }
    return out;
}

ModelLibrary::ModelLibrary(Source source)
    : source_(std::move(source)) {}

Result<std::shared_ptr<const BlockModelJson>> ModelLibrary::file(const std::string& name) {
    if (const auto it = files_.find(name); it != files_.end()) return it->second;
    const auto read = [&]() -> Result<std::shared_ptr<const BlockModelJson>> {
        std::optional<Bytes> bytes = source_(name);
        if (!bytes) {
            const std::string_view builtin = builtin_block_model(name);
            if (builtin.empty()) return fail(ErrorCode::not_found, fmt::format("there is no model {}", name));
            bytes.emplace(builtin.begin(), builtin.end());
        }
        Result<BlockModelJson> model = parse_block_model(*bytes);
        if (!model) return fail(model.error().code, fmt::format("model {}: {}", name, model.error().message));
        return std::make_shared<const BlockModelJson>(std::move(*model));
    };
    return files_.emplace(name, read()).first->second;
}

Result<std::shared_ptr<const ResolvedModel>> ModelLibrary::resolve(const std::string& name) {
    if (const auto it = resolved_.find(name); it != resolved_.end()) return it->second;
    const auto make = [&]() -> Result<std::shared_ptr<const ResolvedModel>> {
        auto out = std::make_shared<ResolvedModel>();
        std::map<std::string, std::string, std::less<>> textures;
        std::optional<bool> occlusion;
        bool have_elements = false;
        std::string at = name;
        for (u32 depth = 0; !at.empty(); ++depth) {
            if (depth == kMaxParents)
                return fail(ErrorCode::limit, fmt::format("model {}: its parents have no end", name));
            if (at == "minecraft:builtin/generated" || at == "minecraft:builtin/entity") break;
            VX_TRY_ASSIGN(const std::shared_ptr<const BlockModelJson> model, file(at));
            textures.insert(model->textures.begin(), model->textures.end()); // the child's stay
            if (!occlusion) occlusion = model->ambient_occlusion;
            if (!have_elements && model->elements) out->elements = *model->elements, have_elements = true;
            at = model->parent;
        }
        out->ambient_occlusion = occlusion.value_or(true);
        for (ModelElementJson& element : out->elements)
            for (auto& face : element.faces) {
                if (!face) continue;
                // "#side" -> "#all" -> "block/stone"; a face may leave the # away.
                std::string key = face->texture, found;
                for (u32 step = 0; step < 32; ++step) {
                    const bool hashed = key.starts_with('#');
                    if (!hashed && step > 0) {
                        found = key;
                        break;
                    }
                    const auto it = textures.find(hashed ? std::string_view(key).substr(1) : std::string_view(key));
                    if (it == textures.end()) break;
                    key = it->second;
                }
                const auto named = parse_resource_name(found);
                if (!found.empty() && named) {
                    face->texture = named->text();
                    continue;
                }
                if (std::find(out->missing.begin(), out->missing.end(), key) == out->missing.end())
                    out->missing.push_back(key);
                face->texture.clear();
            }
        return out;
    };
    return resolved_.emplace(name, make()).first->second;
}

} // namespace vitrail
