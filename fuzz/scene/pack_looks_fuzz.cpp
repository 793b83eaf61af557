// A resource pack from anyone, all the way to what is drawn: pictures, animations, models, every state of a few blocks.
#include "scene/block_model.h"
#include "scene/pack_looks.h"

#include <cstdlib>

using namespace vitrail;

static std::shared_ptr<const BlockRegistry> small_registry() {
    auto registry = std::make_shared<BlockRegistry>();
    const auto add = [&](const char* name, ShapeKind shape, RenderLayer layer) {
        BlockDef def;
        def.name = std::string("minecraft:") + name;
        def.look.shape = shape;
        def.look.layer = layer;
        if (shape != ShapeKind::cube) def.look.opacity = 0;
        def.look.textures = {name};
        registry->texture_id(name);
        registry->add_block(def);
    };
    add("a", ShapeKind::cube, RenderLayer::solid);
    add("b", ShapeKind::cross, RenderLayer::cutout);
    add("grass_block", ShapeKind::cube, RenderLayer::solid);
    add("c", ShapeKind::cube, RenderLayer::translucent);
    return registry;
}

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
    static const auto registry = small_registry();
    PackReport report;
    const auto pack = ResourcePack::from_zip(Bytes(data, data + size), "fuzz", report);
    if (!pack) return 0;
    PackStack stack;
    stack.add(*pack);
    scene::PackLimits limits;
    limits.art.side_most = 32, limits.art.frames_most = 4; // so that a run takes little
    limits.art_bytes_most = 1u << 20, limits.textures_most = 64, limits.quads_most = 4096;
    const auto packs = scene::PackLooks::load(stack, *registry, limits);
    if (packs->texture_count() > 64 || packs->largest_side() > 32) std::abort();
    StateTable states(registry);
    for (const char* text : {"a", "b[facing=east,half=top]", "b[north=low,up=true]", "grass_block[snowy=false]", "c"})
        if (!states.intern(parse_block_state(text).value())) std::abort();
    scene::BlockModels models(packs);
    models.ensure(states);
    for (u32 i = 0; i < states.size(); ++i) {
        const StateId id{i};
        if (scene::hides(models.kinds()[i]) != ((states.flags(id) & kOpaqueCube) != 0)) std::abort();
        for (const scene::StateQuad& q : models.quads(id, i * 77777777u)) {
            if (u32(q.bits >> 32 & 0xffff) >= packs->texture_count()) std::abort();
            (void)models.model_quad(u32(q.bits >> 12 & 2047) | u32(q.bits >> 24 & 255) << 11);
        }
    }
    return 0;
}
