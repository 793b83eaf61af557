// 8-bit images in memory and as PNG files.
#pragma once

#include "base/bytes.h"
#include "base/result.h"

#include <string>
#include <vector>

namespace vitrail::render {

// Rows from the top, `channels` bytes a pixel (3 RGB or 4 RGBA), sRGB.
struct Image {
    u32 width = 0, height = 0, channels = 3;
    std::vector<u8> pixels;
    const u8* at(u32 x, u32 y) const { return pixels.data() + (std::size_t(y) * width + x) * channels; }
    u8* at(u32 x, u32 y) { return pixels.data() + (std::size_t(y) * width + x) * channels; }
};

// Any PNG as RGBA, at most 4096 x 65536 pixels. Errors: damaged, limit.
Result<Image> decode_png(ByteView bytes);
// Errors: not_found, io, damaged, limit; the message names the file.
Result<Image> read_png(const std::string& path);
// Written beside and renamed, so that no half-written file is ever seen. Errors: io.
Result<> write_png(const std::string& path, const Image& image);

} // namespace vitrail::render
