// What lies over the picture: crosshair, hotbar, F3 text, notices, pause menu. Drawn with Dear ImGui between
// UiLayer::begin_frame and end_frame; keeps no game state of its own.
#pragma once

#include "base/types.h"
#include "client/pack_list.h"
#include "client/settings.h"

#include <optional>
#include <string>
#include <vector>

namespace vitrail::client {

struct HotbarView {
    std::vector<u32> icons; // OpenGL texture names, 0 where there is none
    std::vector<std::string> names;
    u32 selected = 0;
    float name_seconds = 0; // the selected block's name is shown while above 0
};

enum class MenuAction : u8 { none, resume, settings_changed, packs_changed, quit };

// The page of resource packs while the menu is open.
struct PackPage {
    std::string folder;          // where packs are looked for, told to the player
    std::vector<PackEntry> list; // as the player has ordered them
    bool changed = false;        // differs from what is in use
};

void draw_crosshair();
void draw_hotbar(const HotbarView& hotbar, float ui_scale);
// One string a line, on a translucent ground; left or right side of the screen.
void draw_debug_text(const std::vector<std::string>& lines, bool right);
void draw_notices(const std::vector<std::string>& lines);
// A full-screen message while the world is loading; progress 0..1.
void draw_loading(const std::string& text, float progress);
// Changes `settings` and the page's list in place; answers what the player wants. packs_changed: use the list now.
MenuAction draw_pause_menu(Settings& settings, PackPage& packs);
// Part of the pause menu: which key does what. waiting: the action whose key the player is about to press.
void draw_keys(const Bindings& controls, std::optional<Action>& waiting, bool& usual_wanted);
// Block picker (E): answers the index chosen in `names`, or -1. `filter` keeps what was typed.
int draw_block_list(const std::vector<std::string>& names, std::string& filter, bool& open);
// Colors and roundings of all of it; once after the UiLayer exists.
void apply_style(float ui_scale);

} // namespace vitrail::client
