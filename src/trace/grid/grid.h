// Grid: the host's side of the tracing grid (trace/kernel/grid_view.h): a window of chunks around the player that wraps
// around, kept up to date chunk by chunk or block by block.
//
//     Grid grid({.bits_x = 6, .bits_y = 6, .bits_z = 6});
//     grid.set_states(records, media);          // before chunks that use them
//     grid.center_on(player_chunk);             // chunks that leave the window are dropped
//     grid.set_chunks(items, &pool);            // many at once, in parallel; or set_chunk
//     grid.apply(changes);                      // a few microseconds a chunk
//     grid.refresh(&pool);                      // brings what follows from changes up to date; view() does it if need
//     be scene.grid = grid.view();                 // pointers hold until the next change
//
// A device keeps a mirror of the buffers: after `refresh`, `dirty` tells what changed since `clean` (a buffer that has
// grown says so by its size). One thread uses it.
#pragma once

#include "jobs/thread_pool.h"
#include "trace/grid/brick_skips.h"
#include "trace/grid/calm_water.h"
#include "trace/grid/chunk_masks.h"
#include "trace/grid/pool.h"
#include "voxel/chunk.h"
#include "voxel/edit.h"

#include <unordered_map>

namespace vitrail::trace {

struct GridShape {
    u32 bits_x = 6, bits_y = 6, bits_z = 6; // log2 of the window's size in chunks, 2..7
};

// The arrays of a GridView, as a mirror copies them.
enum class GridBuffer : u8 { areas, chunks, masks, palettes, indices, tints, skips };
inline constexpr u32 kGridBuffers = 7;

class Grid {
public:
    explicit Grid(const GridShape& shape);

    // What states are, by StateId; media: as SceneView::media (the first of kind 1 is water). Masks are made anew where
    // states that were known have changed. States beyond are held as StateId::hidden: set their chunks again.
    void set_states(std::span<const StateRecord> states, std::span<const MediumRecord> media);

    // Moves the window, by whole areas, to where this chunk is in its middle. Returns true if it moved.
    bool center_on(ChunkPos chunk);
    bool in_window(ChunkPos chunk) const;

    struct Item {
        ChunkPos at;
        const BlockStorage* blocks = nullptr; // null: the chunk goes
        const u32* tints = nullptr;           // kTintWords words; null: plain (white)
    };
    // Those outside of the window are left out.
    void set_chunks(std::span<const Item> items, ThreadPool* pool = nullptr);
    void set_chunk(ChunkPos at, const Chunk* chunk, const u32* tints = nullptr);
    void clear();

    // Blocks of chunks that are held; others are left out.
    void apply(const ChangeSet& changes);
    void apply(const EditBatch& edits);

    void refresh(ThreadPool* pool = nullptr);
    GridView view();
    GridView view() const; // without what is out of date: skips, and what is known of water
    bool holds(ChunkPos chunk) const;

    std::span<const std::byte> buffer(GridBuffer which) const;
    std::span<const DirtyRanges::Range> dirty(GridBuffer which) const;
    void clean(); // everything is mirrored

    u32 chunk_count() const { return held_count_; }
    u64 memory_bytes() const;

private:
    struct Prepared {
        ChunkMasks masks;
        std::vector<u32> palette;
    };
    u32 slot(ChunkPos at) const;
    void prepare(const BlockStorage& blocks, Prepared& out) const;
    void commit(ChunkPos at, const BlockStorage& blocks, Prepared& prepared);
    void drop(ChunkPos at);
    void set_tints(u32 slot, const u32* tints);
    void give_tints(u32 block);
    void give_pieces(const GridChunk& chunk, u32 palette_size);
    u32 store_masks(u32 old, const BrickMasks& masks);
    void store_chunk(u32 slot, const GridChunk& chunk);
    void refresh_area(ChunkPos at);
    void refresh_water(ThreadPool* pool);
    BlockStorage storage_of(u32 slot) const;
    void apply_by_chunk(std::span<const Edit> edits);
    void remake_all();
    GridView plain_view() const;
    void note_bricks(ChunkPos at, u64 before, u64 after);

    GridShape shape_;
    IVec3 first_;
    std::vector<u8> classes_; // by StateId
    u32 water_ = 0, water_top_ = 0;

    std::vector<u64> areas_;
    std::vector<GridChunk> chunks_;
    std::vector<u16> palette_sizes_; // by slot; 0: not held
    DirtyRanges areas_dirty_, chunks_dirty_;
    Pool<u64> masks_, indices_;
    Pool<u32> palettes_, tints_;
    struct TintBlock {
        u32 block = 0, users = 0;
    };
    std::unordered_map<u64, TintBlock> tint_blocks_; // by hash
    std::unordered_map<u32, u64> tint_hashes_;       // by block
    u32 held_count_ = 0;
    BrickSkips skips_;
    CalmWater calm_;
    IVec3 least_; // of chunks that stop rays through air, and how many on each axis
    u32 extent_[3] = {0, 0, 0};
    bool stale_ = true;
};

} // namespace vitrail::trace
