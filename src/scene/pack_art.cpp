#include "scene/pack_art.h"

#include "formats/json_bounds.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace vitrail::scene {

namespace {

struct Meta {
    bool animated = false, interpolate = false;
    u32 frame_time = 1, width = 0, height = 0;
    std::vector<TextureArt::Step> steps;
};

u32 whole(const nlohmann::json& object, const char* key, u32 otherwise, u32 most) {
    const auto it = object.find(key);
    if (it == object.end() || !it->is_number()) return otherwise;
    const double v = it->get<double>();
    return v >= 1 && v <= double(most) ? u32(v) : otherwise;
}

Result<Meta> parse_meta(ByteView text) {
    VX_TRY_ASSIGN(const nlohmann::json root, parse_json(text));
    Meta meta;
    if (!root.is_object()) return fail(ErrorCode::damaged, "is no object");
    const auto animation = root.find("animation");
    if (animation == root.end() || !animation->is_object()) return meta;
    meta.animated = true;
    meta.frame_time = whole(*animation, "frametime", 1, 32767);
    meta.width = whole(*animation, "width", 0, 4096);
    meta.height = whole(*animation, "height", 0, 65536);
    if (const auto it = animation->find("interpolate"); it != animation->end() && it->is_boolean())
        meta.interpolate = it->get<bool>();
    const auto frames = animation->find("frames");
    if (frames == animation->end() || !frames->is_array()) return meta;
    for (const auto& frame : *frames) {
        if (meta.steps.size() == ArtLimits::kMaxSteps) break;
        const nlohmann::json* index = &frame;
        u32 ticks = meta.frame_time;
        if (frame.is_object()) {
            const auto it = frame.find("index");
            if (it == frame.end()) continue;
            index = &*it;
            ticks = whole(frame, "time", ticks, 32767);
        }
        if (!index->is_number()) continue;
        const double v = index->get<double>();
        if (v >= 0 && v < 65535) meta.steps.push_back({u16(v), u16(ticks)});
    }
    return meta;
}

// Frames of width x height made square, at most `side_most`, by averages: of pictures by alpha, of maps each channel
// for itself.
Image square_frames(const Image& image, u32 width, u32 height, u32 frames, u32 side_most, bool map) {
    if (width == height && image.width == width && width <= side_most) {
        Image whole = image;
        whole.height = height * frames;
        whole.pixels.resize(std::size_t(whole.width) * whole.height * 4);
        return whole;
    }
    const u32 side = std::min(std::max(width, height), side_most);
    Image out{side, side * frames, 4, std::vector<u8>(std::size_t(side) * side * frames * 4)};
    const u32 columns = std::max(image.width / width, 1u);
    for (u32 f = 0; f < frames; ++f) {
        const u32 left = f % columns * width, top = f / columns * height;
        for (u32 y = 0; y < side; ++y)
            for (u32 x = 0; x < side; ++x) {
                const u32 x0 = x * width / side, x1 = std::max((x + 1) * width / side, x0 + 1);
                const u32 y0 = y * height / side, y1 = std::max((y + 1) * height / side, y0 + 1);
                u32 sum[4] = {}, weight = 0, count = 0;
                for (u32 v = y0; v < y1; ++v)
                    for (u32 u = x0; u < x1; ++u) {
                        const u8* p =
                            image.at(std::min(left + u, image.width - 1), std::min(top + v, image.height - 1));
                        const u32 share = map ? 1u : p[3];
                        for (u32 c = 0; c < 3; ++c)
                            sum[c] += u32(p[c]) * share;
                        sum[3] += p[3], weight += share, ++count;
                    }
                u8* to = out.at(x, f * side + y);
                for (u32 c = 0; c < 3; ++c)
                    to[c] = weight ? u8((sum[c] + weight / 2) / weight) : 0;
                to[3] = u8((sum[3] + count / 2) / count);
            }
    }
    return out;
}

struct Frames {
    u32 width, height, count;
};

Frames frames_of(const Image& image, const Meta& meta, u32 most) {
    // Without a word of the pack a strip is cut into squares.
    u32 width = meta.width ? std::min(meta.width, image.width) : image.width;
    u32 height = meta.height ? std::min(meta.height, image.height) : 0;
    if (!meta.width && !meta.height && image.width > image.height) width = image.height;
    if (!height) height = meta.animated ? std::min(width, image.height) : image.height;
    if (!meta.animated) return {image.width, image.height, 1};
    return {width, height, std::min(std::max(image.width / width * (image.height / height), 1u), most)};
}

// Keeps one channel and gives it to red (and green, blue); `map` gives the new value.
template <class Map>
Image channel(const Image& from, Map&& map) {
    Image out = from;
    for (std::size_t i = 0; i < out.pixels.size(); i += 4) {
        const u8 v = map(&from.pixels[i]);
        out.pixels[i] = out.pixels[i + 1] = out.pixels[i + 2] = v;
        out.pixels[i + 3] = 255;
    }
    return out;
}

} // namespace

