// The table of effects: what settings files, menus and the command line rely on.
#include "render/effects.h"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <set>

namespace vitrail::render {

static bool is_number(const EffectOption& option, Effects& effects) {
    return option.choices.empty() && !std::holds_alternative<bool*>(option.member(effects));
}

TEST(Effects, EveryOptionIsDescribedOnce) {
    std::set<std::string> keys;
    std::set<const void*> members;
    Effects effects;
    for (const EffectOption& option : effect_options()) {
        EXPECT_TRUE(keys.insert(option.key).second) << option.key;
        EXPECT_EQ(find_effect(option.key), &option);
        std::visit([&](auto* member) { EXPECT_TRUE(members.insert(member).second) << option.key; },
                   option.member(effects));
        EXPECT_GT(std::string(option.label).size(), 0u);
        EXPECT_EQ(std::string(option.help).back(), '.') << option.key;
        EXPECT_LE(option.least, option.most) << option.key;
        if (!option.choices.empty()) {
            EXPECT_EQ(option.least, 0);
            EXPECT_EQ(u32(option.most) + 1, option.choices.size()) << option.key;
        }
        for (float value : option.presets) {
            EXPECT_GE(value, option.least) << option.key;
            EXPECT_LE(value, option.most) << option.key;
        }
    }
    EXPECT_EQ(find_effect("nonsense"), nullptr);
    EXPECT_EQ(find_effect(""), nullptr);
}

TEST(Effects, TextSurvivesARoundTrip) {
    for (u32 i = 0; i < u32(Preset::count); ++i) {
        const Effects from = preset_effects(Preset(i));
        Effects to = preset_effects(Preset((i + 2) % u32(Preset::count)));
        for (const EffectOption& option : effect_options()) {
            const std::string text = option_text(option, from);
            const Result<> set = set_effect(to, option.key, text);
            ASSERT_TRUE(set) << option.key << " " << set.error().message;
            EXPECT_EQ(option_text(option, to), text);
        }
        EXPECT_TRUE(to == from) << preset_name(Preset(i));
    }
    // Numbers keep every bit; every choice has its name.
    Effects effects;
    ASSERT_TRUE(set_effect(effects, "bloom.strength", "0.123456789"));
    EXPECT_EQ(effects.bloom.strength, 0.123456789f);
    Effects copy;
    ASSERT_TRUE(set_effect(copy, "bloom.strength", option_text(*find_effect("bloom.strength"), effects)));
    EXPECT_EQ(copy.bloom.strength, effects.bloom.strength);
    for (const EffectOption& option : effect_options())
        for (const char* choice : option.choices) {
            ASSERT_TRUE(set_effect(effects, option.key, choice));
            EXPECT_EQ(option_text(option, effects), choice);
        }
}

TEST(Effects, WhatDoesNotFitIsRefusedAndChangesNothing) {
    for (const EffectOption& option : effect_options()) {
        Effects effects = preset_effects(Preset::medium);
        const Effects before = effects;
        std::vector<std::string> wrong{"", " ", "maybe", "1.5.2", "nan", "1e999", "true false", "--1"};
        if (is_number(option, effects)) {
            wrong.push_back(std::to_string(i64(std::floor(option.least)) - 1));
            wrong.push_back(std::to_string(i64(std::ceil(option.most)) + 1));
            wrong.push_back("true");
            ASSERT_TRUE(set_effect(effects, option.key, std::to_string(i64(option.most))) ||
                        option.most != std::floor(option.most));
            effects = before;
        }
        for (const std::string& value : wrong) {
            const Result<> set = set_effect(effects, option.key, value);
            ASSERT_FALSE(set) << option.key << " = " << value;
            EXPECT_EQ(set.error().code, ErrorCode::invalid_argument);
            EXPECT_NE(set.error().message.find(option.key), std::string::npos);
        }
        EXPECT_TRUE(effects == before) << option.key;
    }
    Effects effects;
    EXPECT_FALSE(set_effect(effects, "shadows.sizes", "1024"));
    EXPECT_FALSE(set_effect(effects, "shadows.size", "1024.5")); // whole numbers only
}

TEST(Effects, PresetsAreValidNamedAndKnownAgain) {
    for (u32 i = 0; i < u32(Preset::count); ++i) {
        const Effects effects = preset_effects(Preset(i));
        EXPECT_TRUE(sane(effects) == effects) << preset_name(Preset(i));
        EXPECT_EQ(preset_of(effects), Preset(i));
        EXPECT_EQ(preset_from(preset_name(Preset(i))), Preset(i));
    }
    Effects own = preset_effects(Preset::high);
    own.exposure.bias = 0.5f;
    EXPECT_FALSE(preset_of(own));
    EXPECT_FALSE(preset_from("best"));
    EXPECT_EQ(settling_frames(preset_effects(Preset::low)), 1u);
    EXPECT_GE(settling_frames(preset_effects(Preset::ultra)), 16u);
}

TEST(Effects, SaneHoldsEveryNumber) {
    const float odd[] = {-1e30f, -1, 0, 1e30f, std::nanf(""), std::numeric_limits<float>::infinity()};
    for (const EffectOption& option : effect_options())
        for (float value : odd) {
            Effects effects = preset_effects(Preset::ultra);
            const OptionMember member = option.member(effects);
            if (i32* const* i = std::get_if<i32*>(&member))
                **i = value > 0 ? std::numeric_limits<i32>::max() : std::numeric_limits<i32>::min();
            if (float* const* f = std::get_if<float*>(&member)) **f = value;
            Effects held = sane(effects);
            const OptionMember after = option.member(held);
            if (i32* const* i = std::get_if<i32*>(&after)) {
                EXPECT_GE(float(**i), option.least) << option.key;
                EXPECT_LE(float(**i), option.most) << option.key;
            }
            if (float* const* f = std::get_if<float*>(&after)) {
                EXPECT_TRUE(**f >= option.least && **f <= option.most) << option.key << " " << **f;
            }
            EXPECT_TRUE(sane(held) == held);
        }
    Effects effects = preset_effects(Preset::ultra);
    effects.shadows.on = false; // shafts are what shadow maps cut out of the mist
    EXPECT_FALSE(sane(effects).fog.volumetric);
}

} // namespace vitrail::render
