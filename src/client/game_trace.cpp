// The path tracer in the game: going over to it and back, its chunks, its figures.
#include "base/log.h"
#include "client/game.h"

#include <algorithm>
#include <fmt/format.h>

namespace vitrail::client {

// Frames are slow where the CPU traces, and land that is not in yet is what one waits for.
double trace_budget_ms(double frame_seconds) {
    return std::clamp(frame_seconds * 1000 * 0.2, 4.0, 100.0);
}

static Result<> open_tracer(GameState& state) {
    VX_TRY_ASSIGN(state.traced, TracedView::open({state.options.trace_device, state.options.trace_devices, *state.pool, *state.feeder,
                                                  state.game->replica(), state.registry, state.pack_looks}));
    return {};
}

bool shows_traced(const GameState& state) {
    return state.trace_wanted && state.traced && state.traced->ready();
}

void show_traced(GameState& state, bool wanted) {
    state.trace_wanted = wanted;
    if (!wanted) {
        if (state.traced) state.traced->hide(*state.renderer);
        state.feeder->set_meshing(true);
        return;
    }
    if (!state.traced)
        if (const auto opened = open_tracer(state); !opened) {
            say(state, opened.error().message);
            log_warning(opened.error().message);
            state.trace_wanted = false;
        }
}

void feed_tracer(GameState& state, double budget_ms) {
    if (state.trace_wanted && !state.traced) show_traced(state, true); // wanted from the start
    if (!state.trace_wanted) return;
    if (const auto fed = state.traced->feed(block_of(camera(state).eye.at), budget_ms); !fed) {
        show_traced(state, false);
        say(state, fed.error().message);
        return;
    }
    state.feeder->set_meshing(!state.traced->ready()); // catches up when meshes are drawn again
}

void draw_traced(GameState& state, scene::FrameView& frame) {
    if (!shows_traced(state)) return;
    const auto drawn =
        state.traced->draw(frame, state.settings.trace, state.settings.effects, state.last_frame_ms, *state.renderer);
    if (drawn) return;
    show_traced(state, false);
    say(state, drawn.error().message);
}

std::vector<std::string> trace_lines(const GameState& state) {
    const trace::TracerStats& stats = state.traced->stats();
    const double ms = std::max(stats.trace_ms, 1e-3);
    return {
        fmt::format("traced on {}  scale {:.2f}", stats.device, state.traced->share()),
        fmt::format("{:.2f} million rays/s  {} paths, {:.1f} rays each", double(stats.rays) * 1e-3 / ms, stats.paths,
                    double(stats.rays) / double(std::max<u64>(stats.paths, 1))),
        fmt::format("{} samples since rest", stats.samples),
        fmt::format("trace {:.1f} ms  denoise {:.1f} ms  world {:.1f} ms", stats.trace_ms, stats.denoise_ms,
                    stats.update_ms),
        fmt::format("{} chunks, {} waiting  {} lamps  {} MB, {} MB on the device", stats.chunks,
                    state.traced->waiting(), stats.emitters, stats.host_bytes >> 20, stats.device_bytes >> 20),
    };
}

} // namespace vitrail::client