AlphaKind alpha_kind(const Image& rgba) {
    if (rgba.channels != 4) return AlphaKind::full;
    AlphaKind kind = AlphaKind::full;
    for (std::size_t i = 3; i < rgba.pixels.size(); i += 4) {
        const u8 a = rgba.pixels[i];
        if (a == 255) continue;
        // Almost clear and almost full are what drawing programs leave behind.
        if (a > 8 && a < 248) return AlphaKind::partial;
        if (a <= 8) kind = AlphaKind::holes;
    }
    return kind;
}

std::string glow_suffix(const ResourcePack& pack) {
    for (const char* path : {"minecraft/optifine/emissive.properties", "minecraft/mcpatcher/emissive.properties"}) {
        const auto bytes = pack.read(path, 4096);
        if (!bytes) continue;
        const std::string_view text(reinterpret_cast<const char*>(bytes->data()), bytes->size());
        const std::size_t at = text.find("suffix.emissive=");
        if (at == std::string_view::npos) continue;
        std::string_view suffix = text.substr(at + 16);
        suffix = suffix.substr(0, suffix.find_first_of(" \t\r\n"));
        if (!suffix.empty() && suffix.size() < 32 && suffix.find('/') == std::string_view::npos)
            return std::string(suffix);
    }
    return "_e";
}

