#include "formats/image.h"

#include <cerrno>
#include <cstring>
#include <fmt/format.h>
#include <fstream>
#include <memory>
#include <png.h>

namespace vitrail {

Result<Image> decode_png(ByteView bytes) {
    png_image png{};
    png.version = PNG_IMAGE_VERSION;
    if (!png_image_begin_read_from_memory(&png, bytes.data(), bytes.size()))
        return fail(ErrorCode::damaged, fmt::format("no PNG: {}", png.message));
    // Freed on every path; a no-op once reading has ended.
    const std::unique_ptr<png_image, void (*)(png_image*)> guard(&png, png_image_free);
    if (png.width == 0 || png.height == 0 || png.width > 4096 || png.height > 65536 ||
        u64(png.width) * png.height > 16u << 20)
        return fail(ErrorCode::limit, fmt::format("a picture of {}x{} is too large", png.width, png.height));
    png.format = PNG_FORMAT_RGBA;
    Image image;
    image.width = png.width, image.height = png.height, image.channels = 4;
    image.pixels.resize(std::size_t(png.width) * png.height * 4);
    if (!png_image_finish_read(&png, nullptr, image.pixels.data(), 0, nullptr))
        return fail(ErrorCode::damaged, fmt::format("damaged PNG: {}", png.message));
    return image;
}

Result<Image> read_png(const std::string& path) {
    std::ifstream file(path, std::ios::binary | std::ios::ate);
    if (!file) return fail(ErrorCode::not_found, fmt::format("{}: {}", path, std::strerror(errno)));
    const std::streamoff size = file.tellg();
    if (size < 0 || size > (64 << 20)) return fail(ErrorCode::limit, path + ": too large for a picture");
    Bytes bytes(std::size_t(size), u8(0));
    file.seekg(0);
    file.read(reinterpret_cast<char*>(bytes.data()), size);
    if (!file) return fail(ErrorCode::io, path + ": cannot be read");
    Result<Image> image = decode_png(bytes);
    if (!image) return fail(image.error().code, path + ": " + image.error().message);
    return image;
}

} // namespace vitrail
