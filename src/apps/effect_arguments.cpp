#include "apps/effect_arguments.h"

#include "apps/commands.h"

#include <filesystem>
#include <fmt/format.h>

namespace vitrail::apps {

void add_effect_arguments(CLI::App& command, EffectArguments& arguments) {
    command.add_option("--quality", arguments.quality, "off, low, medium, high or ultra");
    command.add_option("--effect", arguments.changes, "KEY=VALUE, such as shadows.distance=96; may be repeated")
        ->take_all()
        ->expected(1);
    command.add_option("--shaders", arguments.shader_folder,
                       "read the shaders from this folder (src/render/passes) and again when they change");
}

Result<render::Effects> effects_of(const EffectArguments& arguments, const render::Effects& otherwise) {
    render::Effects effects = otherwise;
    if (!arguments.quality.empty()) {
        const auto preset = render::preset_from(arguments.quality);
        if (!preset)
            return fail(ErrorCode::invalid_argument,
                        fmt::format("--quality is off, low, medium, high or ultra, not '{}'", arguments.quality));
        effects = render::preset_effects(*preset);
    }
    for (const std::string& change : arguments.changes) {
        VX_TRY_ASSIGN(const auto set, parse_change("--effect", change));
        VX_TRY(render::set_effect(effects, set.first, set.second));
    }
    std::error_code ignored;
    if (!arguments.shader_folder.empty() && !std::filesystem::is_directory(arguments.shader_folder, ignored))
        return fail(ErrorCode::not_found, fmt::format("--shaders: {} is no folder", arguments.shader_folder));
    return effects;
}

} // namespace vitrail::apps
