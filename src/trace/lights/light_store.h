// All lamps of the window: lists a chunk, trees a chunk, a region, a larger region and over all, and the table from
// cells to lamps.
//
//     LightStore lights;
//     lights.set_states(scene, quad_count);        // new content; then mark all chunks
//     lights.mark(at, chunk);                      // came, changed; null: went. After the grid knows it
//     lights.update(grid);                         // once a frame; cheap where nothing changed
//     scene.lights = lights.view();
//
// Faces that an opaque cube covers do not count, nor cells inside a lake of lava, so a lake is its surface. A change
// costs the scan of its chunk and of those neighbors that hold lamps, and, where lamps changed, one tree a level, of at
// most 64 branches each. One thread.
#pragma once

#include "trace/kernel/scene_view.h"
#include "trace/lights/state_lights.h"
#include "trace/lights/tracked_array.h"
#include "trace/places.h"
#include "voxel/chunk.h"

#include <span>
#include <unordered_map>
#include <unordered_set>

namespace vitrail::trace {

class LightStore {
public:
    // Forgets all chunks.
    void set_states(const SceneView& scene, u32 quad_count);
    void mark(ChunkPos at, ChunkPtr chunk);
    // grid: of the host; chunks outside of its window are dropped.
    void update(const GridView& grid);
    void clear();

    LightView view() const;
    u32 count() const { return count_; }
    std::span<const Emitter> emitters() const { return {emitters_.data(), emitters_.size()}; } // with holes: power 0
    std::size_t memory_bytes() const;

    // For copies on a device: what changed since the last call.
    struct Changes {
        std::vector<ArrayRange> emitters, nodes, table;
        u32 emitter_size = 0, node_size = 0, table_size = 0; // of the whole arrays
    };
    Changes take_changes();

private:
    static constexpr u32 kNone = 0xFFFFFFFFu;
    struct Tree {
        u32 first = kNone, count = 0; // block in nodes_
        LightNode root;               // children (or emitter) by their place in the arrays
    };
    struct ChunkLights {
        ChunkPtr chunk;
        u32 first = kNone, count = 0; // block in emitters_
        IVec3 from;                   // that the tree's boxes are relative to
        Tree tree;
    };
    struct Region {
        std::vector<ChunkPos> members; // with lamps, in order: chunks or smaller regions
        Tree tree;
    };
    // Regions of 4^3 chunks, and of 4^3 of those.
    static constexpr u32 kLevels = 2;
    static ChunkPos parent_of(ChunkPos c) { return {c.x >> 2, c.y >> 2, c.z >> 2}; }

    bool may_emit(const Chunk& chunk) const;
    void list(ChunkPos at, const Chunk& chunk, const GridView& grid, std::vector<Emitter>& out) const;
    u32 open_faces(const StateLight& light, u32 state, const u32 (&around)[6]) const;
    LightNode leaf_of(const Emitter& e) const;
    void drop_chunk(ChunkPos at);
    void relist(ChunkPos at, const GridView& grid);
    bool same_lamps(const ChunkLights& c, const std::vector<Emitter>& found) const;
    void add_member(u32 level, ChunkPos member);
    void remove_member(u32 level, ChunkPos member);
    void replant(u32 level);
    void replant_top();
    LightNode plant(Tree& tree, const std::vector<LightNode>& items);
    void attach(u32 slot);
    void release(Tree& tree);
    void move_origin(const GridView& grid);
    void table_insert(u32 emitter);
    void table_erase(u32 emitter);
    void table_reserve(u32 count);

    std::vector<StateLight> states_;
    std::unordered_map<ChunkPos, ChunkLights> chunks_; // that hold states which emit
    std::unordered_map<ChunkPos, Region> regions_[kLevels];
    std::unordered_set<ChunkPos> marked_, dirty_[kLevels];
    TrackedArray<Emitter> emitters_;
    TrackedArray<LightNode> nodes_;
    TrackedArray<u32> table_;
    Places emitter_places_, node_places_{1}; // lent by powers of two; node 0: the root
    Tree top_;
    u32 count_ = 0, table_bits_ = 0;
    IVec3 from_, window_first_;
    bool has_origin_ = false;
};

} // namespace vitrail::trace
