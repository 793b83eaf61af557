#include "client/controls.h"

#include "platform/key_names.h"

namespace vitrail::client {

using platform::Key;

namespace {

constexpr std::array<ActionInfo, std::size_t(Action::count)> kActions = {{
    {Action::forward, "forward", "Forward", Key::w},
    {Action::back, "back", "Back", Key::s},
    {Action::left, "left", "Left", Key::a},
    {Action::right, "right", "Right", Key::d},
    {Action::jump, "jump", "Jump, rise", Key::space},
    {Action::sneak, "sneak", "Sneak, sink", Key::left_shift},
    {Action::sprint, "sprint", "Sprint", Key::left_ctrl},
    {Action::fly, "fly", "Fly", Key::f},
    {Action::blocks, "blocks", "List of blocks", Key::e},
    {Action::zoom, "zoom", "Zoom (hold)", Key::c},
    {Action::renderer, "renderer", "Raster or path tracer", Key::f5},
    {Action::pause_time, "pause_time", "Stop time of day", Key::p},
    {Action::time_back, "time_back", "Time of day back", Key::left_bracket},
    {Action::time_forward, "time_forward", "Time of day forward", Key::right_bracket},
    {Action::free_camera, "free_camera", "Free camera", Key::v},
    {Action::arrow_look, "arrow_look", "Look with arrow keys, free mouse", Key::z},
    {Action::look_left, "look_left", "Look left", Key::left},
    {Action::look_right, "look_right", "Look right", Key::right},
    {Action::look_up, "look_up", "Look up", Key::up},
    {Action::look_down, "look_down", "Look down", Key::down},
    {Action::hide_interface, "hide_interface", "Hide the interface", Key::f1},
    {Action::screenshot, "screenshot", "Screenshot", Key::f2},
    {Action::debug_text, "debug_text", "Debug text", Key::f3},
    {Action::full_screen, "full_screen", "Full screen", Key::f11},
}};

bool can_be_given(Key key) {
    const bool digit = key >= Key::n1 && key <= Key::n9; // hotbar
    return key != Key::escape && !digit && !platform::key_name(key).empty();
}

} // namespace

std::span<const ActionInfo> actions() {
    return kActions;
}

Bindings::Bindings() {
    for (const ActionInfo& info : kActions)
        keys[std::size_t(info.action)] = info.usual;
}

std::optional<Action> Bindings::action_of(Key key) const {
    if (key == Key::none) return {};
    for (std::size_t i = 0; i < keys.size(); ++i)
        if (keys[i] == key) return Action(i);
    return {};
}

bool Bindings::bind(Action action, Key key) {
    if (key == Key::none) {
        keys[std::size_t(action)] = key;
        return true;
    }
    if (!can_be_given(key)) return false;
    if (const auto other = action_of(key)) keys[std::size_t(*other)] = Key::none;
    keys[std::size_t(action)] = key;
    return true;
}

} // namespace vitrail::client
