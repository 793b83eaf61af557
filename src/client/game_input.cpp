#include "client/game.h"

#include "math/angle.h"

#include <algorithm>
#include <cmath>

namespace vitrail::client {

using platform::Key;

// Degrees a pixel of mouse movement at sensitivity 1.
static constexpr float kDegreesAPixel = 0.12f;
// Seconds between edits while a button is held.
static constexpr double kEditRepeat = 0.22;
static constexpr double kDoubleTap = 0.3;
// Blocks a second of the free camera.
static constexpr float kFreeSpeed = 12, kFreeFastSpeed = 60;

void set_paused(GameState& state, bool paused) {
    state.paused = paused;
    if (paused) {
        const auto& folder = state.options.pack_folder;
        state.pack_page = {folder.string(), list_packs(folder, state.packs), false};
    }
    state.window->capture_mouse(!paused && !state.block_list_open && !state.arrow_look);
    state.held.clear();
    state.break_held = state.place_held = false;
}

static void open_block_list(GameState& state, bool open) {
    state.block_list_open = open;
    state.window->capture_mouse(!open && !state.paused && !state.arrow_look);
    state.window->start_text_input(open);
    state.held.clear();
    state.break_held = state.place_held = false;
}

static void select_slot(GameState& state, i32 slot) {
    const i32 count = i32(state.hotbar.names.size());
    if (count == 0) return;
    state.hotbar.selected = u32(((slot % count) + count) % count);
    state.hotbar.name_seconds = 2;
    state.game->replica().set_hotbar(state.hotbar.names, state.hotbar.selected);
}

static void toggle_free_camera(GameState& state) {
    if (state.free_eye) state.free_eye.reset();
    else state.free_eye = camera(state).eye;
    say(state, state.free_eye ? "free camera: the body stays where it is" : "back in the body");
}

static void step_time(GameState& state, i32 step) {
    if (step == 0) state.time_paused = !state.time_paused;
    state.game->replica().set_time(step, state.time_paused);
}

// While the interface takes no text. Answers whether the key did something that the world must not see too.
static bool on_interface_action(GameState& state, Action action) {
    switch (action) {
    case Action::screenshot: state.screenshot_wanted = true; return true;
    case Action::debug_text: state.debug_text = !state.debug_text; return true;
    case Action::hide_interface: state.hide_ui = !state.hide_ui; return true;
    case Action::renderer: show_traced(state, !state.trace_wanted); return true;
    case Action::full_screen:
        state.settings.fullscreen = !state.settings.fullscreen;
        state.window->set_fullscreen(state.settings.fullscreen);
        keep_settings(state);
        return true;
    default: return false;
    }
}

static void on_world_action(GameState& state, Action action) {
    switch (action) {
    case Action::blocks: open_block_list(state, true); break;
    case Action::fly: state.fly_wanted = true; break;
    case Action::pause_time: step_time(state, 0); break;
    case Action::time_back: step_time(state, -kTimeStep); break;
    case Action::time_forward: step_time(state, kTimeStep); break;
    case Action::free_camera: toggle_free_camera(state); break;
    case Action::arrow_look:
        state.arrow_look = !state.arrow_look;
        state.window->capture_mouse(!state.arrow_look);
        break;
    case Action::jump:
        if (state.seconds - state.last_space_seconds < kDoubleTap) {
            state.fly_wanted = true;
            state.last_space_seconds = -1;
        } else {
            state.last_space_seconds = state.seconds;
        }
        break;
    default: break;
    }
}

static void on_key(GameState& state, Key key, bool down, bool repeat) {
    if (!down) {
        state.held.erase(key);
        return;
    }
    const std::optional<Action> action = state.settings.controls.action_of(key);
    // Time goes on stepping while its key is held.
    if (repeat && action != Action::time_back && action != Action::time_forward) return;
    if (state.paused && state.key_waiting && key != Key::escape) {
        if (state.settings.controls.bind(*std::exchange(state.key_waiting, std::nullopt), key)) keep_settings(state);
        return;
    }
    if (key == Key::escape) {
        state.key_waiting.reset();
        if (state.block_list_open) open_block_list(state, false);
        else set_paused(state, !state.paused);
        return;
    }
    if (action && !state.block_list_open && on_interface_action(state, *action)) return;
    if (state.paused || state.block_list_open) return;
    state.held.insert(key);
    if (action) on_world_action(state, *action);
    if (key >= Key::n1 && key <= Key::n9) select_slot(state, i32(key) - i32(Key::n1));
}

static bool holds(const GameState& state, Action action) {
    return !state.paused && !state.block_list_open && state.held.contains(state.settings.controls.of(action));
}

void handle_events(GameState& state, const std::vector<platform::InputEvent>& events) {
    using platform::EventKind;
    for (const auto& event : events) {
        switch (event.kind) {
        case EventKind::quit: state.quit = true; break;
        case EventKind::focus:
            if (!event.down && !state.paused) set_paused(state, true);
            break;
        case EventKind::key: on_key(state, event.key, event.down, event.repeat); break;
        case EventKind::mouse_move:
            if (!state.window->mouse_captured()) break;
            state.yaw_deg = std::fmod(state.yaw_deg + event.dx * kDegreesAPixel * state.settings.mouse_sensitivity, 360.0f);
            state.pitch_deg += event.dy * kDegreesAPixel * state.settings.mouse_sensitivity * (state.settings.invert_y ? -1.0f : 1.0f);
            state.pitch_deg = std::clamp(state.pitch_deg, -90.0f, 90.0f);
            break;
        case EventKind::mouse_button:
            if (!state.window->mouse_captured()) break;
            if (event.button == platform::MouseButton::left) {
                state.break_held = event.down;
                state.break_clicked |= event.down;
            }
            if (event.button == platform::MouseButton::right) {
                state.place_held = event.down;
                state.place_clicked |= event.down;
            }
            if (event.button == platform::MouseButton::middle && event.down) state.pick_wanted = true;
            break;
        case EventKind::mouse_wheel:
            if (state.window->mouse_captured() && event.y != 0)
                select_slot(state, i32(state.hotbar.selected) - (event.y > 0 ? 1 : -1));
            break;
        default: break;
        }
    }
}

MoveCommand move_input(GameState& state) {
    MoveCommand command;
    command.yaw = state.yaw_deg * kRadiansADegree;
    command.pitch = state.pitch_deg * kRadiansADegree;
    if (state.paused || state.block_list_open) return command;
    command.toggle_flying = std::exchange(state.fly_wanted, false);
    if (state.free_eye) return command;
    command.forward = i8(holds(state, Action::forward) - holds(state, Action::back));
    command.strafe = i8(holds(state, Action::right) - holds(state, Action::left));
    command.jump = holds(state, Action::jump);
    command.sneak = holds(state, Action::sneak);
    command.sprint = holds(state, Action::sprint);
    return command;
}

void move_camera(GameState& state, float seconds) {
    const float turn = kArrowLookDegrees * std::min(seconds, 0.1f);
    state.yaw_deg = std::fmod(state.yaw_deg + turn * float(holds(state, Action::look_right) - holds(state, Action::look_left)), 360.0f);
    state.pitch_deg = std::clamp(state.pitch_deg + turn * float(holds(state, Action::look_down) - holds(state, Action::look_up)), -90.0f, 90.0f);
    if (!state.free_eye) return;
    const float yaw = state.yaw_deg * kRadiansADegree, pitch = state.pitch_deg * kRadiansADegree;
    const Vec3 ahead = look_direction(yaw, pitch), aside = look_direction(yaw + 90 * kRadiansADegree, 0);
    const Vec3 way = ahead * float(holds(state, Action::forward) - holds(state, Action::back)) +
                     aside * float(holds(state, Action::right) - holds(state, Action::left)) +
                     Vec3{0, 1, 0} * float(holds(state, Action::jump) - holds(state, Action::sneak));
    const float speed = holds(state, Action::sprint) ? kFreeFastSpeed : kFreeSpeed;
    state.free_eye->at = clamp_to_world(offset_by(state.free_eye->at, normalized(way) * (speed * std::min(seconds, 0.1f))));
}

CameraPose camera(const GameState& state) {
    const replica::Replica& replica = state.game->replica();
    CameraPose pose;
    pose.eye = {replica.body().feet.dimension, interpolate(eye_of(replica.body_before()), eye_of(replica.body()), replica.alpha())};
    if (state.free_eye && state.free_eye->dimension == pose.eye.dimension) pose.eye = *state.free_eye;
    pose.yaw_deg = state.yaw_deg;
    pose.pitch_deg = state.pitch_deg;
    pose.fov_deg = holds(state, Action::zoom) ? std::min(kZoomDegrees, state.settings.fov_deg) : state.settings.fov_deg;
    return pose;
}

// Puts the block that is looked at into the hotbar: selects it where it is there already.
static void pick_to_hotbar(GameState& state) {
    const auto& replica = state.game->replica();
    const std::string name = replica.states()->info(replica.dimension().state_at(state.hit->block)).state.name;
    const auto found = std::find(state.hotbar.names.begin(), state.hotbar.names.end(), name);
    if (found == state.hotbar.names.end()) {
        if (state.hotbar.selected < state.hotbar.names.size()) state.hotbar.names[state.hotbar.selected] = name;
        select_slot(state, i32(state.hotbar.selected));
    } else {
        select_slot(state, i32(found - state.hotbar.names.begin()));
    }
}

void act_on_world(GameState& state) {
    // A click counts even where press and release fell into one frame.
    const bool pick = std::exchange(state.pick_wanted, false);
    const bool break_now = std::exchange(state.break_clicked, false) || (state.break_held && state.seconds >= state.next_break_seconds);
    const bool place_now = std::exchange(state.place_clicked, false) || (state.place_held && state.seconds >= state.next_place_seconds);
    if (!state.hit || state.paused || state.block_list_open) return;
    replica::Replica& replica = state.game->replica();
    const PickHit& hit = *state.hit;
    if (pick) pick_to_hotbar(state);
    if (break_now) {
        state.next_break_seconds = state.seconds + kEditRepeat;
        if (const auto sent = replica.break_block(hit.block, hit.face, hit.point); !sent) say(state, sent.error().message);
    }
    if (place_now && state.hotbar.selected < state.hotbar.names.size()) {
        state.next_place_seconds = state.seconds + kEditRepeat;
        const auto sent = replica.place_block(hit.block, hit.face, hit.point, state.hotbar.names[state.hotbar.selected]);
        (void)sent; // no room, a body in the way: nothing happens, as in the world
    }
}

} // namespace vitrail::client
