#include "bench/trace/traced_land.h"

#include "bench/sample_land.h"
#include "scene/block_pictures.h"
#include "scene/sky.h"
#include "script/content_loader.h"

#include <array>

namespace vitrail::bench {

Result<std::unique_ptr<TracedLand>> TracedLand::open(const trace::TracerOptions& options) {
    auto land = std::make_unique<TracedLand>();
    VX_TRY_ASSIGN(land->tracer, trace::Tracer::create(options));
    const std::filesystem::path root = std::string(VITRAIL_SOURCE_DIR) + "/content/base";
    VX_TRY_ASSIGN(const Content content, load_content({&root, 1}));
    content.registry->content_roots = {root.string()};
    land->states = std::make_unique<StateTable>(content.registry);
    std::array<StateId, SampleLand::kinds> ids{};
    const char* names[] = {"air", "stone", "dirt", "grass_block", "sand", "iron_ore", "oak_log", "oak_leaves"};
    for (u32 i = 1; i < ids.size(); ++i) {
        BlockState state{names[i], {}};
        const BlockDef& def = content.registry->blocks()[u32(content.registry->find_block(state.name))];
        for (const PropertyDef& p : def.properties)
            state.set(p.name, p.default_value);
        VX_TRY_ASSIGN(ids[i], land->states->intern(state));
    }
    land->models.ensure(*land->states);
    const auto pictures = scene::BlockPictures::load(*content.registry, nullptr);
    VX_TRY(land->tracer->set_content(land->models, *land->states, &pictures));
    const SampleLand cells;
    for (i32 y = 0; y < SampleLand::kY; ++y)
        for (i32 z = 0; z < SampleLand::kZ; ++z)
            for (i32 x = 0; x < SampleLand::kX; ++x) {
                const auto* from = cells.chunk(SampleLand::chunk_index(x, y, z));
                std::vector<StateId> to(kChunkVolume);
                for (std::size_t i = 0; i < to.size(); ++i)
                    to[i] = ids[from[i]];
                auto chunk = std::make_shared<Chunk>();
                chunk->blocks = BlockStorage::from_states(std::span<const StateId, kChunkVolume>(to));
                land->tracer->set_chunk({x, y, z}, DimensionId{}, std::move(chunk), nullptr);
            }
    return land;
}

scene::FrameView TracedLand::frame(u32 width, u32 height, float step) const {
    scene::FrameView frame;
    frame.width = width, frame.height = height;
    frame.sky = scene::sky_at(5000);
    frame.view_distance = 256;
    scene::View view;
    constexpr i32 x = 256, z = 232;
    view.eye.at = {x * kFixedOne + kFixedOne / 2, (SampleLand::height(x, z) + 20) * kFixedOne + kFixedOne / 2,
                   z * kFixedOne + i64((0.5 + double(step)) * double(kFixedOne))};
    view.rotation = view_rotation(-0.54f, 0.25f);
    frame.views.push_back(view);
    return frame;
}

} // namespace vitrail::bench
