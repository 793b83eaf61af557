#include "server/tick.h"

#include "server/chunk_loading.h"
#include "server/edits.h"
#include "server/interest.h"
#include "server/persistence.h"

#include <algorithm>

namespace vitrail::server {

namespace {

// While nobody moves everybody waits for the land; later the tick stays short, and this is still several times what the
// fastest player needs.
constexpr float kPublishBudgetMs = 25, kPublishBudgetTravelMs = 8;
constexpr u64 kUnloadTicks = 20, kTimeTicks = 100, kPlayerSaveTicks = 200;

void tell_results(ServerWorld& world) {
    for (auto& session : world.sessions) {
        for (const net::EditResult& result : session->results)
            send(*session, net::Channel::world, result);
        session->results.clear();
    }
}

void advance_time(ServerWorld& world) {
    world.level.time_ticks += world.day_runner.step(day_minutes_now(world));
    if (world.tick % kPlayerSaveTicks == 0) {
        world.level_dirty = !world.sessions.empty();
        for (auto& session : world.sessions)
            session->player_dirty |= session->joined;
    }
    if (world.tick % kTimeTicks != 0) return;
    for (auto& session : world.sessions)
        if (session->joined) tell_time(world, *session);
}

} // namespace

void run_tick(ServerWorld& world) {
    ++world.tick;
    hear_sessions(world);
    move_players(world);
    run_edits(world);
    request_columns(world);
    const bool travels =
        std::any_of(world.sessions.begin(), world.sessions.end(), [](const auto& s) { return s->travels; });
    publish_columns(world, travels ? kPublishBudgetTravelMs : kPublishBudgetMs);
    tell_light_changes(world);
    tell_results(world);
    for (auto& session : world.sessions) {
        if (!session->joined || session->gone) continue;
        update_interest(world, *session);
        send_sections(world, *session);
    }
    advance_time(world);
    save_changes(world);
    tell_kept(world);
    remove_gone_sessions(world);
    if (world.tick % kUnloadTicks == 0) unload_columns(world);
}

} // namespace vitrail::server
