// Random text as content: never a crash, and whatever loads is a registry whose every block resolves, and terrain that
// compiles or says why not.
#include "script/content_loader.h"
#include "terrain/compile/compile.h"
#include "world/state_table.h"

#include <cstdlib>

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
    using namespace vitrail;
    const ContentFile file{"fuzz.lua", std::string(reinterpret_cast<const char*>(data), size)};
    const auto content = load_content_texts({&file, 1}, 300'000);
    if (!content) {
        if (content.error().message.empty()) std::abort();
        return 0;
    }
    const auto& registry = content->registry;
    StateTable table(registry);
    for (const BlockDef& def : registry->blocks()) {
        BlockState state{def.name, {}};
        for (const PropertyDef& p : def.properties)
            state.set(p.name, p.values.back());
        const auto id = table.intern(state);
        if (!id || table.info(*id).look == nullptr) std::abort();
        if (table.info(*id).look->opacity > 15) std::abort();
    }
    if (content->terrain) {
        const auto terrain = compile_terrain(*content->terrain, size);
        if (!terrain && terrain.error().message.empty()) std::abort();
    }
    return 0;
}
