// A zip from anyone, opened as a resource pack: every file is read within a bound, JSON parsed, models resolved with
// parents.
#include "formats/block_model_json.h"
#include "formats/resource_pack.h"

#include <cstdlib>

using namespace vitrail;

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
    PackReport report;
    const auto pack = ResourcePack::from_zip(Bytes(data, data + size), "fuzz", report);
    if (!pack) return 0;
    PackStack stack;
    stack.add(*pack);
    constexpr std::size_t kMost = 1u << 18;
    ModelLibrary models([&](const std::string& name) -> std::optional<Bytes> {
        const auto parsed = parse_resource_name(name);
        if (!parsed) std::abort(); // only sound names are asked for
        return stack.read(parsed->file("models", ".json"), kMost, report);
    });
    for (const std::string& path : (*pack)->list("", "")) {
        if (path.find("..") != std::string::npos && !parse_resource_name(path)) std::abort();
        const auto bytes = (*pack)->read(path, kMost);
        if (!bytes) continue;
        if (bytes->size() > kMost) std::abort();
        if (const auto states = parse_blockstates(*bytes))
            for (const auto& one : states->cases)
                for (const auto& variant : one.apply) {
                    if (variant.weight == 0 || variant.x % 90 || variant.y >= 360) std::abort();
                    (void)models.resolve(variant.model);
                }
        (void)parse_block_model(*bytes);
    }
    return 0;
}
