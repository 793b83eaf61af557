#include "gfx/upload_ring.h"

#include "base/assert.h"

#include <algorithm>
#include <epoxy/gl.h>

namespace vitrail::gfx {

UploadRing::UploadRing(u64 bytes_a_frame) {
    make(bytes_a_frame);
}

UploadRing::~UploadRing() {
    for (void* fence : fences_)
        if (fence) glDeleteSync(GLsync(fence));
}

void UploadRing::make(u64 bytes_a_frame) {
    constexpr GLbitfield flags = GL_MAP_WRITE_BIT | GL_MAP_PERSISTENT_BIT | GL_MAP_COHERENT_BIT;
    bytes_a_frame_ = (bytes_a_frame + 255) & ~u64(255);
    buffer_ = make_buffer(bytes_a_frame_ * kFrames, flags);
    mapped_ = static_cast<u8*>(glMapNamedBufferRange(buffer_.name(), 0, GLsizeiptr(buffer_.bytes), flags));
    VX_ASSERT(mapped_ != nullptr);
}

void UploadRing::wait(u32 frame) {
    void*& fence = fences_[frame];
    if (!fence) return;
    while (glClientWaitSync(GLsync(fence), GL_SYNC_FLUSH_COMMANDS_BIT, 1'000'000'000) == GL_TIMEOUT_EXPIRED) {
    }
    glDeleteSync(GLsync(fence));
    fence = nullptr;
}

void UploadRing::begin_frame() {
    frame_ = (frame_ + 1) % kFrames;
    wait(frame_);
    used_ = 0;
    for (auto& [frames, buffer] : retired_)
        --frames;
    std::erase_if(retired_, [](const auto& r) { return r.first == 0; });
}

UploadRing::Slice UploadRing::allocate(u64 bytes, u64 alignment) {
    u64 at = (used_ + alignment - 1) / alignment * alignment;
    if (at + bytes > bytes_a_frame_) {
        // Slices handed out earlier in this frame stay in the old buffer, which lives until the GPU has passed them.
        retired_.emplace_back(kFrames + 1, std::move(buffer_));
        make(std::max(bytes_a_frame_ * 2, bytes + alignment));
        at = 0;
    }
    used_ = at + bytes;
    const u64 offset = frame_ * bytes_a_frame_ + at;
    return {mapped_ + offset, offset, bytes, buffer_.name()};
}

void UploadRing::end_frame() {
    if (fences_[frame_]) glDeleteSync(GLsync(fences_[frame_]));
    fences_[frame_] = glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
}

} // namespace vitrail::gfx
