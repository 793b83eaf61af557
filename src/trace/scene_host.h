// The world as the tracer holds it in host memory, whatever device traces: grid, tables of states, pictures, lamps. One
// dimension at a time: chunks of others are kept aside until the eye is there.
#pragma once

#include "scene/frame_view.h"
#include "scene/tint_grid.h"
#include "trace/boxes.h"
#include "trace/content/content_tables.h"
#include "trace/grid/grid.h"
#include "trace/lights/light_store.h"

#include <unordered_map>

namespace vitrail::trace {

class SceneHost {
public:
    SceneHost(u32 window_chunks, ThreadPool* pool);

    // See Tracer.
    Result<> set_content(const scene::BlockModels& models, const StateTable& states,
                         const scene::BlockPictures* pictures);
    void set_chunk(ChunkPos at, DimensionId dimension, ChunkPtr chunk, const scene::TintGrid* tints);
    void clear();

    // Moves the window to the eye of view 0 and takes in what was set, and the frame's entities.
    void update(const scene::FrameView& frame);
    // Pointers hold until the next update or set_content.
    SceneView view(float seconds, float wave_height) const;
    // Index into SceneView::media.
    u32 eye_medium(const scene::FrameView& frame) const;

    u64 revision() const { return revision_; } // grows with every change of blocks, looks and entities
    u64 memory_bytes() const;
    u32 chunk_count() const { return grid_.chunk_count(); }
    u32 emitter_count() const { return lights_.count(); }

    // For mirrors on a device.
    Grid& grid() { return grid_; }
    ContentTables& content() { return content_; }
    LightStore& lights() { return lights_; }
    const BoxTree& boxes() const { return boxes_; }
    const std::vector<u32>& changed_layers() const { return changed_layers_; }

private:
    struct Held {
        ChunkPtr chunk;
        std::shared_ptr<const scene::TintGrid> tints;
    };
    using Chunks = std::unordered_map<ChunkPos, Held>;
    void switch_to(DimensionId dimension);
    void take_in(ChunkPos at, const Held* held, std::vector<Grid::Item>& items);

    ThreadPool* pool_;
    Grid grid_;
    ContentTables content_;
    LightStore lights_;
    BoxTree boxes_;
    std::unordered_map<DimensionId, Chunks> dimensions_;
    DimensionId dimension_{};
    std::vector<ChunkPos> changed_;         // of the dimension in the grid
    bool all_ = false, all_lights_ = false; // every chunk is to be taken in; its lamps
    std::vector<u32> changed_layers_;       // of the pictures, by the last update
    u64 revision_ = 1;
};

} // namespace vitrail::trace