std::optional<TextureArt> load_art(const ResourcePack& pack, const std::string& path, const std::string& glow,
                                   const ArtLimits& limits, PackReport& report) {
    u64 decoded = 0;
    const auto picture = [&](const std::string& file) -> std::optional<Image> {
        if (!pack.contains(file)) return std::nullopt;
        Result<Bytes> bytes = pack.read(file, ArtLimits::kMaxPictureBytes);
        if (!bytes) return report.say(bytes.error().message), std::nullopt;
        Result<Image> image = decode_png(*bytes);
        if (!image)
            return report.say(fmt::format("{}: {}: {}", pack.info().name, file, image.error().message)), std::nullopt;
        decoded += image->pixels.size();
        return std::move(*image);
    };
    std::optional<Image> albedo = picture(path + ".png");
    if (!albedo) return std::nullopt;
    Meta meta;
    if (const std::string file = path + ".png.mcmeta"; pack.contains(file)) {
        const auto bytes = pack.read(file, kMaxJsonBytes);
        const auto parsed = bytes ? parse_meta(*bytes) : Result<Meta>(tl::unexpected(bytes.error()));
        if (parsed)
            meta = *parsed;
        else
            report.say(fmt::format("{}: {}: {}", pack.info().name, file, parsed.error().message));
    } else if (albedo->height > albedo->width && albedo->height % albedo->width == 0) {
        meta.animated = true; // a strip without a word about it
    }
    TextureArt art;
    art.name = path;
    art.old_names = pack.info().old_names();
    const Frames frames = frames_of(*albedo, meta, limits.frames_most);
    art.albedo = square_frames(*albedo, frames.width, frames.height, frames.count, limits.side_most, false);
    art.interpolate = meta.interpolate;
    for (TextureArt::Step& step : meta.steps)
        if (step.frame < frames.count) art.steps.push_back(step);
    if (meta.steps.empty() && frames.count > 1)
        for (u32 f = 0; f < frames.count; ++f)
            art.steps.push_back({u16(f), u16(meta.frame_time)});
    if (art.steps.size() == 1 && art.steps[0].frame == 0) art.steps.clear();

    const auto map = [&](const std::string& file) -> Image {
        std::optional<Image> image = picture(file);
        if (!image) return {};
        const Frames f = frames_of(*image, meta, limits.frames_most);
        return square_frames(*image, f.width, f.height, f.count, limits.side_most, true);
    };
    // LabPBR 1.3.
    if (Image n = map(path + "_n.png"); n.width) art.normal = std::move(n);
    if (const Image s = map(path + "_s.png"); s.width) {
        art.roughness = channel(s, [](const u8* p) {
            const float rough = 1 - float(p[0]) / 255;
            return u8(rough * rough * 255 + 0.5f);
        });
        if (std::any_of(s.pixels.begin(), s.pixels.end(),
                        [i = std::size_t(0)](u8 v) mutable { return i++ % 4 == 3 && v > 0 && v < 255; }))
            art.emission = channel(s, [](const u8* p) { return p[3] == 255 ? u8(0) : u8(p[3] * 255 / 254); });
    }
    // OptiFine's glow is a picture drawn over the block's at full light.
    if (const Image e = map(path + glow + ".png"); e.width) {
        const u32 side = art.albedo.width;
        Image emission = art.emission.width == side
                             ? art.emission
                             : Image{side, art.albedo.height, 4, std::vector<u8>(art.albedo.pixels.size(), 0)};
        emission.height = art.albedo.height, emission.pixels.resize(art.albedo.pixels.size());
        for (u32 y = 0; y < art.albedo.height; ++y)
            for (u32 x = 0; x < side; ++x) {
                const u32 frame = y / side % std::max(e.height / e.width, 1u);
                const u8* glowing =
                    e.at(x * e.width / side, std::min(frame * e.width + y % side * e.width / side, e.height - 1));
                if (glowing[3] == 0) continue;
                u8* to = art.albedo.at(x, y);
                for (u32 c = 0; c < 3; ++c)
                    to[c] = u8((u32(glowing[c]) * glowing[3] + u32(to[c]) * (255u - glowing[3])) / 255);
                to[3] = std::max(to[3], glowing[3]);
                // A dark texel gives off little, whatever its alpha.
                const u8 bright = std::max({glowing[0], glowing[1], glowing[2]});
                u8* light = emission.at(x, y);
                light[0] = light[1] = light[2] = std::max<u8>(light[0], u8(u32(glowing[3]) * bright / 255));
                light[3] = 255;
            }
        art.emission = std::move(emission);
    }
    art.alpha = alpha_kind(art.albedo);
    art.decoded_bytes = decoded;
    return art;
}

namespace {

// Where the texel (x, y) of `side` texels of an upright face lies in a layer's picture of `of` texels.
std::array<u32, 2> source_of(const FaceLayer& layer, u32 x, u32 y, u32 side, u32 of) {
    float s = (float(x) + 0.5f) / float(side), t = (float(y) + 0.5f) / float(side);
    for (u32 i = 0; i < layer.turns; ++i) { // undoes one clockwise turn
        const float keep = s;
        s = t, t = 1 - keep;
    }
    const auto at = [&](float from, float to, float v) {
        const float texel = (from + (to - from) * v) / 16 * float(of);
        // Beyond the picture it repeats.
        const i32 i = i32(std::floor(texel)) % i32(of);
        return u32(i < 0 ? i + i32(of) : i);
    };
    return {at(layer.uv[0], layer.uv[2], s), at(layer.uv[1], layer.uv[3], t)};
}

} // namespace

