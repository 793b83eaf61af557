// Memory and streams of CUDA devices, owned. For the host's files of this folder.
#pragma once

#include "base/result.h"
#include "base/types.h"

#include <cuda_runtime_api.h>
#include <fmt/format.h>
#include <utility>

namespace vitrail::trace::cuda {

inline Result<> check(cudaError_t e, const char* what) {
    if (e == cudaSuccess) return {};
    return fail(e == cudaErrorMemoryAllocation ? ErrorCode::limit : ErrorCode::io,
                fmt::format("CUDA: {} failed: {}", what, cudaGetErrorString(e)));
}

// A device and the stream that all of its work goes through. Made by open; the destructor waits.
struct Gpu {
    int id = -1;
    cudaStream_t stream = nullptr;

    Gpu() = default;
    Gpu(Gpu&& o) noexcept
        : id(std::exchange(o.id, -1))
        , stream(std::exchange(o.stream, nullptr)) {}
    Gpu& operator=(Gpu&&) = delete;
    ~Gpu() {
        if (!stream) return;
        cudaSetDevice(id);
        cudaStreamSynchronize(stream);
        cudaStreamDestroy(stream);
    }
    Result<> open(int device) {
        id = device;
        VX_TRY(use());
        return check(cudaStreamCreateWithFlags(&stream, cudaStreamNonBlocking), "a stream");
    }
    // Makes the device current for this thread.
    Result<> use() const { return check(cudaSetDevice(id), "choosing the device"); }
    Result<> wait() const {
        VX_TRY(use());
        return check(cudaStreamSynchronize(stream), "waiting for the device");
    }
};

// Bytes on one device. Freeing waits for what runs there.
class DeviceBytes {
public:
    DeviceBytes() = default;
    DeviceBytes(DeviceBytes&& o) noexcept
        : at_(std::exchange(o.at_, nullptr))
        , size_(std::exchange(o.size_, 0))
        , device_(o.device_) {}
    DeviceBytes& operator=(DeviceBytes&& o) noexcept {
        std::swap(at_, o.at_), std::swap(size_, o.size_), std::swap(device_, o.device_);
        return *this;
    }
    ~DeviceBytes() {
        if (!at_) return;
        cudaSetDevice(device_);
        cudaFree(at_);
    }
    // What it held is lost. size 0: nothing is held.
    Result<> make(const Gpu& gpu, u64 size) {
        *this = DeviceBytes();
        if (size == 0) return {};
        VX_TRY(gpu.use());
        VX_TRY(check(cudaMalloc(&at_, size), "memory of the device"));
        size_ = size;
        device_ = gpu.id;
        return {};
    }
    template <class T = void>
    T* as() const {
        return static_cast<T*>(at_);
    }
    u64 size() const { return size_; }

private:
    void* at_ = nullptr;
    u64 size_ = 0;
    int device_ = 0;
};

// Memory of the host that devices copy from and to without a detour.
class PinnedBytes {
public:
    PinnedBytes() = default;
    PinnedBytes(const PinnedBytes&) = delete;
    PinnedBytes& operator=(const PinnedBytes&) = delete;
    ~PinnedBytes() { cudaFreeHost(at_); }
    // At least so many; what it held is lost where it grows.
    Result<> reach(u64 size) {
        if (size <= size_) return {};
        cudaFreeHost(at_);
        at_ = nullptr, size_ = 0;
        VX_TRY(check(cudaHostAlloc(&at_, size, cudaHostAllocPortable), "pinned memory"));
        size_ = size;
        return {};
    }
    template <class T = void>
    T* as() const {
        return static_cast<T*>(at_);
    }
    u64 size() const { return size_; }

private:
    void* at_ = nullptr;
    u64 size_ = 0;
};

} // namespace vitrail::trace::cuda
