// Loopback: a connection inside one process, two bounded byte-message queues. Thread-safe: each end is used by its
// thread.
#pragma once

#include "net/transport.h"

#include <memory>
#include <utility>

namespace vitrail::net {

struct LoopbackOptions {
    u64 latency_ns = 0;                       // each way
    float loss = 0;                           // 0..1, of unreliable messages
    u64 seed = 1;                             // of the losses
    std::size_t queue_bytes_most = 64u << 20; // a way
    // Monotonic nanoseconds; null: base/clock.h. Tests bring their own.
    std::function<u64()> clock;
};

// Client's end, server's end.
std::pair<std::unique_ptr<Transport>, std::unique_ptr<Transport>> make_loopback(LoopbackOptions options = {});

} // namespace vitrail::net
