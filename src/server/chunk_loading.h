// Which columns are loaded: all that some session may see, nearest first and in the direction it looks, and no others.
#pragma once

#include "server/world.h"

namespace vitrail::server {

// Columns beyond the view distance that are loaded: sections at the edge need their neighbors for surfaces and light,
// and what comes into view shall be there already.
inline constexpr float kLoadMargin = 2.5f;
// Columns beyond the view distance that stay loaded, so that walking to and fro loads nothing.
inline constexpr float kKeepMargin = 4.5f;

// Tells the schedulers what is wanted, and lets them hand out work.
void request_columns(ServerWorld& world);
// Puts finished columns into their dimensions and lights them, for at most `budget_ms`.
void publish_columns(ServerWorld& world, float budget_ms);
// Lets columns go that nobody needs; what was changed in them has been handed to the store before.
void unload_columns(ServerWorld& world);

// True where this column and the eight around it are ready: its surfaces and light will stay as they are.
bool surrounded(const ServerDimension& dimension, ColumnPos at);
bool ready(const ServerDimension& dimension, ColumnPos at);

// The chunk, made as air where its column is made and it is absent; null where there is nothing.
ChunkPtr require_chunk(ServerDimension& dimension, ChunkPos at);

} // namespace vitrail::server
