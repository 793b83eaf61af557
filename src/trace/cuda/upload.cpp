#if VITRAIL_CUDA

#include "trace/cuda/upload.h"

#include <algorithm>
#include <cstring>

namespace vitrail::trace::cuda {

Upload::~Upload() {
    for (const Gpu& g : gpus_)
        (void)g.wait(); // pinned memory goes
}

Result<> Upload::open() {
    VX_TRY(pinned_.reach({}, u64(kWords) * 4));
    VX_TRY(pinned_pieces_.reach({}, u64(kPieces) * sizeof(Piece) * gpus_.size()));
    staging_.resize(gpus_.size());
    device_pieces_.resize(gpus_.size());
    for (std::size_t i = 0; i < gpus_.size(); ++i) {
        VX_TRY(staging_[i].make(gpus_[i], u64(kWords) * 4));
        VX_TRY(device_pieces_[i].make(gpus_[i], u64(kPieces) * sizeof(Piece)));
    }
    return {};
}

Result<> Upload::put(std::span<void* const> to, u64 offset, const void* from, u64 bytes) {
    const auto* source = static_cast<const std::byte*>(from);
    for (u64 done = 0; done < bytes;) {
        if (on_the_way_) { // what was sent is still read
            for (const Gpu& g : gpus_)
                VX_TRY(g.wait());
            on_the_way_ = false;
        }
        const u32 words = u32(std::min<u64>((bytes - done) / 4, kPieceWords));
        if (words_ + words > kWords || count_ == kPieces) {
            VX_TRY(flush());
            continue;
        }
        std::memcpy(pinned_.as<u32>() + words_, source + done, u64(words) * 4);
        for (std::size_t i = 0; i < gpus_.size(); ++i)
            pieces(i)[count_] = {static_cast<u32*>(to[i]) + (offset + done) / 4, words_, words};
        words_ += words;
        ++count_;
        done += u64(words) * 4;
    }
    return {};
}

Result<> Upload::flush() {
    if (count_ == 0) return {};
    for (std::size_t i = 0; i < gpus_.size(); ++i) {
        const Gpu& g = gpus_[i];
        VX_TRY(g.use());
        VX_TRY(check(cudaMemcpyAsync(staging_[i].as(), pinned_.as(), u64(words_) * 4, cudaMemcpyHostToDevice, g.stream),
                     "copying the world"));
        VX_TRY(check(cudaMemcpyAsync(device_pieces_[i].as(), pieces(i), u64(count_) * sizeof(Piece),
                                     cudaMemcpyHostToDevice, g.stream),
                     "copying the world"));
        launch_scatter(staging_[i].as<u32>(), device_pieces_[i].as<Piece>(), count_, g.stream);
        VX_TRY(check(cudaGetLastError(), "putting the world in place"));
    }
    sent_ += u64(words_) * 4;
    words_ = count_ = 0;
    on_the_way_ = true;
    return {};
}

} // namespace vitrail::trace::cuda

#endif
