#include "replica/replica.h"

#include "base/clock.h"
#include "net/registry_codec.h"

namespace vitrail::replica {

Replica::Replica(std::unique_ptr<net::Transport> transport, ReplicaOptions options)
    : transport_(std::move(transport))
    , options_(std::move(options)) {
    net::Hello hello;
    hello.name = options_.name;
    hello.view_distance = options_.view_distance;
    hello.content_hash = options_.registry ? net::registry_hash(*options_.registry) : 0;
    send(net::Channel::control, hello);
}

Replica::~Replica() {
    leave();
}

template <class M>
void Replica::send(net::Channel channel, const M& message) {
    if (lost_) return;
    if (auto sent = transport_->send(channel, net::encode_message(message)); !sent) lose(sent.error().message);
}

template void Replica::send(net::Channel, const net::MoveCommands&);
template void Replica::send(net::Channel, const net::EditRequest&);
template void Replica::send(net::Channel, const net::SectionAck&);

void Replica::leave() {
    if (lost_) return;
    send(net::Channel::control, net::Leave{});
    lose("left");
}

void Replica::lose(std::string reason) {
    if (lost_) return;
    lost_ = true;
    lost_reason_ = std::move(reason);
}

std::vector<DirtySection> Replica::take_dirty() {
    std::vector<DirtySection> out;
    out.reserve(dirty_.size());
    for (const auto& [at, what] : dirty_)
        out.push_back({at, what});
    dirty_.clear();
    return out;
}

std::vector<EditAnswer> Replica::take_answers() {
    return std::exchange(answers_, {});
}
std::vector<net::Notice> Replica::take_notices() {
    return std::exchange(notices_, {});
}

void Replica::set_view_distance(u32 chunks) {
    options_.view_distance = view_distance_ = chunks;
    send(net::Channel::control, net::SetView{chunks});
}

void Replica::ask_for_sections(const Gaze& gaze) {
    const u64 now = now_ns();
    if (!joined() || double(now - ask_ns_) * 1e-9 < double(options_.ask_seconds)) return;
    ask_ns_ = now;
    // The server takes a client that was silent for 2 seconds for one that does not ask.
    const bool again = !asked_.empty() && now - asked_ns_ > 1'000'000'000;
    if (!again && !asks_.stale(gaze)) return;
    std::vector<ChunkPos> missing =
        asks_.stale(gaze) ? asks_.missing(*dimension_, gaze, view_distance_, net::kMostSectionsAsked) : asked_;
    if (!again && missing == asked_) return;
    asked_ = std::move(missing);
    asked_ns_ = now;
    net::AskSections message{u32(dimension_->info().id), {}};
    for (ChunkPos at : asked_)
        message.at.push_back(net::to_wire(at));
    send(net::Channel::control, message);
}

void Replica::say(const std::string& text) {
    send(net::Channel::control, net::Say{text});
}

void Replica::set_time(i32 step_ticks, bool paused) {
    send(net::Channel::control, net::SetTime{step_ticks, paused});
}

void Replica::set_hotbar(std::vector<std::string> names, u32 selected) {
    hotbar_ = names;
    hotbar_selected_ = selected;
    send(net::Channel::control, net::Hotbar{std::move(names), selected});
}

ReplicaStats Replica::stats() const {
    ReplicaStats stats = stats_;
    stats.pending_edits = u32(pending_.size());
    stats.pending_commands = u32(commands_.size());
    return stats;
}

} // namespace vitrail::replica
