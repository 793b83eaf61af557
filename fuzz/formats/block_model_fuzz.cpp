// Blockstates and models of packs as JSON. The text serves as both, and as its own parent.
#include "formats/block_model_json.h"

#include <cmath>
#include <cstdlib>

using namespace vitrail;

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
    (void)parse_blockstates({data, size});
    const auto model = parse_block_model({data, size});
    if (!model) return 0;
    ModelLibrary models([&](const std::string& name) -> std::optional<Bytes> {
        if (name != "minecraft:top" && name != model->parent) return std::nullopt;
        return Bytes(data, data + size);
    });
    const auto resolved = models.resolve("minecraft:top");
    if (!resolved) return 0;
    for (const ModelElementJson& element : (*resolved)->elements)
        for (u32 axis = 0; axis < 3; ++axis) {
            if (!(element.from[axis] >= -16 && element.to[axis] <= 32)) std::abort();
            if (element.rotation && !std::isfinite(element.rotation->degrees)) std::abort();
        }
    return 0;
}
