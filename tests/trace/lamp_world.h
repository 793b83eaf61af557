// Lamps of every kind in a small window, for tests of direct sampling: chunks, their grid with nothing but states in
// it, tables and pictures made by hand.
#pragma once

#include "trace/lights/light_store.h"

#include <map>
#include <memory>

namespace vitrail::test {

struct LampWorld {
    enum : u32 { air, stone, lamp, torch, lava, half_lamp, spike, states_end };
    static constexpr u32 kSide = 8; // texels
    static constexpr i32 kChunks = 16;

    LampWorld(IVec3 first = {-8, -8, -8})
        : first_(first) {
        const u32 layers = 3; // dark, shining, its left half shining
        albedo.assign(layers * kSide * kSide, 0xFFFFFFFF);
        material.assign(layers * kSide * kSide, 0x00FF8080);
        for (u32 i = 0; i < kSide * kSide; ++i) {
            material[kSide * kSide + i] = 0xFFFF8080;
            if (i % kSide < kSide / 2) material[2 * kSide * kSide + i] = 0xFFFF8080;
        }
        records.resize(states_end);
        const auto faces = [](trace::StateRecord& r, u32 texture) {
            for (u32 f = 0; f < 6; ++f)
                r.faces[f] = u64(f) << 20 | u64(texture) << 32;
        };
        const auto shine = [](trace::StateRecord& r, u16 e) { r.emission[0] = r.emission[1] = r.emission[2] = e; };
        records[stone].kind = records[lamp].kind = records[half_lamp].kind = trace::CellKind::cube;
        faces(records[lamp], 1), shine(records[lamp], 32);
        faces(records[half_lamp], 2), shine(records[half_lamp], 16);
        records[lava].kind = trace::CellKind::liquid;
        records[lava].medium = 1;
        records[lava].liquid_height = 227;
        faces(records[lava], 1), shine(records[lava], 16);
        // Torch: an upright sheet seen from both sides, and a small level one on top. Spike: a slanting triangle.
        add_quad(torch, {0.25f, 0, 0.5f}, {0.5f, 0, 0}, {0, 0.75f, 0}, trace::TraceQuad::kTwoSided);
        add_quad(torch, {0.25f, 0.75f, 0.25f}, {0, 0, 0.5f}, {0.5f, 0, 0}, 0);
        add_quad(spike, {0.1f, 0.2f, 0.1f}, {0.1f, 0.3f, 0.8f}, {0.7f, 0.1f, 0.2f}, trace::TraceQuad::kTriangle);
        for (u32 s : {u32(torch), u32(spike)})
            records[s].kind = trace::CellKind::model, shine(records[s], 16);

        grid_chunks.resize(kChunks * kChunks * kChunks);
        palette.resize(states_end);
        for (u32 i = 0; i < states_end; ++i)
            palette[i] = i;
        view.grid.first = first;
        view.grid.bits_x = view.grid.bits_y = view.grid.bits_z = 4;
        view.grid.chunks = grid_chunks.data();
        view.grid.palettes = palette.data();
        view.states = records.data();
        view.state_count = states_end;
        view.quads = quads.data();
        view.textures = {albedo.data(), material.data(), 3, 1, layers, kSide * kSide};
    }

    void add_quad(u32 state, Vec3 corner, Vec3 a, Vec3 b, u32 flags) {
        trace::TraceQuad q{};
        q.corner = corner, q.edge_a = a, q.edge_b = b, q.texture = 1, q.look = flags;
        q.normal = normalized(cross(a, b));
        q.ua = 1, q.vb = 1;
        if (records[state].quads++ == 0) records[state].first_quad = u32(quads.size());
        quads.push_back(q);
    }

    void set(IVec3 cell, u32 state) {
        const ChunkPos at{cell.x >> 4, cell.y >> 4, cell.z >> 4};
        std::shared_ptr<Chunk>& chunk = chunks[{at.x, at.y, at.z}];
        auto next = std::make_shared<Chunk>();
        if (chunk) next->blocks = chunk->blocks;
        next->blocks.set(LocalPos(cell.x & 15, cell.y & 15, cell.z & 15), StateId(state));
        chunk = next;
    }
    // Tells the grid and, where there is one, the store.
    void publish(trace::LightStore* store, ChunkPos at) {
        const auto it = chunks.find({at.x, at.y, at.z});
        const ChunkPtr chunk = it == chunks.end() ? nullptr : it->second;
        std::vector<u64>& words = indices[{at.x, at.y, at.z}];
        words.assign(1024, 0);
        if (chunk)
            for (u32 i = 0; i < 4096; ++i)
                words[i >> 2] |= u64(u32(chunk->blocks.get(LocalPos(i)))) << (i & 3) * 16;
        rebuild();
        if (store) store->mark(at, chunk);
    }
    void publish_all(trace::LightStore* store) {
        for (const auto& [at, chunk] : chunks)
            publish_words(at, *chunk);
        rebuild();
        if (store)
            for (const auto& [at, chunk] : chunks)
                store->mark({at[0], at[1], at[2]}, chunk);
    }

    std::vector<u32> albedo, material, palette;
    std::vector<trace::StateRecord> records;
    std::vector<trace::TraceQuad> quads;
    std::map<std::array<i32, 3>, std::shared_ptr<Chunk>> chunks;
    trace::SceneView view;

private:
    void publish_words(const std::array<i32, 3>& at, const Chunk& chunk) {
        std::vector<u64>& words = indices[at];
        words.assign(1024, 0);
        std::array<StateId, kChunkVolume> states;
        chunk.blocks.unpack(states);
        for (u32 i = 0; i < 4096; ++i)
            words[i >> 2] |= u64(u32(states[i])) << (i & 3) * 16;
    }
    void rebuild() {
        all_indices.clear();
        for (trace::GridChunk& c : grid_chunks)
            c = {};
        for (const auto& [at, words] : indices) {
            const IVec3 chunk{at[0], at[1], at[2]};
            if (!trace::in_window(view.grid, chunk)) continue;
            trace::GridChunk& c = grid_chunks[trace::slot_of(view.grid, chunk)];
            c.indices = u32(all_indices.size());
            c.bits = 16;
            all_indices.insert(all_indices.end(), words.begin(), words.end());
        }
        view.grid.indices = all_indices.data();
    }
    IVec3 first_;
    std::vector<trace::GridChunk> grid_chunks;
    std::map<std::array<i32, 3>, std::vector<u64>> indices;
    std::vector<u64> all_indices;
};

} // namespace vitrail::test
