#include "net/loopback.h"

#include "base/clock.h"
#include "base/rng.h"
#include "net/messages.h"

#include <atomic>
#include <deque>
#include <mutex>

namespace vitrail::net {

namespace {

struct Packet {
    Channel channel;
    u64 due_ns;
    Bytes bytes;
};

// One way of the connection.
struct Pipe {
    std::mutex mutex;
    std::deque<Packet> packets;
    std::size_t bytes = 0;
    Rng rng{1};
};

struct Shared {
    LoopbackOptions options;
    Pipe ways[2];
    std::atomic<bool> open{true};
    u64 now() const { return options.clock ? options.clock() : now_ns(); }
};

class LoopbackEnd final : public Transport {
public:
    LoopbackEnd(std::shared_ptr<Shared> shared, int side)
        : shared_(std::move(shared))
        , side_(side) {}
    ~LoopbackEnd() override { close(); }

    Result<> send(Channel channel, Bytes message) override {
        if (!shared_->open) return fail(ErrorCode::io, "the connection is closed");
        if (message.size() > kMostMessageBytes) return fail(ErrorCode::limit, "message is too long");
        Pipe& pipe = shared_->ways[side_];
        std::lock_guard lock(pipe.mutex);
        if (channel == Channel::motion && shared_->options.loss > 0 && pipe.rng.unit() < shared_->options.loss)
            return {};
        if (pipe.bytes + message.size() > shared_->options.queue_bytes_most)
            return fail(ErrorCode::limit, "the other side does not read its messages");
        pipe.bytes += message.size();
        pipe.packets.push_back({channel, shared_->now() + shared_->options.latency_ns, std::move(message)});
        return {};
    }

    void poll(const Receiver& receiver, std::size_t most) override {
        Pipe& pipe = shared_->ways[1 - side_];
        const u64 now = shared_->now();
        for (std::size_t n = 0; n < most; ++n) {
            Packet packet;
            {
                std::lock_guard lock(pipe.mutex);
                if (pipe.packets.empty() || pipe.packets.front().due_ns > now) return;
                packet = std::move(pipe.packets.front());
                pipe.packets.pop_front();
                pipe.bytes -= packet.bytes.size();
            }
            receiver(packet.channel, packet.bytes);
        }
    }

    std::size_t queued_bytes() const override {
        Pipe& pipe = shared_->ways[side_];
        std::lock_guard lock(pipe.mutex);
        return pipe.bytes;
    }
    bool open() const override { return shared_->open; }
    void close() override { shared_->open = false; }

private:
    std::shared_ptr<Shared> shared_;
    int side_;
};

} // namespace

std::pair<std::unique_ptr<Transport>, std::unique_ptr<Transport>> make_loopback(LoopbackOptions options) {
    auto shared = std::make_shared<Shared>();
    shared->options = std::move(options);
    for (int side = 0; side < 2; ++side)
        shared->ways[side].rng = Rng(shared->options.seed + u64(side) * 77);
    return {std::make_unique<LoopbackEnd>(shared, 0), std::make_unique<LoopbackEnd>(shared, 1)};
}

} // namespace vitrail::net
