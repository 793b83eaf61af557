// Small PNGs in memory, for packs that tests make.
#pragma once

#include "base/bytes.h"
#include "formats/image.h"

#include <algorithm>
#include <array>
#include <functional>
#include <zlib.h>

namespace vitrail::test {

inline Bytes png_of(const Image& rgba) {
    ByteWriter raw;
    for (u32 y = 0; y < rgba.height; ++y) {
        raw.put_u8(0); // no filter
        raw.put_raw(rgba.at(0, y), std::size_t(rgba.width) * 4);
    }
    uLongf packed_size = compressBound(uLong(raw.bytes().size()));
    Bytes packed(packed_size);
    compress(packed.data(), &packed_size, raw.bytes().data(), uLong(raw.bytes().size()));
    packed.resize(packed_size);
    ByteWriter out;
    const auto big = [](ByteWriter& w, u32 v) {
        for (const u32 shift : {24u, 16u, 8u, 0u})
            w.put_u8(u8(v >> shift));
    };
    const auto chunk = [&](const char* kind, const Bytes& data) {
        ByteWriter body;
        body.put_raw(kind, 4);
        body.put_bytes(data);
        big(out, u32(data.size()));
        out.put_bytes(body.bytes());
        big(out, u32(crc32(0, body.bytes().data(), uInt(body.bytes().size()))));
    };
    out.put_raw("\x89PNG\r\n\x1a\n", 8);
    ByteWriter head;
    big(head, rgba.width), big(head, rgba.height);
    for (const u8 v : {8, 6, 0, 0, 0})
        head.put_u8(v);
    chunk("IHDR", head.bytes());
    chunk("IDAT", packed);
    chunk("IEND", {});
    return out.bytes();
}

inline Image picture(u32 width, u32 height, const std::function<std::array<u8, 4>(u32 x, u32 y)>& texel) {
    Image image{width, height, 4, Bytes(std::size_t(width) * height * 4)};
    for (u32 y = 0; y < height; ++y)
        for (u32 x = 0; x < width; ++x) {
            const auto t = texel(x, y);
            std::copy(t.begin(), t.end(), image.at(x, y));
        }
    return image;
}

inline Bytes plain_png(u32 side, std::array<u8, 4> color) {
    return png_of(picture(side, side, [&](u32, u32) { return color; }));
}

} // namespace vitrail::test
