// What a person did, as plain data. Keys are named by their place on a US keyboard, as SDL's scancodes are.
#pragma once

#include "base/types.h"

#include <string>

namespace vitrail::platform {

// SDL scancodes by value, so that every key has a number; the ones the game names.
enum class Key : u16 {
    none = 0,
    a = 4,
    b,
    c,
    d,
    e,
    f,
    g,
    h,
    i,
    j,
    k,
    l,
    m,
    n,
    o,
    p,
    q,
    r,
    s,
    t,
    u,
    v,
    w,
    x,
    y,
    z,
    n1 = 30,
    n2,
    n3,
    n4,
    n5,
    n6,
    n7,
    n8,
    n9,
    n0,
    enter = 40,
    escape,
    backspace,
    tab,
    space,
    minus,
    equals,
    left_bracket,
    right_bracket,
    f1 = 58,
    f2,
    f3,
    f4,
    f5,
    f6,
    f7,
    f8,
    f9,
    f10,
    f11,
    f12,
    right = 79,
    left,
    down,
    up,
    left_ctrl = 224,
    left_shift,
    left_alt,
    left_gui,
    right_ctrl,
    right_shift,
    right_alt,
};

enum class MouseButton : u8 { none, left, middle, right, x1, x2 };

enum class EventKind : u8 { key, mouse_button, mouse_move, mouse_wheel, text, resize, focus, quit };

struct InputEvent {
    EventKind kind = EventKind::quit;
    bool down = false;   // key, mouse_button; focus: gained
    bool repeat = false; // key held
    Key key = Key::none;
    MouseButton button = MouseButton::none;
    float x = 0, y = 0;        // mouse: position in pixels; wheel: steps, y up
    float dx = 0, dy = 0;      // mouse_move: pixels moved (also while captured)
    u32 width = 0, height = 0; // resize: drawable pixels
    std::string text;          // UTF-8
};

} // namespace vitrail::platform
