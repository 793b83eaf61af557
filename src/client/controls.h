// What keys do, and which keys: one table of actions serves the game, the settings file ([keys]) and the menu. Every key
// but escape, the digits and the mouse can be given to another action.
#pragma once

#include "platform/input.h"

#include <array>
#include <optional>
#include <span>
#include <string_view>

namespace vitrail::client {

enum class Action : u8 {
    forward, back, left, right, jump, sneak, sprint, fly, // of the body, or of the free camera
    blocks,                                              // the list of blocks
    zoom,                                                // while held
    renderer,                                            // raster or trace
    pause_time, time_back, time_forward,
    free_camera,                                         // leaves the body where it is
    arrow_look,                                          // the mouse goes free; arrow keys look
    look_left, look_right, look_up, look_down,
    hide_interface, screenshot, debug_text, full_screen,
    count
};

struct ActionInfo {
    Action action;
    std::string_view key;  // in the settings file
    std::string_view name; // in the menu
    platform::Key usual;
};
std::span<const ActionInfo> actions(); // in enum order

// Which key an action has; none: it has none.
struct Bindings {
    Bindings(); // the usual keys
    std::array<platform::Key, std::size_t(Action::count)> keys;
    platform::Key of(Action action) const { return keys[std::size_t(action)]; }
    std::optional<Action> action_of(platform::Key key) const;
    // The action that had this key loses it. Keys that cannot be given away change nothing; answers whether it was done.
    bool bind(Action action, platform::Key key);
    bool operator==(const Bindings&) const = default;
};

// Day ticks that a step of time takes.
inline constexpr i32 kTimeStep = 500;
inline constexpr float kZoomDegrees = 40; // field of view while zooming, at most the player's own
inline constexpr float kArrowLookDegrees = 90; // a second

} // namespace vitrail::client
