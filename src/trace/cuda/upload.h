// Small pieces of host memory to where they belong on devices: packed into pinned memory, sent at once, and put in
// place by a kernel. A frame's few thousand pieces cost one copy, not a few thousand.
#pragma once

#include "trace/cuda/launch.h"
#include "trace/cuda/memory.h"

#include <span>
#include <vector>

namespace vitrail::trace::cuda {

class Upload {
public:
    // The devices stay where they are.
    explicit Upload(std::span<const Gpu> gpus)
        : gpus_(gpus) {}
    ~Upload();
    Upload(const Upload&) = delete;
    Upload& operator=(const Upload&) = delete;
    Result<> open();

    // Copies now; the device has it after flush, on its stream. to: on each device; offset and bytes: multiples of 4.
    Result<> put(std::span<void* const> to, u64 offset, const void* from, u64 bytes);
    Result<> flush();
    u64 sent() const { return sent_; } // bytes a device, since it was made

private:
    static constexpr u32 kWords = 4u << 20, kPieces = 1u << 14;
    Piece* pieces(std::size_t gpu) const { return pinned_pieces_.as<Piece>() + gpu * kPieces; }

    std::span<const Gpu> gpus_;
    PinnedBytes pinned_, pinned_pieces_; // words; pieces of each device
    std::vector<DeviceBytes> staging_, device_pieces_;
    u32 words_ = 0, count_ = 0;
    bool on_the_way_ = false;
    u64 sent_ = 0;
};

} // namespace vitrail::trace::cuda
