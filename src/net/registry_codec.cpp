#include "net/registry_codec.h"

#include "base/fields.h"

#include <xxhash.h>

namespace vitrail::net {

namespace {

// The registry's types as they travel. Numbers are the format (docs/formats/protocol.md): append only.
struct WireLook {
    u8 shape = 0, layer = 0;
    std::vector<std::string> textures;
    std::vector<BoxDef> boxes;
    float transparency = 0;
    u8 opacity = 15;
    u32 light = 0; // r | g << 8 | b << 16
    float hardness = 1, viscosity = 0;
    bool collision = true;
    u8 tint = 0, tint_faces = 0;
    u32 tint_color = 0xffffff;
    std::string material;
    bool replaceable = false, climbable = false, sway = false;
    u8 optics = 0;
    float ior = 0;
    std::vector<float> absorption; // empty or r, g, b
    static constexpr auto fields =
        std::tuple{field<1>("shape", &WireLook::shape, {.most_value = i64(ShapeKind::count) - 1}),
                   field<2>("layer", &WireLook::layer, {.most_value = 3}),
                   field<3>("textures", &WireLook::textures, {.most = 6}),
                   field<4>("boxes", &WireLook::boxes, {.most = 64}),
                   field<5>("transparency", &WireLook::transparency),
                   field<6>("opacity", &WireLook::opacity, {.most_value = 15}),
                   field<7>("light", &WireLook::light, {.most_value = 0xffffff}),
                   field<8>("hardness", &WireLook::hardness),
                   field<9>("viscosity", &WireLook::viscosity),
                   field<10>("collision", &WireLook::collision),
                   field<11>("tint", &WireLook::tint, {.most_value = 4}),
                   field<12>("tint_faces", &WireLook::tint_faces, {.most_value = 1}),
                   field<13>("tint_color", &WireLook::tint_color, {.most_value = 0xffffff}),
                   field<14>("material", &WireLook::material, {.most = 64}),
                   field<15>("replaceable", &WireLook::replaceable),
                   field<16>("climbable", &WireLook::climbable),
                   field<17>("sway", &WireLook::sway),
                   field<18>("optics", &WireLook::optics, {.most_value = i64(OpticsKind::count) - 1}),
                   field<19>("ior", &WireLook::ior),
                   field<20>("absorption", &WireLook::absorption, {.most = 3})};
};

struct WireVariant {
    std::vector<std::string> keys, values; // one to one
    WireLook look;
    static constexpr auto fields =
        std::tuple{field<1>("keys", &WireVariant::keys, {.most = 64}),
                   field<2>("values", &WireVariant::values, {.most = 64}), field<3>("look", &WireVariant::look)};
};

struct WireBlock {
    std::string name;
    std::vector<PropertyDef> properties;
    WireLook look;
    std::vector<WireVariant> variants;
    bool in_hotbar_list = true;
    static constexpr auto fields = std::tuple{
        field<1>("name", &WireBlock::name, {.most = 256}), field<2>("properties", &WireBlock::properties, {.most = 64}),
        field<3>("look", &WireBlock::look), field<4>("variants", &WireBlock::variants, {.most = 4096}),
        field<5>("in_hotbar_list", &WireBlock::in_hotbar_list)};
};

struct WireTexture {
    std::string name;
    u32 frame_time = 1;
    static constexpr auto fields =
        std::tuple{field<1>("name", &WireTexture::name, {.most = 256}),
                   field<2>("frame_time", &WireTexture::frame_time, {.least_value = 1, .most_value = 1000000})};
};

struct WireBiome {
    std::string name;
    float temperature = 0, downfall = 0;
    std::vector<u32> colors; // grass, foliage, water, sky, fog
    static constexpr auto fields =
        std::tuple{field<1>("name", &WireBiome::name, {.most = 256}), field<2>("temperature", &WireBiome::temperature),
                   field<3>("downfall", &WireBiome::downfall),
                   field<4>("colors", &WireBiome::colors, {.most = 5, .most_value = 0xffffff})};
};

struct WireRegistry {
    std::vector<WireTexture> textures; // in id order
    std::vector<WireBlock> blocks;     // in id order
    std::vector<WireBiome> biomes;
    std::vector<std::string> hotbar;
    static constexpr auto fields = std::tuple{field<1>("textures", &WireRegistry::textures, {.most = 32768}),
                                              field<2>("blocks", &WireRegistry::blocks, {.most = 65536}),
                                              field<3>("biomes", &WireRegistry::biomes, {.most = 65536}),
                                              field<4>("hotbar", &WireRegistry::hotbar, {.most = 256})};
};

u32 pack(const std::array<u8, 3>& c) {
    return u32(c[0]) | u32(c[1]) << 8 | u32(c[2]) << 16;
}
std::array<u8, 3> unpack(u32 c) {
    return {u8(c), u8(c >> 8), u8(c >> 16)};
}

WireLook to_wire(const BlockLook& l) {
    WireLook w;
    w.shape = u8(l.shape), w.layer = u8(l.layer);
    w.textures = l.textures, w.boxes = l.boxes;
    w.transparency = l.transparency, w.opacity = l.opacity, w.light = pack(l.light);
    w.hardness = l.hardness, w.viscosity = l.viscosity, w.collision = l.collision;
    w.tint = u8(l.tint), w.tint_faces = u8(l.tint_faces), w.tint_color = pack(l.tint_color);
    w.material = l.material;
    w.replaceable = l.replaceable, w.climbable = l.climbable, w.sway = l.sway;
    w.optics = u8(l.optics), w.ior = l.ior;
    if (l.absorption != std::array<float, 3>{}) w.absorption.assign(l.absorption.begin(), l.absorption.end());
    return w;
}

BlockLook from_wire(WireLook w) {
    BlockLook l;
    l.shape = ShapeKind(w.shape), l.layer = RenderLayer(w.layer);
    l.textures = std::move(w.textures), l.boxes = std::move(w.boxes);
    l.transparency = w.transparency, l.opacity = w.opacity, l.light = unpack(w.light);
    for (u8& c : l.light)
        c = c > 15 ? 15 : c;
    l.hardness = w.hardness, l.viscosity = w.viscosity, l.collision = w.collision;
    l.tint = TintKind(w.tint), l.tint_faces = TintFaces(w.tint_faces), l.tint_color = unpack(w.tint_color);
    l.material = std::move(w.material);
    l.replaceable = w.replaceable, l.climbable = w.climbable, l.sway = w.sway;
    l.optics = OpticsKind(w.optics);
    // From anyone: numbers that no shader minds.
    if (w.ior >= 1 && w.ior <= 4) l.ior = w.ior;
    for (std::size_t c = 0; w.absorption.size() == 3 && c < 3; ++c)
        if (w.absorption[c] >= 0 && w.absorption[c] <= 100) l.absorption[c] = w.absorption[c];
    return l;
}

} // namespace

Bytes encode_registry(const BlockRegistry& registry) {
    WireRegistry wire;
    for (const TextureDef& t : registry.textures())
        wire.textures.push_back({t.name, t.frame_time});
    for (const BlockDef& b : registry.blocks()) {
        WireBlock w{b.name, b.properties, to_wire(b.look), {}, b.in_hotbar_list};
        for (const BlockVariant& v : b.variants) {
            WireVariant wv;
            for (const auto& [key, value] : v.when)
                wv.keys.push_back(key), wv.values.push_back(value);
            wv.look = to_wire(v.look);
            w.variants.push_back(std::move(wv));
        }
        wire.blocks.push_back(std::move(w));
    }
    for (const BiomeDef& b : registry.biomes())
        wire.biomes.push_back({b.name,
                               b.temperature,
                               b.downfall,
                               {pack(b.grass), pack(b.foliage), pack(b.water), pack(b.sky), pack(b.fog)}});
    wire.hotbar = registry.hotbar;
    return encode_fields(wire);
}

Result<std::shared_ptr<BlockRegistry>> decode_registry(ByteView bytes) {
    VX_TRY_ASSIGN(WireRegistry wire, decode_fields<WireRegistry>(bytes));
    auto registry = std::make_shared<BlockRegistry>();
    for (WireTexture& t : wire.textures)
        registry->add_texture({std::move(t.name), t.frame_time});
    for (WireBlock& w : wire.blocks) {
        if (w.name.empty()) return fail(ErrorCode::damaged, "a block of the registry has no name");
        BlockDef def;
        def.name = std::move(w.name), def.properties = std::move(w.properties);
        def.look = from_wire(std::move(w.look)), def.in_hotbar_list = w.in_hotbar_list;
        for (WireVariant& v : w.variants) {
            if (v.keys.size() != v.values.size()) return fail(ErrorCode::damaged, "a variant does not parse");
            BlockVariant variant;
            for (std::size_t i = 0; i < v.keys.size(); ++i)
                variant.when.emplace_back(std::move(v.keys[i]), std::move(v.values[i]));
            variant.look = from_wire(std::move(v.look));
            def.variants.push_back(std::move(variant));
        }
        registry->add_block(std::move(def));
    }
    for (WireBiome& b : wire.biomes) {
        if (b.colors.size() != 5) return fail(ErrorCode::damaged, "a biome does not parse");
        registry->add_biome({std::move(b.name), b.temperature, b.downfall, unpack(b.colors[0]), unpack(b.colors[1]),
                             unpack(b.colors[2]), unpack(b.colors[3]), unpack(b.colors[4])});
    }
    registry->hotbar = std::move(wire.hotbar);
    return registry;
}

u64 registry_hash(const BlockRegistry& registry) {
    const Bytes bytes = encode_registry(registry);
    return XXH3_64bits(bytes.data(), bytes.size());
}

} // namespace vitrail::net
