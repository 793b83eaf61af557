// Transport: one end of a connection that carries whole messages. Implementations: net/loopback.h (in process); a
// socket one comes with multiplayer. Messages of one reliable channel arrive whole, once and in order; channels do not
// wait for each other.
#pragma once

#include "base/bytes.h"
#include "base/result.h"

#include <functional>
#include <string>

namespace vitrail::net {

enum class Channel : u8 { control, world, motion, count }; // motion is unreliable: may lose, never reorders backwards

class Transport {
public:
    using Receiver = std::function<void(Channel, ByteView)>;

    virtual ~Transport() = default;
    // Queues one message. Errors: limit (the other side does not read; the queue is full), io (closed).
    virtual Result<> send(Channel channel, Bytes message) = 0;
    // Hands over every message that has arrived, oldest first a channel, in the calling thread; the view lives for the
    // call only. At most `most` messages.
    virtual void poll(const Receiver& receiver, std::size_t most = std::size_t(-1)) = 0;
    // Bytes sent and not yet polled by the other side (an estimate on sockets).
    virtual std::size_t queued_bytes() const = 0;
    // False after either side closed; messages that had arrived can still be polled.
    virtual bool open() const = 0;
    virtual void close() = 0;
};

} // namespace vitrail::net
