#include "platform/key_names.h"

#include <array>
#include <utility>

namespace vitrail::platform {

namespace {

using Named = std::pair<Key, std::string_view>;
constexpr std::array kNames = {
    Named{Key::a, "a"},
    Named{Key::b, "b"},
    Named{Key::c, "c"},
    Named{Key::d, "d"},
    Named{Key::e, "e"},
    Named{Key::f, "f"},
    Named{Key::g, "g"},
    Named{Key::h, "h"},
    Named{Key::i, "i"},
    Named{Key::j, "j"},
    Named{Key::k, "k"},
    Named{Key::l, "l"},
    Named{Key::m, "m"},
    Named{Key::n, "n"},
    Named{Key::o, "o"},
    Named{Key::p, "p"},
    Named{Key::q, "q"},
    Named{Key::r, "r"},
    Named{Key::s, "s"},
    Named{Key::t, "t"},
    Named{Key::u, "u"},
    Named{Key::v, "v"},
    Named{Key::w, "w"},
    Named{Key::x, "x"},
    Named{Key::y, "y"},
    Named{Key::z, "z"},
    Named{Key::n1, "1"},
    Named{Key::n2, "2"},
    Named{Key::n3, "3"},
    Named{Key::n4, "4"},
    Named{Key::n5, "5"},
    Named{Key::n6, "6"},
    Named{Key::n7, "7"},
    Named{Key::n8, "8"},
    Named{Key::n9, "9"},
    Named{Key::n0, "0"},
    Named{Key::enter, "enter"},
    Named{Key::escape, "escape"},
    Named{Key::backspace, "backspace"},
    Named{Key::tab, "tab"},
    Named{Key::space, "space"},
    Named{Key::minus, "-"},
    Named{Key::equals, "="},
    Named{Key::left_bracket, "["},
    Named{Key::right_bracket, "]"},
    Named{Key::f1, "f1"},
    Named{Key::f2, "f2"},
    Named{Key::f3, "f3"},
    Named{Key::f4, "f4"},
    Named{Key::f5, "f5"},
    Named{Key::f6, "f6"},
    Named{Key::f7, "f7"},
    Named{Key::f8, "f8"},
    Named{Key::f9, "f9"},
    Named{Key::f10, "f10"},
    Named{Key::f11, "f11"},
    Named{Key::f12, "f12"},
    Named{Key::right, "right"},
    Named{Key::left, "left"},
    Named{Key::down, "down"},
    Named{Key::up, "up"},
    Named{Key::left_ctrl, "left ctrl"},
    Named{Key::left_shift, "left shift"},
    Named{Key::left_alt, "left alt"},
    Named{Key::left_gui, "left gui"},
    Named{Key::right_ctrl, "right ctrl"},
    Named{Key::right_shift, "right shift"},
    Named{Key::right_alt, "right alt"},
};

} // namespace

std::string_view key_name(Key key) {
    for (const auto& [named, name] : kNames)
        if (named == key) return name;
    return {};
}

std::optional<Key> key_from(std::string_view name) {
    for (const auto& [named, text] : kNames)
        if (text == name) return named;
    return {};
}

} // namespace vitrail::platform
