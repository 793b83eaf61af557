#include "client/game.h"

#include "base/clock.h"
#include "base/log.h"
#include "client/packs.h"
#include "gfx/context.h"
#include "math/angle.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <epoxy/gl.h>
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <thread>

namespace vitrail::client {

static void take_screenshot(GameState& state) {
    render::Image image;
    image.width = state.window->width();
    image.height = state.window->height();
    image.pixels.resize(std::size_t(image.width) * image.height * 3);
    std::vector<u8> bottom_up(image.pixels.size());
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glReadPixels(0, 0, i32(image.width), i32(image.height), GL_RGB, GL_UNSIGNED_BYTE, bottom_up.data());
    const std::size_t row = std::size_t(image.width) * 3;
    for (u32 y = 0; y < image.height; ++y)
        std::copy_n(bottom_up.data() + row * (image.height - 1 - y), row, image.pixels.data() + row * y);
    std::error_code error;
    std::filesystem::create_directories(state.options.screenshot_folder, error);
    const std::string stem = fmt::format("vitrail-{:%Y%m%d-%H%M%S}", fmt::localtime(std::time(nullptr)));
    std::filesystem::path path = state.options.screenshot_folder / (stem + ".png");
    for (int i = 2; std::filesystem::exists(path, error) && i < 100; ++i) // several in one second
        path = state.options.screenshot_folder / fmt::format("{}-{}.png", stem, i);
    const auto written = render::write_png(path.string(), image);
    say(state, written ? fmt::format("screenshot: {}", path.string()) : written.error().message);
}

static Result<> open_window(GameState& state) {
    platform::WindowOptions window;
    window.width = state.options.width;
    window.height = state.options.height;
    window.vsync = state.settings.vsync;
    VX_TRY_ASSIGN(state.window, platform::Window::create(window));
    if (state.settings.fullscreen) state.window->set_fullscreen(true);
    // Until the player says otherwise, a machine without a graphics card draws plainly.
    if (const auto info = gfx::context_info(); info && info->software && !state.settings_chosen)
        state.settings.effects = render::preset_effects(render::Preset::low);
    if (state.options.change_effects) state.settings.effects = state.options.change_effects(state.settings.effects);
    VX_TRY_ASSIGN(state.renderer, render::Renderer::create({.effects = state.settings.effects, .shader_folder = state.options.shader_folder}));
    VX_TRY_ASSIGN(state.ui, render::UiLayer::create(*state.window));
    apply_style(state.settings.ui_scale);
    return {};
}

// A picture while the world is not there yet. False: the player closed the window.
static bool draw_waiting(GameState& state, const std::string& text, float progress) {
    std::vector<platform::InputEvent> events;
    state.window->poll(events);
    for (const auto& event : events)
        if (event.kind == platform::EventKind::quit) return false;
    glViewport(0, 0, i32(state.window->width()), i32(state.window->height()));
    glClearColor(0.1f, 0.14f, 0.2f, 1);
    glClear(GL_COLOR_BUFFER_BIT);
    state.ui->begin_frame();
    draw_loading(text, progress);
    state.ui->end_frame();
    state.window->swap();
    return true;
}

// Until the land around the player is there and drawn; at most 15 s, then the rest comes while playing.
static Result<bool> wait_for_world(GameState& state) {
    replica::Replica& replica = state.game->replica();
    const u64 start = now_ns();
    while (!replica.joined()) {
        if (!replica.poll()) return fail(ErrorCode::denied, fmt::format("the server let nobody in: {}", replica.lost_reason()));
        if (!draw_waiting(state, "Opening the world", 0)) return false;
        if (seconds_since(start) > 60) return fail(ErrorCode::limit, "the server did not answer within 60 s");
    }
    const u64 joined = now_ns();
    for (;;) {
        if (!replica.poll()) return fail(ErrorCode::denied, replica.lost_reason());
        const BlockPos at = block_of(replica.body().feet.at);
        state.feeder->update(replica, at, 10);
        feed_tracer(state, 10);
        const FeederStats stats = state.feeder->stats();
        const bool ground = replica.has_section(chunk_of(at));
        // The tracer needs no meshes: it has what it was told.
        if (shows_traced(state) && ground && state.traced->waiting() == 0) return true;
        if ((ground && stats.meshed > 0 && stats.waiting + stats.in_flight == 0) || seconds_since(joined) > 15) return true;
        const float done = float(stats.meshed) / float(stats.meshed + stats.waiting + stats.in_flight + 20);
        if (!draw_waiting(state, "Laying out the land", done)) return false;
    }
}

static void fill_hotbar(GameState& state) {
    replica::Replica& replica = state.game->replica();
    state.hotbar.names = replica.hotbar();
    state.hotbar.selected = replica.hotbar_selected();
    if (state.hotbar.names.empty()) state.hotbar.names = replica.registry()->hotbar;
    state.hotbar.names.resize(9, "minecraft:stone");
    for (const BlockDef& block : replica.registry()->blocks())
        if (block.in_hotbar_list && block.look.shape != ShapeKind::none && block.name != "vitrail:unknown")
            state.block_names.push_back(block.name);
    std::sort(state.block_names.begin(), state.block_names.end());
}

static replica::Gaze gaze(const GameState& state, const CameraPose& pose) {
    const float up = std::tan(pose.fov_deg * kRadiansADegree * 0.5f);
    const float aside = up * float(state.window->width()) / float(std::max(state.window->height(), 1u));
    return {pose.eye.at, look_direction(pose.yaw_deg * kRadiansADegree, pose.pitch_deg * kRadiansADegree),
            std::atan(std::sqrt(up * up + aside * aside))};
}

static void update_world(GameState& state, float seconds) {
    replica::Replica& replica = state.game->replica();
    if (!replica.poll()) {
        log_error(replica.lost_reason());
        state.quit = true;
        return;
    }
    move_camera(state, seconds);
    replica.move(move_input(state), seconds);
    for (const auto& answer : replica.take_answers())
        if (answer.outcome == net::EditOutcome::refused) say(state, answer.reason);
    for (const auto& notice : replica.take_notices())
        say(state, notice.from.empty() ? notice.text : fmt::format("{}: {}", notice.from, notice.text));
    const CameraPose pose = camera(state);
    if (!state.free_eye) replica.ask_for_sections(gaze(state, pose));
    state.hit = state.free_eye ? std::nullopt : pick_block(replica.dimension(), pose.eye.at, look_direction(pose.yaw_deg * kRadiansADegree, pose.pitch_deg * kRadiansADegree), kReach);
    act_on_world(state);
    state.feeder->update(replica, block_of(pose.eye.at), feed_budget_ms(seconds));
    feed_tracer(state, trace_budget_ms(seconds));
}

static Result<> draw(GameState& state) {
    replica::Replica& replica = state.game->replica();
    scene::FrameView frame = build_frame(camera(state), replica.dimension(), state.window->width(), state.window->height(),
                                         replica.day_ticks(), replica.view_distance(), float(state.seconds),
                                         water_tint_at(replica, block_of(camera(state).eye.at)));
    frame.gamma_exposure = state.settings.gamma;
    if (const auto& resolution = state.settings.effects.resolution; resolution.hold > 0 && !shows_traced(state)) {
        constexpr float kLeast = 0.6f; // below it, far blocks lose their shape
        const float most = resolution.scale;
        frame.resolution = state.resolution.next(state.last_frame_ms,
                                                 {1000.0f / float(resolution.hold), std::min(kLeast, most), most});
    }
    if (state.hit && !state.hide_ui) {
        scene::Outline outline;
        outline.at = {replica.dimension().info().id, state.hit->block};
        const BlockShape& shape = replica.states()->info(replica.dimension().state_at(state.hit->block)).shape;
        for (const ShapeBox& box : shape.pick) {
            constexpr float unit = 1.0f / float(kShapeUnit);
            outline.boxes.push_back({{box.min[0] * unit, box.min[1] * unit, box.min[2] * unit},
                                     {box.max[0] * unit, box.max[1] * unit, box.max[2] * unit}});
        }
        frame.outlines.push_back(outline);
    }
    if (frame.width > 0 && frame.height > 0) {
        draw_traced(state, frame);
        VX_TRY(state.renderer->render(frame, 0));
    }
    state.ui->begin_frame();
    draw_interface(state);
    state.ui->end_frame();
    if (std::exchange(state.screenshot_wanted, false)) take_screenshot(state);
    state.window->swap();
    return {};
}

static Result<> play(GameState& state) {
    const u64 start = now_ns();
    u64 last = start;
    std::vector<platform::InputEvent> events;
    while (!state.quit) {
        const u64 now = now_ns();
        const float seconds = float(now - last) * 1e-9f;
        last = now;
        state.seconds = double(now - start) * 1e-9;
        state.last_frame_ms = state.frames == 0 ? 0 : seconds * 1e3f;
        state.frame_ms = state.frames == 0 ? seconds * 1e3f : lerp(state.frame_ms, seconds * 1e3f, 0.1f);
        ++state.frames;
        events.clear();
        state.window->poll(events);
        handle_events(state, events);
        update_world(state, seconds);
        state.hotbar.name_seconds -= seconds;
        for (Notice& notice : state.notices) notice.seconds -= seconds;
        std::erase_if(state.notices, [](const Notice& n) { return n.seconds <= 0; });
        VX_TRY(draw(state));
        if (state.settings.frame_limit > 0) {
            const double rest = 1.0 / state.settings.frame_limit - seconds_since(now);
            if (rest > 0) std::this_thread::sleep_for(std::chrono::duration<double>(rest));
        }
    }
    return {};
}

Result<> run_game(const GameOptions& options, const Content& content) {
    GameState state;
    state.options = options;
    if (!options.settings_file.empty()) {
        std::error_code ignored;
        state.settings_chosen = std::filesystem::exists(options.settings_file, ignored);
        // A broken settings file must not keep anybody from playing, nor be overwritten unseen: the line says what is wrong.
        if (auto settings = load_settings(options.settings_file)) state.settings = *settings;
        else log_warning(settings.error().message);
    }
    if (options.view_distance > 0) state.settings.view_distance = options.view_distance;
    VX_TRY(open_window(state));
    state.registry = content.registry;
    state.packs = options.packs.empty() ? state.settings.packs : options.packs;
    if (!options.packs.empty()) {
        VX_TRY_ASSIGN(state.pack_looks, open_packs(options.packs, *content.registry));
    } else if (auto kept = open_packs(state.settings.packs, *content.registry)) {
        state.pack_looks = std::move(*kept);
    } else { // a pack that was moved away must not keep anybody from playing
        log_warning(kept.error().message);
    }
    VX_TRY(state.renderer->load_textures(*content.registry, state.pack_looks.get()));
    LocalGameOptions local = options.local;
    local.server.threads = default_worker_count();
    local.replica.view_distance = u32(state.settings.view_distance);
    VX_TRY_ASSIGN(state.game, LocalGame::open(local, content));
    state.pool = std::make_unique<ThreadPool>(default_worker_count());
    state.feeder = std::make_unique<SectionFeeder>(*state.renderer, *state.pool, state.pack_looks);
    if (options.change_trace) state.settings.trace = options.change_trace(state.settings.trace);
    state.trace_wanted = options.trace;
    VX_TRY_ASSIGN(const bool ready, wait_for_world(state));
    Result<> played;
    if (ready) {
        fill_hotbar(state);
        state.yaw_deg = state.game->replica().body().yaw * kDegreesARadian;
        state.pitch_deg = state.game->replica().body().pitch * kDegreesARadian;
        set_paused(state, false);
        played = play(state);
    }
    state.window->capture_mouse(false);
    state.traced.reset();
    state.feeder.reset();
    const Result<> saved = state.game->stop();
    state.hotbar.icons.clear(); // textures go before their context
    state.renderer.reset();
    state.ui.reset();
    VX_TRY(played);
    return saved;
}

} // namespace vitrail::client
