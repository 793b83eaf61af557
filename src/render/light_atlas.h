// The light bricks of all sections in one 3-D texture (28 x 28 bricks a slab of 18 texels). Uniform bricks of
// one value share a slot. Slot 0 is full sky light.
#pragma once

#include "gfx/handles.h"
#include "render/meshing/light_brick.h"

#include <unordered_map>
#include <vector>

namespace vitrail::render {

class LightAtlas {
public:
    static constexpr u32 kRow = 28, kSlab = kRow * kRow, kBrick = u32(LightBrick::kSize);
    // bytes: texels of 8 bits a channel instead of 4. Software OpenGL filters those several times faster (it unpacks
    // others one by one); GPUs do not care, and are spared the memory.
    explicit LightAtlas(bool bytes);
    // The slot of this brick; `slot` is what the section held before (0: none), freed or used again.
    u32 set(u32 slot, const LightBrick& brick);
    void free(u32 slot);
    const gfx::Texture& texture() const { return texture_; }
    u32 slots_used() const { return used_; }

private:
    u32 take();
    void grow(u32 slabs);
    void upload(u32 slot, const u16* cells);
    gfx::Texture texture_;
    bool bytes_ = false;
    std::vector<u32> widened_; // a brick on its way up
    u32 slabs_ = 0, used_ = 0, next_ = 0;
    std::vector<u32> free_;
    struct Shared {
        u32 slot = 0, users = 0;
    };
    std::unordered_map<u16, Shared> uniform_; // by value
    std::unordered_map<u32, u16> uniform_of_slot_;
};

} // namespace vitrail::render
