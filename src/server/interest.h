// What each session is told of the world: sections that open space joins to its player, as surfaces, each once, then
// deltas.
#pragma once

#include "server/world.h"
#include "voxel/surface.h"

namespace vitrail::server {

// Finds the sections a session should hold (a walk over face connections from its eye and its feet) where it moved to
// another section or the world opened, and lets go of those out of range.
void update_interest(ServerWorld& world, Session& session);
// What the client would like to have first; what lies out of its range is left out.
void take_asks(const ServerWorld& world, Session& session, const net::AskSections& asked);
// Sends wanted sections, asked ones first, then nearest first, within the bounds on bytes.
void send_sections(ServerWorld& world, Session& session);

// Tells every session what these changes make of the sections it holds.
void tell_block_changes(ServerWorld& world, ServerDimension& dimension, const ChangeSet& changes);
// Tells light and heights that changed in this tick.
void tell_light_changes(ServerWorld& world);
// New state and biome texts; before anything that uses them.
void tell_tables(ServerWorld& world, Session& session);

OpaqueStates opaque_states(const StateTable& states);
// The section as a client may know it.
Chunk surface_of(const ServerDimension& dimension, ChunkPos at, const Chunk& chunk);
// The world as surfaces see it: opaque below the world and where nothing was made, air above.
StateId state_for_surface(const ServerDimension& dimension, BlockPos at);

} // namespace vitrail::server
