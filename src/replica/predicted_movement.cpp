// The player's own movement: steps run here at once by the server's own rules, are sent as numbered commands, and are
// replayed from the server's body where that turns out to differ.
#include "net/body_codec.h"
#include "replica/replica.h"

#include <algorithm>

namespace vitrail::replica {

namespace {

constexpr u32 kStepsACallMost = 15;
constexpr std::size_t kUnansweredMost = 200; // beyond it the player waits for the server

} // namespace

void Replica::place_body(const net::WireBody& wire) {
    body_ = body_before_ = base_ = net::body_from_wire<BodyState>(wire);
}

void Replica::run_step(MoveCommand command) {
    command.number = next_command_++;
    // What the server will read, so that both step from the same numbers.
    command = net::command_from_wire<MoveCommand>(net::wire_command(command));
    body_before_ = body_;
    body_ = step(*dimension_, body_, command);
    commands_.push_back({command, body_});
    unsent_ = true;
}

void Replica::move(const MoveCommand& input, float seconds) {
    MoveCommand command = input;
    command.toggle_flying |= toggle_waits_;
    toggle_waits_ = false;
    due_ = std::min(due_ + seconds, kStepSeconds * float(kStepsACallMost));
    bool ran = false;
    while (due_ >= kStepSeconds && commands_.size() < kUnansweredMost) {
        due_ -= kStepSeconds;
        run_step(command);
        command.toggle_flying = false;
        ran = true;
    }
    if (!ran) toggle_waits_ = command.toggle_flying;
    alpha_ = std::min(due_ / kStepSeconds, 1.0f);
    send_commands();
}

void Replica::send_commands() {
    if (!unsent_) return;
    unsent_ = false;
    net::MoveCommands message;
    message.commands.reserve(commands_.size());
    for (const SentCommand& sent : commands_)
        message.commands.push_back(net::wire_command(sent.command));
    send(net::Channel::motion, message);
}

Result<> Replica::take(net::BodyState& message) {
    if (!joined()) return {};
    if (message.last_command < answered_) return {}; // an older one, overtaken
    if (message.last_command >= next_command_) return fail(ErrorCode::damaged, "an answer to a command never sent");
    answered_ = message.last_command;
    const BodyState told = net::body_from_wire<BodyState>(message.body);
    BodyState predicted = base_;
    while (!commands_.empty() && commands_.front().command.number <= message.last_command) {
        predicted = commands_.front().after;
        commands_.pop_front();
    }
    base_ = told;
    if (predicted == told) return {};
    ++stats_.corrections;
    body_ = body_before_ = told;
    for (SentCommand& sent : commands_) {
        body_before_ = body_;
        body_ = sent.after = step(*dimension_, body_, sent.command);
    }
    return {};
}

} // namespace vitrail::replica
