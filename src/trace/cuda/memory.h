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

// Work of a device beside its stream's: what is sent here begins after `sent` was recorded in that stream, which goes
// on with it once `arrived` was recorded here. The owner of the memory that it uses waits for the device before.
struct SideStream {
    cudaStream_t stream = nullptr;
    cudaEvent_t sent = nullptr, arrived = nullptr;

    SideStream() = default;
    SideStream(SideStream&& o) noexcept
        : stream(std::exchange(o.stream, nullptr))
        , sent(std::exchange(o.sent, nullptr))
        , arrived(std::exchange(o.arrived, nullptr)) {}
    SideStream& operator=(SideStream&&) = delete;
    ~SideStream() {
        for (cudaEvent_t e : {sent, arrived})
            if (e) cudaEventDestroy(e);
        if (stream) cudaStreamDestroy(stream);
    }
    Result<> open(const Gpu& gpu) {
        VX_TRY(gpu.use());
        VX_TRY(check(cudaStreamCreateWithFlags(&stream, cudaStreamNonBlocking), "a stream"));
        for (cudaEvent_t* e : {&sent, &arrived})
            VX_TRY(check(cudaEventCreateWithFlags(e, cudaEventDisableTiming), "an event"));
        return {};
    }
};

// Bytes that a kind of memory lent. Memory: take sets the address or says why not; give takes it back.
template <class Memory>
class OwnedBytes {
public:
    OwnedBytes() = default;
    OwnedBytes(OwnedBytes&& o) noexcept { swap(o); }
    OwnedBytes& operator=(OwnedBytes&& o) noexcept {
        swap(o);
        return *this;
    }
    ~OwnedBytes() {
        if (at_) memory_.give(at_);
    }
    // What it held is lost. size 0: nothing is held. Errors: limit.
    Result<> make(Memory memory, u64 size) {
        *this = OwnedBytes(); // gives back first: both may not fit
        if (size == 0) return {};
        VX_TRY(memory.take(at_, size));
        memory_ = memory;
        size_ = size;
        return {};
    }
    // At least so many; what it held is lost where it grows.
    Result<> reach(Memory memory, u64 size) { return size <= size_ ? Result<>() : make(memory, size); }
    template <class T = void>
    T* as() const {
        return static_cast<T*>(at_);
    }
    u64 size() const { return size_; }

private:
    void swap(OwnedBytes& o) noexcept {
        std::swap(at_, o.at_), std::swap(size_, o.size_), std::swap(memory_, o.memory_);
    }
    void* at_ = nullptr;
    u64 size_ = 0;
    Memory memory_;
};

// Of one device. Giving it back waits for what runs there.
struct DeviceMemory {
    int device = 0;

    DeviceMemory() = default;
    DeviceMemory(const Gpu& gpu)
        : device(gpu.id) {}
    Result<> take(void*& at, u64 size) const {
        VX_TRY(check(cudaSetDevice(device), "choosing the device"));
        return check(cudaMalloc(&at, size), "memory of the device");
    }
    void give(void* at) const {
        cudaSetDevice(device);
        cudaFree(at);
    }
};

// Of the host, that devices copy from and to without a detour.
struct PinnedMemory {
    Result<> take(void*& at, u64 size) const {
        return check(cudaHostAlloc(&at, size, cudaHostAllocPortable), "pinned memory");
    }
    void give(void* at) const { cudaFreeHost(at); }
};

using DeviceBytes = OwnedBytes<DeviceMemory>;
using PinnedBytes = OwnedBytes<PinnedMemory>;

} // namespace vitrail::trace::cuda
