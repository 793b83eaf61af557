// UploadRing: a persistently mapped buffer that the CPU writes ahead of the GPU, one third a frame, fences between.
//
//     ring.begin_frame();                         // waits where the GPU still reads this third
//     auto slice = ring.allocate(bytes, 256);     // write slice.data, bind ring.name() at slice.offset
//     ring.end_frame();                           // sets the fence
#pragma once

#include "gfx/handles.h"

#include <array>
#include <vector>

namespace vitrail::gfx {

class UploadRing {
public:
    static constexpr u32 kFrames = 3;
    explicit UploadRing(u64 bytes_a_frame);
    ~UploadRing();
    UploadRing(const UploadRing&) = delete;
    UploadRing& operator=(const UploadRing&) = delete;

    struct Slice {
        u8* data = nullptr;
        u64 offset = 0, bytes = 0;
        u32 buffer = 0;
    };
    void begin_frame();
    // Grows the ring where a frame needs more (the old buffer lives on until its frames are done).
    Slice allocate(u64 bytes, u64 alignment);
    void end_frame();
    u64 bytes() const { return buffer_.bytes; }

private:
    void make(u64 bytes_a_frame);
    void wait(u32 frame);
    Buffer buffer_;
    std::vector<std::pair<u32, Buffer>> retired_; // frames to live, buffer
    u8* mapped_ = nullptr;
    u64 bytes_a_frame_ = 0, used_ = 0;
    u32 frame_ = 0;
    std::array<void*, kFrames> fences_{};
};

} // namespace vitrail::gfx
