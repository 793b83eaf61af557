#include "render/image.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fmt/format.h>
#include <png.h>
#include <unistd.h>

namespace vitrail::render {

Result<> write_png(const std::string& path, const Image& image) {
    png_image png{};
    png.version = PNG_IMAGE_VERSION;
    png.width = image.width, png.height = image.height;
    png.format = image.channels == 4 ? PNG_FORMAT_RGBA : PNG_FORMAT_RGB;
    const std::string unfinished = path + ".part";
    std::FILE* file = std::fopen(unfinished.c_str(), "wb");
    if (!file) return fail(ErrorCode::io, fmt::format("{}: {}", path, std::strerror(errno)));
    bool ok = png_image_write_to_stdio(&png, file, 0, image.pixels.data(), 0, nullptr) != 0;
    ok &= std::fflush(file) == 0;
    const int error = errno;
    ok &= std::fclose(file) == 0;
    if (ok && std::rename(unfinished.c_str(), path.c_str()) == 0) return {};
    const int reason = ok ? errno : error;
    std::remove(unfinished.c_str());
    return fail(ErrorCode::io, fmt::format("{}: cannot be written: {}", path, std::strerror(reason)));
}

} // namespace vitrail::render
