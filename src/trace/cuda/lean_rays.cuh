// Warps whose lanes walk rays with an easy way (trace/kernel/lean_walk.h), and take the next ones when enough of them
// stand: ways differ in length several times over, and lanes that wait are most of what rays cost.
#pragma once

#include "trace/cuda/warp.cuh"
#include "trace/kernel/lean_walk.h"

namespace vitrail::trace::cuda {

// Numbers below `count` that warps take from a counter, kAtOnce for each turn; a turn ahead, so that nobody waits for
// the counter, and that rays can be fetched before they are needed.
struct Share {
    static constexpr u32 kAtOnce = 32;
    u32 count;
    u32* taken;
    u32 next = 0, last = 0, ahead = 0, asked = 0; // asked: lane 0's, on its way until it is looked at
    bool known = false;

    __device__ void ask() {
        // As it stands, by as much as no compiler knows: atomicAdd's code would wait for the answer.
        const u32 lane = threadIdx.x % 32;
        if (lane == 0)
            asm volatile("atom.global.add.u32 %0, [%1], %2;"
                         : "=r"(asked)
                         : "l"(taken), "r"(kAtOnce + lane)
                         : "memory");
        known = false;
    }
    // All lanes call it. Up to `want`; first: the first of them. 0: none now; forever if `none_left`.
    template <class Fetch>
    __device__ u32 take(u32 want, u32& first, bool& none_left, Fetch&& fetch) {
        if (!known) {
            ahead = __shfl_sync(~0u, asked, 0);
            known = true;
            if (ahead < count) fetch(ahead, count - ahead < kAtOnce ? count - ahead : kAtOnce);
        }
        if (next == last) {
            next = ahead < count ? ahead : count;
            last = count - next < kAtOnce ? count : next + kAtOnce;
            if (next < count) ask();
        }
        none_left = next == last;
        first = next;
        const u32 n = want < last - next ? want : last - next;
        next += n;
        return n;
    }
};

// The table: a device's, and a copy of a block's own, which all its threads have to ask for together. Where lanes look
// at many places at once the copy is faster, else loading it is not worth it.
static const __device__ BrickBoxes kDeviceBoxes = make_brick_boxes();
struct BoxesAt {
    const u64* of;
    __device__ u64 operator()(u32 i) const { return of[i]; }
};
__device__ inline BoxesAt device_boxes() {
    return {kDeviceBoxes.of};
}
__device__ __forceinline__ BoxesAt block_boxes() {
    __shared__ u64 boxes[kBrickBoxes];
    for (u32 i = threadIdx.x; i < kBrickBoxes; i += blockDim.x)
        boxes[i] = kDeviceBoxes.of[i];
    __syncthreads();
    return {boxes};
}

// ways: float most(), how far rays go; bool start(u32 number, AirWalk&), false: not an easy one; Ray ray(), that began
// last; void end(LeanEnd, const AirWalk&), of it; void fetch(u32 first, u32 count), rays that will begin soon.
template <class Ways>
__device__ __forceinline__ void lean_rays(const GridView& grid, Share share, Ways& ways, BoxesAt boxes) {
    constexpr int kIdle = 16; // lanes that stand; 12 and 20 cost 5 to 8 % more
    GridView g = grid;
    // Kept in registers: a load would fetch it anew each time, and wait.
    asm volatile("mov.b64 %0, %1;" : "=l"(g.masks) : "l"(grid.masks));
    AirWalk w{};
    bool busy = false, goes = false, none_left = false;
    const u32 below = (1u << threadIdx.x % 32) - 1;
    share.ask();
    for (;;) {
        if (busy && !goes) {
            LeanEnd end = lean_end(g, w, ways.most());
            if (end == LeanEnd::unsure) {
                goes = lean_exactly(g, ways.ray(), ways.most(), w);
                end = LeanEnd::passed;
            }
            if (!goes) {
                ways.end(end, w);
                busy = false;
            }
        }
        if (!none_left) {
            const u32 idle = __ballot_sync(~0u, !busy);
            u32 first;
            const u32 n = share.take(u32(__popc(idle)), first, none_left, [&](u32 a, u32 b) { ways.fetch(a, b); }),
                      rank = u32(__popc(idle & below));
            if (!busy && rank < n) busy = goes = ways.start(first + rank, w);
        }
        if (!__any_sync(~0u, busy)) {
            if (none_left) return;
            continue;
        }
        const int keep = none_left ? 0 : 32 - kIdle;
        u32 turns = kCellsMost;
        do {
            goes = step_air(g, w, boxes);
        } while (__popc(__ballot_sync(~0u, goes)) > keep && --turns != 0);
        if (turns == 0 && busy && goes) { // none goes so far
            ways.end(LeanEnd::hard, w);
            busy = goes = false;
        }
    }
}

// Lanes 0, 1, ... each a line of what lies there.
__device__ inline void fetch_lines(const void* from, u64 bytes) {
    const char* at = static_cast<const char*>(from) + (threadIdx.x % 32) * 128;
    if (at < static_cast<const char*>(from) + bytes) asm volatile("prefetch.global.L1 [%0];" ::"l"(at));
}

} // namespace vitrail::trace::cuda
