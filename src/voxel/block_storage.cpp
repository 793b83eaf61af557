#include "voxel/block_storage.h"

#include "base/assert.h"

#include <algorithm>
#include <array>
#include <unordered_map>

namespace vitrail {

unsigned bits_for_palette(std::size_t entries) {
    if (entries <= 1) return 0;
    if (entries <= 2) return 1;
    if (entries <= 4) return 2;
    if (entries <= 16) return 4;
    return entries <= 256 ? 8 : 16;
}

void BlockStorage::pack(std::span<const u16, kChunkVolume> indices, unsigned bits) {
    bits_ = bits;
    words_.assign(std::size_t(bits) * 64, 0);
    if (bits == 0) return;
    const u32 per_word = 64 / bits;
    for (u32 w = 0, cell = 0; w < words_.size(); ++w) {
        u64 word = 0;
        for (u32 i = 0; i < per_word; ++i)
            word |= u64(indices[cell++]) << (i * bits);
        words_[w] = word;
    }
}

BlockStorage BlockStorage::from_states(std::span<const StateId, kChunkVolume> states) {
    BlockStorage out(states[0]);
    std::array<u16, kChunkVolume> indices;
    std::unordered_map<u32, u16> slots; // only once the palette is too long to search
    StateId last = states[0];
    u16 last_index = 0;
    for (u32 i = 0; i < kChunkVolume; ++i) {
        if (states[i] != last) {
            last = states[i];
            auto& palette = out.palette_;
            std::size_t at;
            if (palette.size() < 32) {
                at = std::size_t(std::find(palette.begin(), palette.end(), last) - palette.begin());
            } else {
                if (slots.empty())
                    for (std::size_t k = 0; k < palette.size(); ++k)
                        slots.emplace(u32(palette[k]), u16(k));
                at = slots.emplace(u32(last), u16(palette.size())).first->second;
            }
            if (at == palette.size()) palette.push_back(last);
            last_index = u16(at);
        }
        indices[i] = last_index;
    }
    out.pack(indices, bits_for_palette(out.palette_.size()));
    return out;
}

BlockStorage BlockStorage::from_indices(std::span<const StateId> palette, std::span<const u16, kChunkVolume> indices) {
    std::array<StateId, kChunkVolume> states;
    for (u32 i = 0; i < kChunkVolume; ++i) {
        VX_DEBUG_ASSERT(indices[i] < palette.size());
        states[i] = palette[indices[i]];
    }
    return from_states(states);
}

BlockStorage BlockStorage::from_packed(std::vector<StateId> palette, std::vector<u64> words) {
    BlockStorage out;
    out.bits_ = bits_for_palette(palette.size());
    VX_ASSERT(!palette.empty() && words.size() == std::size_t(out.bits_) * 64);
    out.palette_ = std::move(palette);
    out.words_ = std::move(words);
    return out;
}

void BlockStorage::set(LocalPos at, StateId state) {
    u32 slot = u32(std::find(palette_.begin(), palette_.end(), state) - palette_.begin());
    if (slot == palette_.size()) {
        if (bits_for_palette(palette_.size() + 1) > bits_) {
            std::array<u16, kChunkVolume> indices;
            unpack_indices(indices);
            pack(indices, bits_for_palette(palette_.size() + 1));
        }
        palette_.push_back(state);
    }
    if (bits_ == 0) return;
    const u32 bit = at.index * bits_;
    u64& word = words_[bit >> 6];
    const u64 mask = ((u64(1) << bits_) - 1) << (bit & 63);
    word = (word & ~mask) | u64(slot) << (bit & 63);
}

void BlockStorage::unpack_indices(std::span<u16, kChunkVolume> out) const {
    if (bits_ == 0) {
        std::fill(out.begin(), out.end(), u16(0));
        return;
    }
    const u32 per_word = 64 / bits_;
    const u64 mask = (u64(1) << bits_) - 1;
    u32 cell = 0;
    for (u64 word : words_)
        for (u32 i = 0; i < per_word; ++i, word >>= bits_ & 63)
            out[cell++] = u16(word & mask);
}

void BlockStorage::unpack(std::span<StateId, kChunkVolume> out) const {
    if (bits_ == 0) {
        std::fill(out.begin(), out.end(), palette_[0]);
        return;
    }
    std::array<u16, kChunkVolume> indices;
    unpack_indices(indices);
    for (u32 i = 0; i < kChunkVolume; ++i)
        out[i] = palette_[indices[i]];
}

void BlockStorage::compact() {
    std::array<StateId, kChunkVolume> states;
    unpack(states);
    *this = from_states(states);
}

std::size_t BlockStorage::memory_bytes() const {
    return sizeof *this + palette_.capacity() * sizeof(StateId) + words_.capacity() * sizeof(u64);
}

bool operator==(const BlockStorage& a, const BlockStorage& b) {
    std::array<StateId, kChunkVolume> x, y;
    a.unpack(x);
    b.unpack(y);
    return x == y;
}

} // namespace vitrail
