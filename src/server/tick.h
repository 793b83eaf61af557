// One tick of 1/20 s: hear, move, edit, load, light, tell, save. The order makes a request's answer go out in the tick
// that heard it, after the blocks and the light it changed.
#pragma once

#include "server/world.h"

namespace vitrail::server {

void run_tick(ServerWorld& world);

} // namespace vitrail::server
