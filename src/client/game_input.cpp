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

void set_paused(GameState& state, bool paused) {
    state.paused = paused;
    state.window->capture_mouse(!paused && !state.block_list_open);
    state.held.clear();
    state.break_held = state.place_held = false;
}

static void open_block_list(GameState& state, bool open) {
    state.block_list_open = open;
    state.window->capture_mouse(!open && !state.paused);
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

static void on_key(GameState& state, Key key, bool down, bool repeat) {
    if (!down) {
        state.held.erase(key);
        return;
    }
    if (repeat) return;
    if (key == Key::escape) {
        if (state.block_list_open) open_block_list(state, false);
        else set_paused(state, !state.paused);
        return;
    }
    if (key == Key::f2) state.screenshot_wanted = true;
    if (key == Key::f3) state.debug_text = !state.debug_text;
    if (key == Key::f1) state.hide_ui = !state.hide_ui;
    if (key == Key::f11) {
        state.settings.fullscreen = !state.settings.fullscreen;
        state.window->set_fullscreen(state.settings.fullscreen);
        keep_settings(state);
    }
    if (state.paused || state.block_list_open) return;
    state.held.insert(key);
    if (key == Key::e) open_block_list(state, true);
    if (key == Key::f) state.fly_wanted = true;
    if (key == Key::space) {
        if (state.seconds - state.last_space_seconds < kDoubleTap) {
            state.fly_wanted = true;
            state.last_space_seconds = -1;
        } else {
            state.last_space_seconds = state.seconds;
        }
    }
    if (key >= Key::n1 && key <= Key::n9) select_slot(state, i32(key) - i32(Key::n1));
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
    auto down = [&](Key key) { return state.held.contains(key); };
    command.forward = i8(down(Key::w) - down(Key::s));
    command.strafe = i8(down(Key::d) - down(Key::a));
    command.jump = down(Key::space);
    command.sneak = down(Key::left_shift);
    command.sprint = down(Key::left_ctrl);
    command.toggle_flying = std::exchange(state.fly_wanted, false);
    return command;
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
