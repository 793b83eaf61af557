#include "client/controls.h"

#include "client/settings.h"
#include "platform/key_names.h"

#include <fstream>
#include <gtest/gtest.h>
#include <set>
#include <unistd.h>

namespace vitrail::client {

using platform::Key;

TEST(Controls, EveryActionHasAKeyAndANameOfItsOwn) {
    std::set<std::string_view> names, texts;
    std::set<Key> keys;
    ASSERT_EQ(actions().size(), std::size_t(Action::count));
    for (std::size_t i = 0; i < actions().size(); ++i) {
        const ActionInfo& info = actions()[i];
        EXPECT_EQ(std::size_t(info.action), i);
        EXPECT_TRUE(names.insert(info.key).second) << info.key;
        EXPECT_TRUE(texts.insert(info.name).second) << info.name;
        EXPECT_TRUE(keys.insert(info.usual).second) << info.key << " shares its key";
        EXPECT_FALSE(platform::key_name(info.usual).empty()) << info.key;
    }
}

TEST(Controls, KeysAreFoundByTheirNames) {
    for (u16 k = 0; k < 300; ++k) {
        const std::string_view name = platform::key_name(Key(k));
        if (!name.empty()) EXPECT_EQ(platform::key_from(name), Key(k)) << name;
    }
    EXPECT_FALSE(platform::key_from("no such key"));
    EXPECT_FALSE(platform::key_from(""));
}

TEST(Controls, AKeyServesOneAction) {
    Bindings b;
    EXPECT_EQ(b.action_of(Key::w), Action::forward);
    EXPECT_TRUE(b.bind(Action::zoom, Key::w));
    EXPECT_EQ(b.action_of(Key::w), Action::zoom);
    EXPECT_EQ(b.of(Action::forward), Key::none);
    EXPECT_FALSE(b.action_of(Key::c));
    EXPECT_FALSE(b.action_of(Key::none)) << "no key is no action's";
    EXPECT_FALSE(b.bind(Action::zoom, Key::escape));
    EXPECT_FALSE(b.bind(Action::zoom, Key::n3));
    EXPECT_EQ(b.of(Action::zoom), Key::w);
    EXPECT_TRUE(b.bind(Action::zoom, Key::none));
    EXPECT_FALSE(b.action_of(Key::w));
}

TEST(Controls, AreKeptWithTheSettings) {
    const std::filesystem::path file = std::filesystem::temp_directory_path() / ("vitrail-keys-" + std::to_string(::getpid()) + ".toml");
    Settings settings;
    settings.effects.bloom.on = !settings.effects.bloom.on; // a table of its own before it
    ASSERT_TRUE(settings.controls.bind(Action::zoom, Key::x));
    ASSERT_TRUE(settings.controls.bind(Action::fly, Key::none));
    ASSERT_TRUE(save_settings(file, settings));
    const auto back = load_settings(file);
    ASSERT_TRUE(back);
    EXPECT_TRUE(*back == settings);
    std::ofstream(file) << "[keys]\nzoom = \"banana\"\nforward = 3\nback = \"up\"\nsomething = \"a\"\n";
    const auto odd = load_settings(file);
    ASSERT_TRUE(odd);
    EXPECT_EQ(odd->controls.of(Action::zoom), Key::c);
    EXPECT_EQ(odd->controls.of(Action::forward), Key::w);
    EXPECT_EQ(odd->controls.of(Action::back), Key::up);
    EXPECT_EQ(odd->controls.of(Action::look_up), Key::none);
    std::filesystem::remove(file);
}

} // namespace vitrail::client
