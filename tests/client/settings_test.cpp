#include "client/settings.h"

#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>

using namespace vitrail::client;
namespace fs = std::filesystem;

static fs::path scratch(const char* name) {
    const fs::path folder = fs::temp_directory_path() / ("vitrail_settings_" + std::string(name));
    fs::remove_all(folder);
    return folder / "settings.toml";
}

TEST(Settings, SurviveARoundTrip) {
    const fs::path path = scratch("round");
    Settings s;
    s.view_distance = 7;
    s.fov_deg = 91.5f;
    s.mouse_sensitivity = 2; // a whole number must stay a float
    s.invert_y = true;
    s.fullscreen = true;
    s.packs = {"/a b/\"quoted\".zip", "C:\\back\\slash", "it's, ü"};
    s.effects = vitrail::render::preset_effects(vitrail::render::Preset::low);
    s.effects.exposure.automatic = !s.effects.exposure.automatic; // a table after the list
    ASSERT_TRUE(save_settings(path, s));
    const auto back = load_settings(path);
    ASSERT_TRUE(back);
    EXPECT_TRUE(*back == s);
}

TEST(Settings, KeepEffects) {
    namespace render = vitrail::render;
    const fs::path path = scratch("effects");
    for (vitrail::u32 i = 0; i < vitrail::u32(render::Preset::count); ++i) {
        Settings s;
        s.effects = render::preset_effects(render::Preset(i));
        ASSERT_TRUE(save_settings(path, s));
        EXPECT_TRUE(load_settings(path)->effects == s.effects) << i;
        // What a player changed is kept beside the preset, one of each kind.
        ASSERT_TRUE(render::set_effect(s.effects, "exposure.bias", "-1.25"));
        ASSERT_TRUE(render::set_effect(s.effects, "shadows.size", "512"));
        ASSERT_TRUE(render::set_effect(s.effects, "water.waves", "false"));
        ASSERT_TRUE(render::set_effect(s.effects, "antialias", "fxaa"));
        s.effects = render::sane(s.effects);
        ASSERT_TRUE(save_settings(path, s));
        const auto back = load_settings(path);
        ASSERT_TRUE(back);
        EXPECT_TRUE(back->effects == s.effects) << i;
    }
    // Unknown effects and values that do not fit leave the preset's.
    std::ofstream(path) << "quality = \"medium\"\n[effects]\n\"shadows.size\" = 99999999\nnonsense = 3\n\"bloom.on\" = \"perhaps\"\n";
    const auto odd = load_settings(path);
    ASSERT_TRUE(odd);
    EXPECT_TRUE(odd->effects == render::preset_effects(render::Preset::medium));
}

TEST(Settings, KeepTheTracersOptions) {
    const fs::path path = scratch("trace");
    Settings s;
    s.trace.hold = 24, s.trace.scale = 0.75f, s.trace.denoise = false;
    s.effects.bloom.strength = 0.1f; // a table before it
    ASSERT_TRUE(s.controls.bind(Action::renderer, vitrail::platform::Key::f6)); // and one after
    ASSERT_TRUE(save_settings(path, s));
    const auto back = load_settings(path);
    ASSERT_TRUE(back);
    EXPECT_TRUE(*back == s);
    std::ofstream(path) << "[trace]\nbounces = 99\nsamples = \"x\"\nhalf = true\nnonsense = 1\n";
    const auto odd = load_settings(path);
    ASSERT_TRUE(odd);
    TraceOptions wanted;
    wanted.half = true;
    EXPECT_TRUE(odd->trace == wanted);
}

TEST(Settings, NoFileMeansDefaults) { EXPECT_TRUE(*load_settings(scratch("none")) == Settings{}); }

TEST(Settings, OddValuesAreHeldInRangeAndOddKeysLeftAlone) {
    const fs::path path = scratch("odd");
    fs::create_directories(path.parent_path());
    std::ofstream(path) << "view_distance = 9000\nfov_deg = nan\nmouse_sensitivity = \"fast\"\nunknown = [1]\n";
    const auto s = load_settings(path);
    ASSERT_TRUE(s);
    EXPECT_EQ(s->view_distance, 32);
    EXPECT_EQ(s->fov_deg, Settings{}.fov_deg);
    EXPECT_EQ(s->mouse_sensitivity, 1);
}

TEST(Settings, ABrokenFileIsNamed) {
    const fs::path path = scratch("broken");
    fs::create_directories(path.parent_path());
    std::ofstream(path) << "view_distance = = 3\n";
    const auto s = load_settings(path);
    ASSERT_FALSE(s);
    EXPECT_NE(s.error().message.find("settings.toml:1"), std::string::npos);
}

TEST(Settings, AnUnwritablePlaceIsAnError) { EXPECT_FALSE(save_settings("/proc/vitrail/settings.toml", Settings{})); }
