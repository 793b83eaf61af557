// Players move by the same step as their clients predict; the server only trusts the inputs, and only as many as time
// allows.
#include "net/body_codec.h"
#include "server/world.h"

#include <algorithm>

namespace vitrail::server {

namespace {

constexpr float kStepsATick = 3;      // 60 steps a second at 20 ticks
constexpr float kStepsSavedMost = 30; // half a second of lag may be caught up

} // namespace

void move_players(ServerWorld& world) {
    for (auto& session : world.sessions) {
        if (!session->joined) continue;
        session->steps_allowed = std::min(session->steps_allowed + kStepsATick, kStepsSavedMost);
        const Dimension& dimension = world.dimensions.at(session->dimension()).dimension;
        bool ran = false;
        while (!session->commands.empty() && session->steps_allowed >= 1) {
            const auto command = net::command_from_wire<MoveCommand>(session->commands.front());
            session->commands.pop_front();
            session->steps_allowed -= 1;
            session->body = step(dimension, session->body, command);
            session->last_command = command.number;
            ran = true;
        }
        if (ran || session->tell_body)
            send(*session, net::Channel::motion, net::BodyState{session->last_command, net::wire_body(session->body)});
        session->tell_body = false;
    }
}

} // namespace vitrail::server
