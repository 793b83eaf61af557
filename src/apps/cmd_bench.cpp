#include "apps/bench_list.h"
#include "apps/commands.h"

#include <algorithm>
#include <fmt/format.h>

namespace vitrail::apps {

Result<> run_bench(const BenchOptions& options) {
    bench::Suite suite;
    register_all_benches(suite);
    const auto names = suite.names();
    if (options.list) {
        for (const auto& name : names) fmt::print("{}\n", name);
        return {};
    }
    for (const auto& wanted : options.names)
        if (std::none_of(names.begin(), names.end(), [&](const std::string& n) { return n.starts_with(wanted); }))
            return fail(ErrorCode::invalid_argument, fmt::format("no benchmark begins with '{}' (see bench --list)", wanted));
    if (!options.json_file.empty()) VX_TRY(check_writable(options.json_file));
    const auto samples = suite.run(options.names, {{"world", options.world}, {"at", options.at}, {"look", options.look}, {"shaders", options.shader_folder}});
    if (!options.json_file.empty() && !bench::write_json(options.json_file, samples))
        return fail(ErrorCode::io, fmt::format("cannot write {}", options.json_file));
    return {};
}

} // namespace vitrail::apps
