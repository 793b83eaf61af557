// What a path may do. Kernel-safe.
#pragma once

#include "base/types.h"

namespace vitrail::trace {

struct PathSettings {
    u32 bounces = 4; // scattering events at matte or glossy surfaces; straight passages and mirrors do not count, but
    u32 events_most = 32;    // all together end here
    u32 roulette_from = 3;   // Russian roulette from this bounce on
    float firefly_limit = 0; // radiance beyond, of a single indirect contribution, is held (by luminance); 0: never
    bool fog = true;
    bool direct_lamps = true; // emitters are sampled directly (off: only found by chance; for tests)
    u32 seed = 0;
    u32 first_sample = 0; // number of a pixel's sample in its sequence
};

} // namespace vitrail::trace
