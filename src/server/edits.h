// Requests of players to break and place blocks, judged and applied (design: the path of an edit).
#pragma once

#include "server/world.h"

namespace vitrail::server {

// Judges the requests heard in this tick in order, applies what the rules allow, relights, tells sessions.
void run_edits(ServerWorld& world);

// Applies a batch as the server itself (scripts, commands, tests): no rights asked, else the same path. Edits of
// columns that are not loaded are left out.
ChangeSet edit_world(ServerWorld& world, ServerDimension& dimension, const EditBatch& batch);

} // namespace vitrail::server
