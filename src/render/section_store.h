// The sections that can be drawn: their quads in one buffer, light and tints by slot, and what culling needs to know.
#pragma once

#include "gfx/range_allocator.h"
#include "render/light_atlas.h"
#include "render/meshing/quad.h"
#include "render/tint_table.h"

#include <memory>
#include <unordered_map>
#include <vector>

namespace vitrail::render {

struct SectionKey {
    ChunkPos at;
    DimensionId dimension{};
    friend bool operator==(const SectionKey&, const SectionKey&) = default;
};
struct HashSectionKey {
    std::size_t operator()(const SectionKey& k) const {
        return hash_combine(std::hash<ChunkPos>()(k.at), u64(k.dimension));
    }
};

struct Section {
    ChunkPos at;
    DimensionId dimension{};
    u32 first_quad = 0, quad_count = 0;                // in the quad buffer
    std::array<u32, SectionMesh::kGroups + 1> first{}; // as SectionMesh::first
    SectionSight sight{0, kWholeFaces};
    u32 light_slot = 0, tint_slot = 0;
    bool sky_lit = true;                       // any light of the sky touches it
    u32 index = 0;                             // in SectionStore::all()
    u32 slot = 0;                              // its own while it is held: what the GPU remembers of it
    std::vector<Quad> translucent;             // copy for sorting
    std::array<i8, 3> sorted_from{-128, 0, 0}; // the eye's cell when last sorted
    u32 group_size(QuadPass pass) const {
        return first[SectionMesh::group(pass, 0) + SectionMesh::kDirections] - first[SectionMesh::group(pass, 0)];
    }
};

// What is looked at of every section each frame, kept close together.
struct SectionPlace {
    ChunkPos at;
    DimensionId dimension{};
    u32 quad_count = 0;
};

class SectionStore {
public:
    // software: OpenGL is (see LightAtlas).
    SectionStore(u64 quad_bytes_start, bool software);
    void set(SectionKey key, const SectionMesh& mesh);
    void set_light(SectionKey key, const LightBrick& brick);
    void set_tints(SectionKey key, const TintGrid& tints);
    void remove(SectionKey key);
    void clear();
    Section* find(SectionKey key);
    const std::vector<Section*>& all() const { return all_; }
    const std::vector<SectionPlace>& places() const { return places_; } // in the order of all()
    u64 revision() const { return revision_; }                          // grows where culling may change
    // Sections whose shape, or whether the sky lights them, changed since forget_changes(), in any order, some twice.
    const std::vector<SectionKey>& changes() const { return changes_; }
    void forget_changes() { changes_.clear(); }

    u32 slot_count() const { return slot_count_; } // slots lie below it

    // Sorts the translucent quads of a section back to front as seen from a cell -1..16 on each axis of it, where it
    // has not been sorted from there (translucent_order.h); the number of quads moved.
    u32 sort_translucent(Section& section, std::array<i8, 3> from);

    u32 quad_buffer() const { return quads_.name(); }
    u32 quad_buffer_quads() const { return ranges_.capacity(); }
    u64 quads_held() const { return ranges_.used(); }
    const LightAtlas& light() const { return light_; }
    const TintTable& tints() const { return tints_; }
    u64 gpu_bytes() const;
    u64 cpu_bytes() const;

private:
    Section& obtain(SectionKey key);
    void release_quads(Section& section);
    std::unordered_map<SectionKey, std::unique_ptr<Section>, HashSectionKey> sections_;
    std::vector<Section*> all_;
    std::vector<SectionPlace> places_;
    std::vector<u32> free_slots_;
    u32 slot_count_ = 0;
    gfx::Buffer quads_;
    gfx::RangeAllocator ranges_;
    LightAtlas light_;
    TintTable tints_;
    u64 revision_ = 1;
    std::vector<SectionKey> changes_;
};

} // namespace vitrail::render
