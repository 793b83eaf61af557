#include "server/session.h"

#include "base/log.h"
#include "net/body_codec.h"
#include "server/interest.h"
#include "server/persistence.h"
#include "server/world.h"

#include <algorithm>
#include <fmt/format.h>

namespace vitrail::server {

namespace {

constexpr std::size_t kMessagesATickMost = 512;
constexpr std::size_t kRequestsATickMost = 64;
constexpr u32 kAsksATickMost = 8, kTimesATickMost = 8;
constexpr std::size_t kCommandsWaitingMost = 240;
constexpr std::size_t kPlayersLeftMost = 1000;
constexpr u64 kHelloTicksMost = 200; // who does not greet in 10 seconds is dropped

bool valid_name(const std::string& name) {
    if (name.empty() || name.size() > 32) return false;
    return std::all_of(name.begin(), name.end(), [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
    });
}

// Printable text in one line.
std::string clean(std::string text) {
    for (char& c : text)
        if (u8(c) < 32 || c == 127) c = ' ';
    return text;
}

void tell_all(ServerWorld& world, const net::Notice& notice) {
    for (auto& other : world.sessions)
        if (other->joined) send(*other, net::Channel::control, notice);
}

void hear(ServerWorld& world, Session& session, net::Hello& hello) {
    if (session.joined) return drop(session, "greeted twice");
    if (hello.version != net::kProtocolVersion)
        return drop(session,
                    fmt::format("this server speaks protocol {}, you speak {}", net::kProtocolVersion, hello.version));
    if (!valid_name(hello.name)) return drop(session, "a name has 1 to 32 letters, digits, _ or -");
    for (const auto& other : world.sessions)
        if (other->joined && !other->gone && other->name == hello.name)
            return drop(session, fmt::format("{} is playing already", hello.name));
    session.name = hello.name;
    session.view_distance = std::min(hello.view_distance, world.options.view_distance_most);
    if (auto restored = restore_player(world, session); !restored) {
        if (world.options.start) return drop(session, restored.error().message);
        log_error(fmt::format("player {}: {}", session.name, restored.error().message));
        return drop(session, "your player cannot be read from the world");
    }
    session.joined = true;
    if (hello.content_hash != world.content_hash)
        send(session, net::Channel::world, net::RegistryData{world.registry_bytes});
    net::Welcome welcome;
    welcome.player = session.id;
    for (const auto& [id, dimension] : world.dimensions) {
        const DimensionInfo& info = dimension.dimension.info();
        welcome.dimensions.push_back({u32(id), info.name, info.min_y, info.max_y, info.has_sky, info.sea_level});
    }
    welcome.body = net::wire_body(session.body);
    welcome.tick = world.tick;
    welcome.time_of_day = u32(world.level.time_ticks % kDayTicks);
    welcome.day = u32(world.level.time_ticks / kDayTicks);
    welcome.day_minutes = day_minutes_now(world);
    welcome.content_hash = world.content_hash;
    welcome.view_distance = session.view_distance;
    welcome.hotbar = session.hotbar;
    welcome.hotbar_selected = session.hotbar_selected;
    welcome.seed = world.level.seed;
    send(session, net::Channel::world, welcome);
    tell_tables(world, session);
    log_info(fmt::format("{} joined", session.name));
}

void hear(ServerWorld&, Session& session, net::MoveCommands& message) {
    for (const net::WireCommand& command : message.commands) {
        if (command.number <= session.last_heard_command) continue; // repeated, in case the first was lost
        if (command.number != session.last_heard_command + 1) return drop(session, "movement commands have a gap");
        if (session.commands.size() >= kCommandsWaitingMost) return; // it will repeat them
        session.commands.push_back(command);
        session.last_heard_command = command.number;
    }
}

void hear(ServerWorld&, Session& session, net::EditRequest& request) {
    if (request.sequence <= session.last_sequence) return drop(session, "edit requests out of order");
    if (session.requests.size() >= kRequestsATickMost) return drop(session, "too many edits at once");
    session.last_sequence = request.sequence;
    session.requests.push_back(std::move(request));
}

void hear(ServerWorld& world, Session& session, net::SetView& view) {
    session.view_distance = std::min(view.view_distance, world.options.view_distance_most);
    session.walk_again = true;
    session.columns_complete = false;
}

void hear(ServerWorld&, Session& session, net::SectionAck& ack) {
    if (ack.bytes > session.bytes_sent) return drop(session, "acknowledged more than was sent");
    session.bytes_acknowledged = std::max(session.bytes_acknowledged, ack.bytes);
}

void hear(ServerWorld&, Session& session, net::Leave&) {
    session.gone = true;
}

void hear(ServerWorld& world, Session& session, net::Say& say) {
    if (!say.text.empty()) tell_all(world, {session.name, clean(std::move(say.text))});
}

void hear(ServerWorld&, Session& session, net::Hotbar& hotbar) {
    session.hotbar = std::move(hotbar.names);
    session.hotbar_selected = hotbar.selected;
    session.player_dirty = true;
}

void hear(ServerWorld& world, Session& session, net::SetTime& wanted) {
    if (++session.times_heard > kTimesATickMost) return;
    if (!world.options.players_set_time)
        return send(session, net::Channel::control, net::Notice{"", "this server keeps its own time of day"});
    const i64 step = std::clamp<i64>(wanted.step, -i64(kDayTicks), i64(kDayTicks));
    world.level.time_ticks = u64(std::max<i64>(i64(world.level.time_ticks) + step, 0));
    world.time_paused = wanted.paused;
    world.level_dirty = true;
    for (auto& other : world.sessions)
        if (other->joined) tell_time(world, *other);
}

void hear(ServerWorld& world, Session& session, net::AskSections& asked) {
    if (++session.asks_heard <= kAsksATickMost) take_asks(world, session, asked);
}

} // namespace

void send(Session& session, net::Channel channel, Bytes message) {
    if (auto sent = session.transport->send(channel, std::move(message)); !sent && !session.gone) {
        session.gone = true;
        if (session.transport->open())
            log_warning(fmt::format("{} is dropped: {}", session.name, sent.error().message));
    }
}

u32 day_minutes_now(const ServerWorld& world) {
    return world.time_paused ? 0 : world.level.day_minutes;
}

void tell_time(const ServerWorld& world, Session& session) {
    send(session, net::Channel::control,
         net::TimeOfDay{world.tick, u32(world.level.time_ticks % kDayTicks), u32(world.level.time_ticks / kDayTicks),
                        day_minutes_now(world)});
}

void drop(Session& session, std::string reason) {
    if (session.gone) return;
    session.gone = true;
    session.gone_reason = std::move(reason);
}

void hear_sessions(ServerWorld& world) {
    for (auto& session : world.sessions) {
        if (session->gone) continue;
        const bool open = session->transport->open();
        session->asks_heard = session->times_heard = 0;
        session->transport->poll(
            [&](net::Channel, ByteView bytes) {
                if (session->gone) return;
                auto message = net::decode_client_message(bytes);
                if (!message) return drop(*session, fmt::format("bad message: {}", message.error().message));
                if (!session->joined && !std::holds_alternative<net::Hello>(*message) &&
                    !std::holds_alternative<net::Leave>(*message))
                    return drop(*session, "the first message must be a greeting");
                std::visit([&](auto& m) { hear(world, *session, m); }, *message);
            },
            kMessagesATickMost);
        if (!open) session->gone = true;
        if (!session->joined && ++session->ticks_silent > kHelloTicksMost) drop(*session, "no greeting came");
    }
}

void remove_gone_sessions(ServerWorld& world) {
    SaveBatch batch;
    for (auto& session : world.sessions) {
        if (!session->gone) continue;
        if (session->joined) batch.players.push_back(player_record(*session));
        if (!session->gone_reason.empty()) {
            (void)session->transport->send(net::Channel::control,
                                           net::encode_message(net::Goodbye{session->gone_reason.substr(0, 256)}));
            log_info(fmt::format("{} is dropped: {}", session->name.empty() ? "a client" : session->name,
                                 session->gone_reason));
        }
        session->transport->close();
    }
    if (!batch.players.empty()) {
        if (world.players_left.size() > kPlayersLeftMost && world.saves->flush()) world.players_left.clear();
        for (const PlayerRecord& record : batch.players)
            world.players_left.insert_or_assign(record.name, record);
        if (!world.options.read_only) world.saves->submit(std::move(batch));
    }
    std::erase_if(world.sessions, [](const auto& s) { return s->gone; });
}

} // namespace vitrail::server
