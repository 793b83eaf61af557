// --quality, --effect and --shaders of the commands that draw.
#pragma once

#include "base/result.h"
#include "render/effects.h"

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

namespace vitrail::apps {

struct EffectArguments {
    std::string quality;              // a preset's name; empty: not said
    std::vector<std::string> changes; // KEY=VALUE, over the preset
    std::string shader_folder;
};

void add_effect_arguments(CLI::App& command, EffectArguments& arguments);
// The preset (`otherwise` where none was said) with the changes. Errors: invalid_argument.
Result<render::Effects> effects_of(const EffectArguments& arguments, const render::Effects& otherwise);

} // namespace vitrail::apps
