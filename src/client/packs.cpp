#include "client/packs.h"

#include "base/log.h"

#include <fmt/format.h>

namespace vitrail::client {

static void tell(const PackReport& report) {
    for (const std::string& line : report.lines)
        log_warning(line);
    if (report.problems > report.lines.size())
        log_warning(fmt::format("and {} more problems in resource packs", report.problems - report.lines.size()));
}

Result<std::shared_ptr<const scene::PackLooks>> open_packs(const std::vector<std::string>& paths,
                                                           const BlockRegistry& registry) {
    if (paths.empty()) return std::shared_ptr<const scene::PackLooks>();
    PackReport report;
    PackStack stack;
    for (const std::string& path : paths) {
        VX_TRY_ASSIGN(auto pack, ResourcePack::open(path, report));
        stack.add(std::move(pack));
    }
    auto looks = scene::PackLooks::load(stack, registry);
    tell(report);
    tell(looks->report());
    const auto& c = looks->counts();
    log_info(fmt::format("{} resource pack{}: {} textures of {} replaced, {} more; {} blocks by {} models", c.packs,
                         c.packs == 1 ? "" : "s", c.replaced_textures, registry.textures().size(), c.own_textures,
                         c.blockstates, c.models));
    return looks;
}

} // namespace vitrail::client
