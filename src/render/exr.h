// Pictures of many layers as OpenEXR files: linear light and what lies behind it, for compositing.
#pragma once

#include "base/result.h"
#include "base/types.h"

#include <map>
#include <string>
#include <vector>

namespace vitrail::render {

// One layer: `names` are its channels ("R" or "albedo.R"), values theirs in turn for each pixel, rows from the top.
struct ExrLayer {
    std::vector<std::string> names;
    std::vector<float> values; // width * height * names.size()
    bool half = true;          // 16-bit floats (beyond 65504: held there); else 32-bit
};

struct ExrPicture {
    u32 width = 0, height = 0;
    std::vector<ExrLayer> layers;
    std::map<std::string, std::string> texts; // attributes
    std::map<std::string, float> numbers;
    std::map<std::string, i32> counts;
};

// Scan lines, ZIP. Written beside and renamed. Errors: io; invalid_argument (a layer of another size).
Result<> write_exr(const std::string& path, const ExrPicture& picture);
// What write_exr wrote, each channel a layer of its own, as 32-bit floats. Errors: io, damaged.
Result<ExrPicture> read_exr(const std::string& path);

} // namespace vitrail::render
