// Session: one client's connection and player, as the server knows them, and the functions that greet, hear and drop
// it.
#pragma once

#include "net/messages.h"
#include "net/transport.h"
#include "rules/movement.h"
#include "voxel/chunk.h"

#include <deque>
#include <memory>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <vector>

namespace vitrail::server {

struct ServerWorld;

// A section as this client holds it. The light last told is compared with the world's to find what to tell.
struct HeldSection {
    u64 revision = 0;
    std::shared_ptr<const LightVolume> light;
    bool air_notice = false; // told as one of AirSections; the whole section goes out when anything changes in it
};

struct Session {
    DimensionId dimension() const { return body.feet.dimension; }

    u32 id = 0;
    std::unique_ptr<net::Transport> transport;
    bool joined = false;
    bool gone = false;       // to be taken away at the end of the tick
    std::string gone_reason; // told to the client; empty: it left by itself
    std::string name;

    // Player.
    BodyState body;
    std::vector<std::string> hotbar;
    u32 hotbar_selected = 0;
    bool player_dirty = false;
    std::deque<net::WireCommand> commands; // heard, not run
    u32 last_heard_command = 0, last_command = 0;
    float steps_allowed = 0; // grows by 3 a tick: nobody moves faster than time
    bool tell_body = true;

    std::vector<net::EditRequest> requests; // heard in this tick
    std::vector<net::EditResult> results;   // told at the end of the tick, after blocks and light
    u32 last_sequence = 0;
    u32 unkept_sequence = 0; // accepted, not submitted to the store yet; 0 none

    // What it sees.
    u32 view_distance = 8;                  // chunks
    bool columns_complete = false;          // nothing it may see is missing
    bool followed = false, travels = false; // its way is known; it has left the place where it joined
    WorldPos joined_at{}, followed_at{};
    Vec3 speed{}; // mean of the last ticks, blocks a second
    u32 states_told = 2, biomes_told = 1;
    std::unordered_map<ChunkPos, HeldSection> held;
    std::unordered_set<ColumnPos> heights_told;
    std::deque<ChunkPos> wanted;       // reached and not held: `wanted_asked` of them as asked, the others nearest first
    std::size_t wanted_asked = 0;
    std::vector<ChunkPos> asked;       // by the client's last message
    bool asked_changed = false;        // or what is wanted has: to be put in order
    u64 asked_tick = 0;                // of that message; 0: it never asked
    u32 asks_heard = 0;                // in this tick
    u32 times_heard = 0;               // set_time, in this tick
    ChunkPos walked_from{}, walked_feet{};
    u64 walked_opened = ~u64(0);
    u64 walked_tick = 0;
    bool walk_again = true;
    u64 bytes_sent = 0, bytes_acknowledged = 0; // of sections
    u64 ticks_silent = 0;                       // before its greeting
};

// Sends; a client that does not read is dropped.
void send(Session& session, net::Channel channel, Bytes message);
template <class M>
void send(Session& session, net::Channel channel, const M& message) {
    send(session, channel, net::encode_message(message));
}

// Hears what every session sent since the last tick: greetings, commands, requests. A message that does not parse, or
// is not allowed yet, ends its session with a reason; the server goes on.
void hear_sessions(ServerWorld& world);
// Minutes that a day takes at the moment: 0 while a player has stopped time.
u32 day_minutes_now(const ServerWorld& world);
void tell_time(const ServerWorld& world, Session& session);

// Marks a session to be dropped with this reason.
void drop(Session& session, std::string reason);

// Says goodbye to dropped and closed sessions, saves their players, takes them away.
void remove_gone_sessions(ServerWorld& world);

// Runs the commands that time allows, by rules::step, and tells each client its body.
void move_players(ServerWorld& world);

} // namespace vitrail::server
