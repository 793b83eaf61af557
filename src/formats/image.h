// 8-bit images in memory, and PNG bytes into them. Pictures come from content and resource packs, and those from
// anyone.
#pragma once

#include "base/bytes.h"
#include "base/result.h"

#include <string>
#include <vector>

namespace vitrail {

// Rows from the top, `channels` bytes a pixel (3 RGB or 4 RGBA), sRGB.
struct Image {
    u32 width = 0, height = 0, channels = 3;
    std::vector<u8> pixels;
    const u8* at(u32 x, u32 y) const { return pixels.data() + (std::size_t(y) * width + x) * channels; }
    u8* at(u32 x, u32 y) { return pixels.data() + (std::size_t(y) * width + x) * channels; }
};

// Any PNG as RGBA, at most 4096 x 65536 and 2^24 pixels; nothing is allocated before the size is checked. Errors:
// damaged, limit.
Result<Image> decode_png(ByteView bytes);

// Errors: not_found, io, damaged, limit; the message names the file.
Result<Image> read_png(const std::string& path);

} // namespace vitrail
