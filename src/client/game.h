// The game in a window: input -> replica -> sections -> frame -> interface -> present. The loop's state is plain data; the
// functions that work on it stand in game_input.cpp, game_hud.cpp and game.cpp.
#pragma once

#include "client/controls.h"
#include "client/frame_builder.h"
#include "client/local_game.h"
#include "client/section_feeder.h"
#include "client/settings.h"
#include "client/traced_view.h"
#include "client/ui.h"
#include "platform/window.h"
#include "render/ui_imgui.h"
#include "rules/pick.h"
#include "scene/resolution.h"

#include <array>
#include <deque>
#include <filesystem>
#include <functional>
#include <optional>
#include <set>

namespace vitrail::client {

struct GameOptions {
    LocalGameOptions local;
    std::filesystem::path settings_file;     // empty: not kept
    std::filesystem::path screenshot_folder; // F2
    std::filesystem::path pack_folder;       // where the menu looks for resource packs
    u32 width = 1280, height = 720;
    i32 view_distance = 0;                   // 0: as the settings say
    std::vector<std::string> packs;          // resource packs; none: as the settings say
    std::string shader_folder;               // see render::RendererOptions
    bool trace = false;                      // begins with the path tracer
    trace::Device trace_device = trace::Device::best;
    u32 trace_devices = 1; // CUDA: a picture is split over so many at most
    std::function<TraceOptions(const TraceOptions&)> change_trace; // as change_effects
    // What the command line makes of the effects kept; null: nothing.
    std::function<render::Effects(const render::Effects&)> change_effects;
};

// Opens window and world, plays until the player quits, saves. Errors: no display, the server's.
Result<> run_game(const GameOptions& options, const Content& content);

struct Hotbar {
    std::vector<std::string> names; // block names, nine
    std::vector<gfx::Texture> icons;
    std::vector<std::string> icon_names; // what the icons show, to see what changed
    u32 selected = 0;
    float name_seconds = 0;
};

struct Notice {
    std::string text;
    float seconds = 8;
};

struct GameState {
    GameOptions options;
    Settings settings;
    bool settings_chosen = false; // a settings file was there
    std::shared_ptr<const BlockRegistry> registry; // that textures were loaded for
    std::vector<std::string> packs;                // that the player wants; where they cannot be opened none is in use
    std::shared_ptr<const scene::PackLooks> pack_looks;
    std::unique_ptr<platform::Window> window;
    std::unique_ptr<render::Renderer> renderer;
    std::unique_ptr<render::UiLayer> ui;
    std::unique_ptr<LocalGame> game;
    std::unique_ptr<ThreadPool> pool;
    std::unique_ptr<SectionFeeder> feeder;
    std::unique_ptr<TracedView> traced; // null until it was wanted
    bool trace_wanted = false;          // it is shown as soon as it is ready

    // Input.
    std::set<platform::Key> held;
    float yaw_deg = 0, pitch_deg = 0;
    bool fly_wanted = false; // toggled in this frame
    double last_space_seconds = -1;
    bool break_held = false, place_held = false;
    bool break_clicked = false, place_clicked = false; // since the last frame
    double next_break_seconds = 0, next_place_seconds = 0;
    bool screenshot_wanted = false, pick_wanted = false;
    bool time_paused = false; // asked of the server
    bool arrow_look = false;  // the mouse is free
    std::optional<Located<WorldPos>> free_eye; // free camera: the body stays, and nothing is asked for from here

    // Interface.
    std::optional<Action> key_waiting; // the menu: the next key is for this
    bool paused = false, block_list_open = false, debug_text = false, hide_ui = false, quit = false;
    PackPage pack_page;
    std::string block_filter;
    std::vector<std::string> block_names;
    Hotbar hotbar;
    std::deque<Notice> notices;

    // What the eye is on.
    std::optional<PickHit> hit;
    double seconds = 0; // since the start
    float frame_ms = 0; // smoothed
    float last_frame_ms = 0;
    scene::ResolutionControl resolution; // where a frame rate is to be held (Effects::Resolution)
    u64 frames = 0;
};

// game_input.cpp
void handle_events(GameState& state, const std::vector<platform::InputEvent>& events);
void act_on_world(GameState& state); // break, place, pick as the held buttons say
void set_paused(GameState& state, bool paused);
MoveCommand move_input(GameState& state); // of the keys held now; nothing while the camera is free
void move_camera(GameState& state, float seconds); // looks by arrow keys; moves the free camera
CameraPose camera(const GameState& state);

// game_trace.cpp
void show_traced(GameState& state, bool wanted); // says why where it cannot be
bool shows_traced(const GameState& state);       // what is drawn now comes from the path tracer
void draw_traced(GameState& state, scene::FrameView& frame); // where it is wanted; says why it went back to raster
double trace_budget_ms(double frame_seconds);
void feed_tracer(GameState& state, double budget_ms);
std::vector<std::string> trace_lines(const GameState& state); // for the debug text

// game_hud.cpp
void draw_interface(GameState& state);
std::vector<std::string> debug_lines_left(const GameState& state);
std::vector<std::string> debug_lines_right(const GameState& state);
void say(GameState& state, std::string text);
// While playing, and kept where it works; else tells why and all stays as it was.
void use_packs(GameState& state, const std::vector<std::string>& paths);
void keep_settings(GameState& state); // writes them where they are kept

} // namespace vitrail::client
