// 8-bit images in memory and as PNG files.
#pragma once

#include "base/result.h"
#include "formats/image.h"

#include <string>

namespace vitrail::render {

using vitrail::decode_png;
using vitrail::Image;
using vitrail::read_png;

// Written beside and renamed, so that no half-written file is ever seen. Errors: io.
Result<> write_png(const std::string& path, const Image& image);

} // namespace vitrail::render
