#include "trace/scene_host.h"

#include <bit>

namespace vitrail::trace {

static_assert(sizeof(scene::TintGrid::Texels) * 3 == kTintWords * 4, "three kinds of texels, as kernels read them");

static GridShape shape_of(u32 window_chunks) {
    const u32 bits = u32(std::countr_zero(window_chunks));
    return {bits, bits, bits};
}

SceneHost::SceneHost(u32 window_chunks, ThreadPool* pool)
    : pool_(pool)
    , grid_(shape_of(window_chunks)) {}

Result<> SceneHost::set_content(const scene::BlockModels& models, const StateTable& states,
                                const scene::BlockPictures* pictures) {
    const u32 generation = content_.generation(), lit = content_.texture_generation();
    const std::size_t known = content_.states().size();
    VX_TRY(content_.update(models, states, pictures));
    if (content_.generation() == generation && content_.texture_generation() == lit &&
        content_.states().size() == known)
        return {};
    grid_.set_states(content_.states(), content_.media());
    lights_.set_states(view(0, 0), u32(content_.quads().size())); // forgets its chunks
    all_lights_ = true;
    ++revision_;
    return {};
}

void SceneHost::set_chunk(ChunkPos at, DimensionId dimension, ChunkPtr chunk, const scene::TintGrid* tints) {
    Chunks& chunks = dimensions_[dimension];
    if (!chunk) {
        if (chunks.erase(at) == 0) return;
    } else {
        Held& held = chunks[at];
        if (held.chunk == chunk && !tints) return;
        held.chunk = std::move(chunk);
        if (tints) held.tints = std::make_shared<scene::TintGrid>(*tints);
    }
    if (dimension == dimension_) {
        changed_.push_back(at);
        ++revision_;
    }
}

void SceneHost::clear() {
    dimensions_.clear();
    grid_.clear();
    lights_.clear();
    changed_.clear();
    ++revision_;
}

void SceneHost::take_in(ChunkPos at, const Held* held, std::vector<Grid::Item>& items) {
    if (!grid_.in_window(at)) return;
    Grid::Item item;
    item.at = at;
    if (held) {
        item.blocks = &held->chunk->blocks;
        item.tints = held->tints ? reinterpret_cast<const u32*>(&held->tints->grass) : nullptr;
    }
    items.push_back(item);
    lights_.mark(at, held ? held->chunk : nullptr);
}

void SceneHost::switch_to(DimensionId dimension) {
    dimension_ = dimension;
    grid_.clear();
    lights_.clear();
    changed_.clear();
    all_ = true;
    ++revision_;
}

void SceneHost::update(const scene::FrameView& frame) {
    const scene::View& view = frame.views[0];
    if (view.eye.dimension != dimension_) switch_to(view.eye.dimension);
    const bool moved = grid_.center_on(chunk_of(block_of(view.eye.at)));
    std::vector<Grid::Item> items;
    const Chunks& chunks = dimensions_[dimension_];
    if (all_ || moved) { // chunks that were far away may be inside now
        for (const auto& [at, held] : chunks)
            if (all_ || !grid_.holds(at)) take_in(at, &held, items);
    }
    if (all_lights_)
        for (const auto& [at, held] : chunks)
            if (grid_.holds(at)) lights_.mark(at, held.chunk);
    for (ChunkPos at : changed_) {
        const auto found = chunks.find(at);
        take_in(at, found == chunks.end() ? nullptr : &found->second, items);
    }
    changed_.clear();
    all_ = all_lights_ = false;
    if (!items.empty()) grid_.set_chunks(items, pool_);
    grid_.refresh(pool_);
    lights_.update(grid_.view());
    changed_layers_.clear();
    content_.animate(frame.seconds, changed_layers_);
    if (boxes_.update(frame.entities, dimension_, place_of(view.eye.at), content_.states())) ++revision_;
}

SceneView SceneHost::view(float seconds, float wave_height) const {
    SceneView scene;
    content_.fill(scene);
    scene.grid = grid_.view();
    scene.lights = lights_.view();
    boxes_.fill(scene);
    scene.seconds = seconds;
    scene.wave_height = wave_height;
    return scene;
}

u32 SceneHost::eye_medium(const scene::FrameView& frame) const {
    const scene::View& view = frame.views[0];
    const BlockPos at = block_of(view.eye.at);
    const u32 state = state_at(grid_.view(), {at.x, at.y, at.z});
    if (state >= content_.states().size()) return 0;
    const StateRecord& record = content_.states()[state];
    switch (record.kind) {
    case CellKind::medium:
        return record.medium;
    case CellKind::liquid:
    case CellKind::model:
        return view.underwater ? record.medium : 0; // a liquid's surface may be below the eye
    default:
        return 0;
    }
}

u64 SceneHost::memory_bytes() const {
    return grid_.memory_bytes() + lights_.memory_bytes() + boxes_.memory_bytes() +
           content_.states().size() * sizeof(StateRecord) + content_.quads().size() * sizeof(TraceQuad) +
           (content_.textures().albedo().size() + content_.textures().material().size()) * sizeof(u32);
}

} // namespace vitrail::trace
