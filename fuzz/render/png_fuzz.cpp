// Pictures come from content packs, and those from anyone.
#include "render/image.h"

#include <cstddef>
#include <cstdint>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const auto image = vitrail::render::decode_png({data, size});
    if (image && image->pixels.size() != std::size_t(image->width) * image->height * 4) __builtin_trap();
    return 0;
}
