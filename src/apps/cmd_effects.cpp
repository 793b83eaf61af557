#include "apps/commands.h"

#include "client/trace_options.h"

#include <cstdio>

namespace vitrail::apps {

Result<> run_effects() {
    std::fputs(render::effects_table().c_str(), stdout);
    std::fputs("\nThe path tracer in the game (--trace KEY=VALUE):\n\n", stdout);
    std::fputs(client::trace_options_table().c_str(), stdout);
    return {};
}

} // namespace vitrail::apps
