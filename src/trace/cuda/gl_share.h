// The picture into an OpenGL texture: by a buffer that CUDA and OpenGL share where the context is on the same device,
// else through the host's memory.
#pragma once

#include "trace/cuda/memory.h"

#include <vector>

struct cudaGraphicsResource;

namespace vitrail::trace::cuda {

// For one OpenGL context, which must be current for every call and for the destructor; where none is current any more
// the buffer is left to go with its context.
class GlShare {
public:
    explicit GlShare(const Gpu& gpu)
        : gpu_(gpu) {}
    ~GlShare();
    GlShare(const GlShare&) = delete;
    GlShare& operator=(const GlShare&) = delete;

    // pixels: 4 floats each on the device, rows from the top; after what its stream does now.
    Result<> write(u32 texture, const void* pixels, u32 width, u32 height);
    bool direct() const { return resource_ != nullptr; } // the last write was by a shared buffer

private:
    bool shares() const;
    Result<> register_buffer(u64 bytes);
    void drop();

    const Gpu& gpu_;
    u32 buffer_ = 0;
    u64 bytes_ = 0;
    cudaGraphicsResource* resource_ = nullptr;
    bool broken_ = false; // sharing failed once: not tried again
    PinnedBytes host_;
};

} // namespace vitrail::trace::cuda
