// A scene of one chunk whose cells hold the state that a test says, for kernels that look around in the grid.
#pragma once

#include "trace/kernel/scene_view.h"

#include <array>
#include <vector>

namespace vitrail::trace {

struct OneChunkScene {
    std::vector<StateRecord> states{StateRecord{}}; // by number; 0 is air
    std::vector<MediumRecord> media{MediumRecord{}, MediumRecord{1.333f, {}, {}, true, 1}};
    std::array<u8, 4096> cells{};
    std::vector<u32> palette, tints = std::vector<u32>(kTintWords, 0xffffffff);
    std::vector<u64> indices;
    std::vector<GridChunk> chunks;
    SceneView view;

    void set(i32 x, i32 y, i32 z, u32 state) { cells[u32(x | z << 4 | y << 8)] = u8(state); }
    // After all is set.
    const SceneView& finish() {
        palette.assign(257, 0);
        for (u32 i = 0; i < 256; ++i)
            palette[i] = i < states.size() ? i : 0; // entry 256: air, for the chunks around
        indices.assign(512, 0);
        for (u32 i = 0; i < 4096; ++i)
            indices[i / 8] |= u64(cells[i]) << i % 8 * 8;
        chunks.assign(64, GridChunk{});
        for (GridChunk& c : chunks)
            c.palette = 256;
        view.grid.first = {0, 0, 0};
        view.grid.bits_x = view.grid.bits_y = view.grid.bits_z = 2;
        GridChunk& c = chunks[slot_of(view.grid, {0, 0, 0})];
        c.palette = 0, c.bits = 8;
        view.grid.chunks = chunks.data();
        view.grid.palettes = palette.data();
        view.grid.indices = indices.data();
        view.grid.tints = tints.data();
        view.states = states.data();
        view.state_count = u32(states.size());
        view.media = media.data();
        return view;
    }
};

} // namespace vitrail::trace