TextureArt compose_art(const std::vector<FaceLayer>& layers, std::string name) {
    TextureArt out;
    out.name = std::move(name);
    u32 side = 1, frames = 1;
    bool any_tinted = false, all_tinted = true;
    for (const FaceLayer& layer : layers) {
        const float shown = std::max(std::fabs(layer.uv[2] - layer.uv[0]), std::fabs(layer.uv[3] - layer.uv[1])) / 16;
        side = std::max(side, std::min(u32(std::ceil(float(layer.art->side()) * shown)), layer.art->side()));
        if (frames == 1 && layer.art->frames() > 1) {
            frames = layer.art->frames();
            out.steps = layer.art->steps, out.interpolate = layer.art->interpolate;
        }
        any_tinted |= layer.tinted, all_tinted &= layer.tinted;
        out.old_names |= layer.art->old_names;
    }
    out.tint_mask = any_tinted && !all_tinted;
    out.albedo = Image{side, side * frames, 4, std::vector<u8>(std::size_t(side) * side * frames * 4)};
    bool glows = false, rough = false, bumpy = false;
    for (const FaceLayer& layer : layers)
        glows |= layer.art->emission.width > 0, rough |= layer.art->roughness.width > 0,
            bumpy |= layer.art->normal.width > 0 && layers.size() == 1 && layer.turns == 0;
    const Image blank{side, side * frames, 4, std::vector<u8>(out.albedo.pixels.size(), 0)};
    if (glows) out.emission = blank;
    if (rough) out.roughness = blank;
    if (bumpy) out.normal = blank;
    for (u32 f = 0; f < frames; ++f)
        for (u32 y = 0; y < side; ++y)
            for (u32 x = 0; x < side; ++x) {
                u8* to = out.albedo.at(x, f * side + y);
                u32 mask = 0;
                bool first = true;
                for (const FaceLayer& layer : layers) {
                    const auto sample = [&](const Image& image) {
                        const auto at = source_of(layer, x, y, side, image.width);
                        return image.at(at[0], f % (image.height / image.width) * image.width + at[1]);
                    };
                    const u8* p = sample(layer.art->albedo);
                    const u32 a = layers.size() == 1 ? 255u : first ? 255u : p[3];
                    for (u32 c = 0; c < 3; ++c)
                        to[c] = u8((p[c] * a + to[c] * (255 - a) + 127) / 255);
                    mask = (u32(layer.tinted ? 255 : 0) * a + mask * (255 - a) + 127) / 255;
                    if (layers.size() == 1) to[3] = p[3];
                    const auto lay = [&](const Image& from, Image& into, u8 otherwise) {
                        if (!into.width || a < 128) return;
                        u8* v = into.at(x, f * side + y);
                        if (!from.width)
                            v[0] = v[1] = v[2] = otherwise;
                        else
                            std::copy_n(sample(from), 3, v);
                        v[3] = 255;
                    };
                    lay(layer.art->emission, out.emission, 0);
                    lay(layer.art->roughness, out.roughness, 230);
                    lay(layer.art->normal, out.normal, 128);
                    if (bumpy) { // a mirrored picture is mirrored in its slopes
                        u8* v = out.normal.at(x, f * side + y);
                        if (layer.uv[0] > layer.uv[2]) v[0] = u8(255 - v[0]);
                        if (layer.uv[1] > layer.uv[3]) v[1] = u8(255 - v[1]);
                    }
                    first = false;
                }
                if (layers.size() > 1) to[3] = out.tint_mask ? u8(mask) : u8(255);
            }
    out.alpha = layers.size() == 1 ? alpha_kind(out.albedo) : AlphaKind::full;
    return out;
}

} // namespace vitrail::scene
