#include "apps/commands.h"

#include <cstdio>

namespace vitrail::apps {

Result<> run_effects() {
    std::fputs(render::effects_table().c_str(), stdout);
    return {};
}

} // namespace vitrail::apps
