#include "client/ui.h"

#include "platform/key_names.h"

#include <algorithm>
#include <cstdint>
#include <fmt/format.h>
#include <imgui/imgui.h>
#include <imgui/imgui_stdlib.h>

namespace vitrail::client {

void apply_style(float ui_scale) {
    ImGui::GetIO().IniFilename = nullptr; // nothing is written beside the program
    ImGuiStyle style;
    ImGui::StyleColorsDark(&style);
    style.WindowRounding = style.FrameRounding = style.GrabRounding = 4;
    style.WindowPadding = {14, 12};
    style.ItemSpacing = {8, 7};
    style.Colors[ImGuiCol_WindowBg] = {0.07f, 0.08f, 0.10f, 0.92f};
    style.Colors[ImGuiCol_Button] = {0.24f, 0.33f, 0.44f, 1.0f};
    style.Colors[ImGuiCol_ButtonHovered] = {0.33f, 0.46f, 0.60f, 1.0f};
    style.Colors[ImGuiCol_SliderGrab] = {0.62f, 0.76f, 0.90f, 1.0f};
    style.ScaleAllSizes(ui_scale);
    ImGui::GetStyle() = style;
    ImGui::GetIO().FontGlobalScale = ui_scale;
}

void draw_crosshair() {
    ImDrawList* list = ImGui::GetBackgroundDrawList();
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    const float x = float(int(size.x / 2)), y = float(int(size.y / 2));
    for (int ring = 1; ring >= 0; --ring) { // dark edge first, so that it shows on snow and in caves
        const ImU32 color = ring ? IM_COL32(0, 0, 0, 150) : IM_COL32(245, 245, 245, 230);
        const float r = float(ring);
        list->AddRectFilled({x - 9 - r, y - 1 - r}, {x + 9 + r, y + 1 + r}, color);
        list->AddRectFilled({x - 1 - r, y - 9 - r}, {x + 1 + r, y + 9 + r}, color);
    }
}

void draw_hotbar(const HotbarView& hotbar, float ui_scale) {
    if (hotbar.names.empty()) return;
    ImDrawList* list = ImGui::GetBackgroundDrawList();
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    const float cell = 46 * ui_scale, gap = 4 * ui_scale;
    const float width = float(hotbar.names.size()) * (cell + gap) - gap;
    const float x0 = float(int((size.x - width) / 2)), y0 = size.y - cell - 12 * ui_scale;
    for (std::size_t i = 0; i < hotbar.names.size(); ++i) {
        const float x = x0 + float(i) * (cell + gap);
        const bool chosen = i == hotbar.selected;
        list->AddRectFilled({x, y0}, {x + cell, y0 + cell}, IM_COL32(12, 14, 18, chosen ? 190 : 130), 5 * ui_scale);
        if (i < hotbar.icons.size() && hotbar.icons[i])
            list->AddImage(ImTextureID(std::uintptr_t(hotbar.icons[i])), {x + 3, y0 + 3}, {x + cell - 3, y0 + cell - 3}, {0, 1}, {1, 0}); // OpenGL rows run upwards
        list->AddRect({x, y0}, {x + cell, y0 + cell}, chosen ? IM_COL32(255, 240, 200, 255) : IM_COL32(255, 255, 255, 60),
                      5 * ui_scale, 0, chosen ? 2.5f * ui_scale : 1.0f);
    }
    if (hotbar.name_seconds > 0 && hotbar.selected < hotbar.names.size()) {
        const std::string& name = hotbar.names[hotbar.selected];
        const ImVec2 text = ImGui::CalcTextSize(name.c_str());
        const int alpha = int(255 * std::min(1.0f, hotbar.name_seconds));
        const ImVec2 at{(size.x - text.x) / 2, y0 - text.y - 8 * ui_scale};
        list->AddText({at.x + 1, at.y + 1}, IM_COL32(0, 0, 0, alpha), name.c_str());
        list->AddText(at, IM_COL32(255, 255, 255, alpha), name.c_str());
    }
}

void draw_debug_text(const std::vector<std::string>& lines, bool right) {
    ImDrawList* list = ImGui::GetBackgroundDrawList();
    const float height = ImGui::GetTextLineHeight() + 2;
    float y = 4;
    for (const std::string& line : lines) {
        if (!line.empty()) {
            const float width = ImGui::CalcTextSize(line.c_str()).x;
            const float x = right ? ImGui::GetIO().DisplaySize.x - width - 6 : 6;
            list->AddRectFilled({x - 3, y - 1}, {x + width + 3, y + height - 1}, IM_COL32(0, 0, 0, 120));
            list->AddText({x, y}, IM_COL32(235, 235, 235, 255), line.c_str());
        }
        y += height;
    }
}

void draw_notices(const std::vector<std::string>& lines) {
    ImDrawList* list = ImGui::GetBackgroundDrawList();
    const float height = ImGui::GetTextLineHeight() + 4;
    float y = ImGui::GetIO().DisplaySize.y - 90 - height * float(lines.size());
    for (const std::string& line : lines) {
        const float width = ImGui::CalcTextSize(line.c_str()).x;
        list->AddRectFilled({8, y - 2}, {20 + width, y + height - 2}, IM_COL32(0, 0, 0, 140), 3);
        list->AddText({14, y}, IM_COL32(255, 255, 255, 255), line.c_str());
        y += height;
    }
}

void draw_loading(const std::string& text, float progress) {
    ImDrawList* list = ImGui::GetForegroundDrawList();
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    list->AddRectFilledMultiColor({0, 0}, size, IM_COL32(24, 34, 52, 255), IM_COL32(24, 34, 52, 255), IM_COL32(58, 84, 112, 255),
                                  IM_COL32(58, 84, 112, 255));
    const ImVec2 extent = ImGui::CalcTextSize(text.c_str());
    list->AddText({(size.x - extent.x) / 2, size.y / 2 - 30}, IM_COL32(240, 240, 240, 255), text.c_str());
    const float width = size.x * 0.4f, x = (size.x - width) / 2, y = size.y / 2;
    list->AddRectFilled({x, y}, {x + width, y + 8}, IM_COL32(0, 0, 0, 120), 4);
    list->AddRectFilled({x, y}, {x + width * std::clamp(progress, 0.0f, 1.0f), y + 8}, IM_COL32(160, 205, 235, 255), 4);
}

template <class Values>
static void draw_option(const OptionOf<Values>& option, Values& values) {
    ImGui::PushID(option.key);
    const auto member = option.member(values);
    if (bool* const* b = std::get_if<bool*>(&member)) ImGui::Checkbox(option.label, *b);
    if (float* const* f = std::get_if<float*>(&member)) ImGui::SliderFloat(option.label, *f, option.least, option.most, "%.2f");
    if (i32* const* i = std::get_if<i32*>(&member)) {
        if (option.choices.empty()) ImGui::SliderInt(option.label, *i, int(option.least), int(option.most));
        else ImGui::Combo(option.label, *i, option.choices.data(), int(option.choices.size()));
    }
    if (ImGui::IsItemHovered()) {
        ImGui::BeginTooltip();
        ImGui::PushTextWrapPos(ImGui::GetFontSize() * 24); // wider ones leave small windows
        ImGui::TextUnformatted(option.help);
        ImGui::PopTextWrapPos();
        ImGui::EndTooltip();
    }
    ImGui::PopID();
}

static void draw_trace_options(TraceOptions& options) {
    if (!ImGui::CollapsingHeader("Path tracer")) return;
    for (const TraceOption& option : trace_option_list()) draw_option(option, options);
}

// A preset, and below it every effect with its numbers, from their one description.
static void draw_effects(render::Effects& effects) {
    const auto preset = render::preset_of(effects);
    if (ImGui::BeginCombo("Quality", preset ? render::preset_name(*preset) : "my own")) {
        for (u32 i = 0; i < u32(render::Preset::count); ++i)
            if (ImGui::Selectable(render::preset_name(render::Preset(i)), preset == render::Preset(i)))
                effects = render::preset_effects(render::Preset(i));
        ImGui::EndCombo();
    }
    if (!ImGui::CollapsingHeader("Effects")) return;
    ImGui::BeginChild("effects", {0, ImGui::GetTextLineHeightWithSpacing() * 12});
    std::string group;
    for (const render::EffectOption& option : render::effect_options()) {
        const std::string_view key = option.key;
        const std::string_view own = key.substr(0, key.find('.'));
        if (own != group) ImGui::TextDisabled("%s", std::string(own).c_str());
        group = own;
        draw_option(option, effects);
    }
    ImGui::EndChild();
}

// Packs in use with the one that covers the others on top, then those that lie in the folder. True: use them now.
static bool draw_packs(PackPage& page, float ui_scale) {
    if (!ImGui::CollapsingHeader("Resource packs")) return false;
    if (page.list.empty()) ImGui::TextDisabled("none: zips and folders of packs go to");
    const std::size_t rows = std::min<std::size_t>(page.list.size(), 8);
    if (rows > 0) ImGui::BeginChild("packs", {0, ImGui::GetFrameHeightWithSpacing() * float(rows)});
    // One change a frame: the list is not walked while it changes.
    std::size_t toggled = page.list.size(), moved = page.list.size();
    bool up = false;
    for (std::size_t i = 0; i < page.list.size(); ++i) {
        const PackEntry& pack = page.list[i];
        ImGui::PushID(int(i));
        bool on = pack.on;
        ImGui::BeginDisabled(!on || i == 0);
        if (ImGui::ArrowButton("up", ImGuiDir_Up)) moved = i, up = true;
        ImGui::EndDisabled();
        ImGui::SameLine(0, 3 * ui_scale);
        ImGui::BeginDisabled(!on || i + 1 == page.list.size() || !page.list[i + 1].on);
        if (ImGui::ArrowButton("down", ImGuiDir_Down)) moved = i, up = false;
        ImGui::EndDisabled();
        ImGui::SameLine();
        if (ImGui::Checkbox(pack.missing ? (pack.name + " (not there)").c_str() : pack.name.c_str(), &on)) toggled = i;
        if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", pack.path.c_str());
        ImGui::PopID();
    }
    if (rows > 0) ImGui::EndChild();
    if (toggled < page.list.size()) toggle_pack(page.list, toggled), page.changed = true;
    if (moved < page.list.size()) move_pack(page.list, moved, up), page.changed = true;
    ImGui::PushTextWrapPos();
    ImGui::TextDisabled("%s", page.folder.c_str());
    ImGui::PopTextWrapPos();
    ImGui::BeginDisabled(!page.changed);
    const bool use = ImGui::Button("Use these packs", {-1, 0});
    ImGui::EndDisabled();
    return use;
}

MenuAction draw_pause_menu(Settings& settings, PackPage& packs) {
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    ImGui::GetBackgroundDrawList()->AddRectFilled({0, 0}, size, IM_COL32(0, 0, 0, 110));
    ImGui::SetNextWindowPos({size.x / 2, size.y / 2}, ImGuiCond_Always, {0.5f, 0.5f});
    ImGui::SetNextWindowSize({std::min(size.x * 0.9f, 420 * settings.ui_scale), 0});
    ImGui::Begin("Paused", nullptr,
                 ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoSavedSettings);
    MenuAction action = MenuAction::none;
    Settings next = settings;
    if (ImGui::Button("Back to the world", {-1, 0})) action = MenuAction::resume;
    ImGui::Separator();
    ImGui::SliderInt("View distance", &next.view_distance, 2, 32, "%d chunks");
    ImGui::SliderFloat("Field of view", &next.fov_deg, 40, 110, "%.0f deg");
    ImGui::SliderFloat("Mouse", &next.mouse_sensitivity, 0.1f, 4, "%.2f");
    ImGui::SliderFloat("Brightness", &next.gamma, 0.5f, 2, "%.2f");
    ImGui::SliderFloat("Interface size", &next.ui_scale, 0.5f, 3, "%.2f");
    ImGui::SliderInt("Frame limit", &next.frame_limit, 0, 240, next.frame_limit ? "%d" : "none");
    ImGui::Checkbox("Full screen", &next.fullscreen);
    ImGui::SameLine();
    ImGui::Checkbox("Wait for the screen", &next.vsync);
    ImGui::Checkbox("Invert mouse", &next.invert_y);
    draw_effects(next.effects);
    draw_trace_options(next.trace);
    if (draw_packs(packs, settings.ui_scale)) action = MenuAction::packs_changed;
    ImGui::Separator();
    if (ImGui::Button("Save and quit", {-1, 0})) action = MenuAction::quit;
    ImGui::End();
    if (!(next == settings)) {
        settings = next;
        if (action == MenuAction::none) action = MenuAction::settings_changed;
    }
    return action;
}

void draw_keys(const Bindings& controls, std::optional<Action>& waiting, bool& usual_wanted) {
    ImGui::Begin("Paused"); // goes on with it
    if (ImGui::CollapsingHeader("Keys")) {
        ImGui::BeginChild("keys", {0, ImGui::GetTextLineHeightWithSpacing() * 8});
        for (const ActionInfo& info : actions()) {
            const bool this_one = waiting == info.action;
            const std::string_view key = platform::key_name(controls.of(info.action));
            const std::string label = fmt::format("{}##{}", this_one ? std::string_view("press a key") : key.empty() ? std::string_view("-") : key, info.key);
            if (ImGui::Button(label.c_str(), {ImGui::GetContentRegionAvail().x * 0.35f, 0}))
                waiting = this_one ? std::nullopt : std::optional(info.action);
            ImGui::SameLine();
            ImGui::TextUnformatted(info.name.data(), info.name.data() + info.name.size());
        }
        usual_wanted = ImGui::Button("The usual keys");
        ImGui::EndChild();
    }
    ImGui::End();
}

int draw_block_list(const std::vector<std::string>& names, std::string& filter, bool& open) {
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({size.x / 2, size.y / 2}, ImGuiCond_Appearing, {0.5f, 0.5f});
    ImGui::SetNextWindowSize({size.x * 0.5f, size.y * 0.7f}, ImGuiCond_Appearing);
    int chosen = -1;
    if (ImGui::Begin("Blocks", &open, ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoSavedSettings)) {
        if (ImGui::IsWindowAppearing()) ImGui::SetKeyboardFocusHere();
        ImGui::InputTextWithHint("##filter", "part of a name", &filter);
        ImGui::BeginChild("list");
        for (std::size_t i = 0; i < names.size(); ++i) {
            if (!filter.empty() && names[i].find(filter) == std::string::npos) continue;
            if (ImGui::Selectable(names[i].c_str())) chosen = int(i);
        }
        ImGui::EndChild();
    }
    ImGui::End();
    return chosen;
}

} // namespace vitrail::client
