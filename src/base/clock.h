#pragma once

#include "base/types.h"

namespace vitrail {

// Monotonic time, nanoseconds since an arbitrary start.
u64 now_ns();
// Processor time this thread has used, nanoseconds: what work costs, however many others want the processor.
u64 thread_time_ns();
inline double seconds_since(u64 start_ns) {
    return double(now_ns() - start_ns) * 1e-9;
}

// Peak resident memory of this process in bytes; 0 where the system does not tell.
u64 peak_memory_bytes();
// Resident memory now, bytes.
u64 resident_memory_bytes();

} // namespace vitrail
