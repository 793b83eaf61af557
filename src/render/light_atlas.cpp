#include "render/light_atlas.h"

#include "base/assert.h"

#include <algorithm>
#include <epoxy/gl.h>

namespace vitrail::render {

LightAtlas::LightAtlas(bool bytes)
    : bytes_(bytes) {
    grow(1);
    LightBrick sky;
    sky.uniform = true;
    sky.value = Light(15, 0, 0, 0);
    const u32 slot = set(0, sky);
    VX_ASSERT(slot == 0);
}

void LightAtlas::grow(u32 slabs) {
    // 16-bit texels keep a view of 12 chunks near 30 MB; a slab at a time, since most worlds need few.
    gfx::Texture bigger =
        gfx::make_texture_3d(bytes_ ? GL_RGBA8 : GL_RGBA4, kRow * kBrick, kRow * kBrick, slabs * kBrick);
    gfx::set_filter(bigger, GL_LINEAR, GL_LINEAR, GL_CLAMP_TO_EDGE);
    if (slabs_ > 0) {
        glCopyImageSubData(texture_.name(), GL_TEXTURE_3D, 0, 0, 0, 0, bigger.name(), GL_TEXTURE_3D, 0, 0, 0, 0,
                           GLsizei(kRow * kBrick), GLsizei(kRow * kBrick), GLsizei(slabs_ * kBrick));
        glFinish(); // as gfx::grow_buffer
    }
    texture_ = std::move(bigger);
    slabs_ = slabs;
}

u32 LightAtlas::take() {
    ++used_;
    if (!free_.empty()) {
        const u32 slot = free_.back();
        free_.pop_back();
        return slot;
    }
    if (next_ == slabs_ * kSlab) grow(slabs_ + 1);
    return next_++;
}

void LightAtlas::upload(u32 slot, const u16* cells) {
    const u32 x = slot % kRow, y = slot / kRow % kRow, z = slot / kSlab;
    const void* texels = cells;
    if (bytes_) {
        widened_.resize(kBrick * kBrick * kBrick);
        for (std::size_t i = 0; i < widened_.size(); ++i) {
            // The first of four channels is the highest nibble there, the lowest byte here.
            const u32 c = cells[i];
            widened_[i] = (c >> 12 | (c >> 8 & 15) << 8 | (c >> 4 & 15) << 16 | (c & 15) << 24) * 17;
        }
        texels = widened_.data();
    }
    glPixelStorei(GL_UNPACK_ALIGNMENT, 2);
    glTextureSubImage3D(texture_.name(), 0, GLint(x * kBrick), GLint(y * kBrick), GLint(z * kBrick), kBrick, kBrick,
                        kBrick, GL_RGBA, bytes_ ? GL_UNSIGNED_BYTE : GL_UNSIGNED_SHORT_4_4_4_4, texels);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
}

u32 LightAtlas::set(u32 slot, const LightBrick& brick) {
    if (brick.uniform) {
        const u16 value = brick.value.bits;
        const auto held = uniform_of_slot_.find(slot);
        if (slot != 0 && held != uniform_of_slot_.end() && held->second == value) return slot;
        Shared& shared = uniform_[value];
        if (shared.users == 0) {
            shared.slot = take();
            uniform_of_slot_[shared.slot] = value;
            std::vector<u16> cells(kBrick * kBrick * kBrick, value);
            upload(shared.slot, cells.data());
        }
        ++shared.users;
        const u32 result = shared.slot;
        free(slot);
        return result;
    }
    if (slot == 0 || uniform_of_slot_.contains(slot)) {
        const u32 fresh = take();
        free(slot);
        slot = fresh;
    }
    upload(slot, brick.cells.data());
    return slot;
}

void LightAtlas::free(u32 slot) {
    if (slot == 0) return;
    const auto shared = uniform_of_slot_.find(slot);
    if (shared != uniform_of_slot_.end()) {
        const auto entry = uniform_.find(shared->second);
        if (--entry->second.users > 0) return;
        uniform_.erase(entry);
        uniform_of_slot_.erase(shared);
    }
    free_.push_back(slot);
    --used_;
}

} // namespace vitrail::render
