// Sky and RGB block light of a dimension (docs/decisions/0003-light.md). How to use it:
//   put chunks (and their column heights) into the dimension, then  ChangeSet lit = relight_chunks(dimension,
//   positions); after edits                                                     ChangeSet c = apply(dimension, batch);
//   relight(dimension, c);
// Both leave every lit chunk with the same light that a solver over all lit chunks at once would find, whatever the
// order of loading and editing. The server runs it for the world; a client runs the same functions on its replica to
// flood its own predictions.
//
// The model, for each of the four channels, 0..15: a cell has the largest of what it emits and of what its six
// neighbors have less max(1, opacity of this cell). A cell at or above its column's height (Dimension::heights) has sky
// light 15. Light flows through lit chunks only: absent chunks and those whose light is null have no cells.
#pragma once

#include "voxel/coords.h"
#include "voxel/edit.h"
#include "world/dimension.h"

#include <span>

namespace vitrail {

// Lights these chunks from nothing, takes in the light of lit chunks around and lets light out into them; absent
// positions are left out. Columns without heights get them from the loaded chunks; where a column's heights differ from
// what its already lit chunks were lit with, those follow. Publishes one new snapshot for each chunk whose light
// changed (revision grows by one for chunks lit before; a first lighting keeps it). Returns these chunks in
// light_chunks. Whole columns, or many columns at once, are cheapest.
ChangeSet relight_chunks(Dimension& dimension, std::span<const ChunkPos> chunks);

// Brings light up to date after the block changes of `changes` (already applied, heights too) and adds the chunks whose
// light changed to changes.light_chunks. Publishes each of them once.
void relight(Dimension& dimension, ChangeSet& changes);

} // namespace vitrail
