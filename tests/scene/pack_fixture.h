// A registry of a few blocks and packs made in memory, for tests of looks from packs.
#pragma once

#include "formats/png_builder.h"
#include "formats/zip_builder.h"
#include "scene/block_model.h"
#include "scene/pack_looks.h"

#include <gtest/gtest.h>

namespace vitrail::scene {

struct PackWorld {
    std::shared_ptr<BlockRegistry> registry = std::make_shared<BlockRegistry>();
    std::unique_ptr<StateTable> states;
    test::ZipBuilder zip;
    std::string mcmeta = R"({"pack":{"pack_format":15,"description":"made by a test"}})";
    std::shared_ptr<const PackLooks> packs;
    std::unique_ptr<BlockModels> models;
    PackReport opening;

    BlockLook& block(const std::string& name, ShapeKind shape, std::vector<std::string> textures,
                     RenderLayer layer = RenderLayer::solid) {
        BlockDef def;
        def.name = "minecraft:" + name;
        def.look.shape = shape;
        def.look.layer = layer;
        if (layer != RenderLayer::solid || (shape != ShapeKind::cube && shape != ShapeKind::pillar))
            def.look.opacity = 0;
        for (const std::string& texture : textures)
            registry->texture_id(texture);
        def.look.textures = std::move(textures);
        const BlockId id = registry->add_block(def);
        return const_cast<BlockDef&>(registry->blocks()[u32(id)]).look;
    }
    void file(const std::string& path, std::string_view text) { zip.add("assets/minecraft/" + path, text); }
    void file(const std::string& path, const Bytes& bytes) { zip.add("assets/minecraft/" + path, ByteView(bytes)); }
    void states_of(const std::string& block_name, std::string_view json) {
        file("blockstates/" + block_name + ".json", json);
    }
    void model(const std::string& name, std::string_view json) { file("models/block/" + name + ".json", json); }
    void texture(const std::string& name, std::array<u8, 4> color, u32 side = 16) {
        file("textures/block/" + name + ".png", test::plain_png(side, color));
    }

    void load(const PackLimits& limits = {}) {
        zip.add("pack.mcmeta", mcmeta);
        auto pack = ResourcePack::from_zip(zip.bytes(), "test", opening);
        ASSERT_TRUE(pack) << pack.error().message;
        PackStack stack;
        stack.add(*pack);
        packs = PackLooks::load(stack, *registry, limits);
        models = std::make_unique<BlockModels>(packs);
        states = std::make_unique<StateTable>(registry);
    }
    StateId id(const std::string& text) {
        const StateId out = states->intern(parse_block_state(text).value()).value();
        models->ensure(*states);
        return out;
    }
    ModelKind kind(StateId state) const { return models->kinds()[u32(state)]; }
    static TextureId texture_of(FaceLook look) { return TextureId(look >> 32 & 0xffff); }
    static TintKind tint_of(FaceLook look) { return TintKind(look >> 48 & 7); }
    static u32 turns_of(FaceLook look) { return u32(look >> 62); }
    FaceLook face(StateId state, Face f) const { return models->faces(state)[u32(f)]; }
    ModelQuad quad(const StateQuad& q) const {
        return models->model_quad(u32(q.bits >> 12 & 2047) | u32(q.bits >> 24 & 255) << 11);
    }
    std::array<u8, 3> fixed_tint(u64 bits) const { return models->fixed_tints()[bits >> 51 & 255]; }
    TextureId texture_id(const std::string& name) const { return registry->find_texture(name).value(); }
};

} // namespace vitrail::scene
