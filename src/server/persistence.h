// Opening a world's directory and write-behind saving of what a tick changed.
#pragma once

#include "server/world.h"

namespace vitrail::server {

// Opens or makes the world in options.folder. Errors: see Server::open.
Result<std::unique_ptr<ServerWorld>> open_world(ServerOptions options, const Content& content);

// Hands what changed to the store as one batch; the sessions hear of it when it is on disk.
void save_changes(ServerWorld& world);
// Everything, players and level too, and waits for the disk. Errors: io.
Result<> save_all(ServerWorld& world);
// Tells sessions which edits are on disk now.
void tell_kept(ServerWorld& world);

PlayerRecord player_record(const Session& session);
// Puts a player who is here to the start place (ServerOptions::start); one of another dimension leaves him where he is.
void put_at_start(const ServerWorld& world, Session& session);
// Puts the player where it was when it left, or at the spawn.
Result<> restore_player(ServerWorld& world, Session& session);

} // namespace vitrail::server
