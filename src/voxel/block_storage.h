// BlockStorage: 16^3 block states through a palette. Indices take 0 (uniform), 1, 2, 4, 8 or 16 bits a cell, so that a
// cell never straddles two words. Cell order is LocalPos::index.
#pragma once

#include "base/types.h"
#include "voxel/coords.h"

#include <span>
#include <vector>

namespace vitrail {

// An id in the world's own state table (world/state_table.h). 0 is air, 1 stands for what a client may not know.
enum class StateId : u32 { air = 0, hidden = 1 };

class BlockStorage {
public:
    explicit BlockStorage(StateId fill = StateId::air)
        : palette_{fill} {}
    // The smallest storage of these 4096 states, palette in order of first appearance.
    static BlockStorage from_states(std::span<const StateId, kChunkVolume> states);
    // From a palette and 4096 indices into it (each must be below palette.size()); unused and doubled entries go.
    static BlockStorage from_indices(std::span<const StateId> palette, std::span<const u16, kChunkVolume> indices);
    // From what `palette` and `words` of another storage gave: bits_for_palette(palette.size()) * 64 words whose indices the
    // caller has checked to be below palette.size().
    static BlockStorage from_packed(std::vector<StateId> palette, std::vector<u64> words);

    StateId get(LocalPos at) const { return palette_[index_at(at.index)]; }
    void set(LocalPos at, StateId state);

    bool uniform() const { return bits_ == 0; }
    // May hold states no longer used until `compact`.
    std::span<const StateId> palette() const { return palette_; }
    unsigned bits() const { return bits_; }
    std::span<const u64> words() const { return words_; }
    void unpack_indices(std::span<u16, kChunkVolume> out) const;
    void unpack(std::span<StateId, kChunkVolume> out) const;
    // Drops unused palette entries and bits.
    void compact();
    std::size_t memory_bytes() const;

    friend bool operator==(const BlockStorage& a, const BlockStorage& b);

private:
    u32 index_at(u32 cell) const {
        if (bits_ == 0) return 0;
        const u32 bit = cell * bits_;
        return u32(words_[bit >> 6] >> (bit & 63)) & ((1u << bits_) - 1);
    }
    void pack(std::span<const u16, kChunkVolume> indices, unsigned bits);

    std::vector<StateId> palette_;
    std::vector<u64> words_;
    unsigned bits_ = 0;
};

// Fewest of 0, 1, 2, 4, 8, 16 bits that can index `entries` palette entries.
unsigned bits_for_palette(std::size_t entries);

} // namespace vitrail
