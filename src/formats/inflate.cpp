#include "formats/inflate.h"

#include <algorithm>
#include <cstring>
#include <libdeflate.h>
#include <lz4.h>
#include <xxhash.h>
#include <zlib.h>

namespace vitrail {

struct Inflater::Codec {
    libdeflate_decompressor* fast = libdeflate_alloc_decompressor();
    ~Codec() { libdeflate_free_decompressor(fast); }
};

Inflater::Inflater()
    : codec_(std::make_unique<Codec>()) {}
Inflater::~Inflater() = default;

// Keeps what the buffer holds; false beyond the bound.
bool Inflater::grow(std::size_t least) {
    if (least <= capacity_) return true;
    if (least > kMaxInflatedBytes) return false;
    std::size_t size = std::max<std::size_t>(capacity_ * 2, 256 * 1024);
    while (size < least)
        size *= 2;
    size = std::min(size, kMaxInflatedBytes);
    std::unique_ptr<u8[]> bigger(new u8[size]); // not zeroed: first touch is slow
    if (capacity_ > 0) std::memcpy(bigger.get(), buffer_.get(), capacity_);
    buffer_ = std::move(bigger);
    capacity_ = size;
    return true;
}

Inflated Inflater::unpack(Compression method, ByteView packed) {
    switch (method) {
    case Compression::gzip:
    case Compression::zlib:
        return deflated(method, packed);
    case Compression::none:
        if (packed.size() > kMaxInflatedBytes) return {{}, Error{ErrorCode::limit, "uncompressed data is too long"}};
        return {packed, {}};
    case Compression::lz4:
        return lz4_blocks(packed);
    }
    return {{}, Error{ErrorCode::unsupported, "unknown compression " + std::to_string(int(method))}};
}

Inflated Inflater::deflated(Compression method, ByteView packed) {
    grow(1);
    for (;;) {
        std::size_t used = 0, size = 0;
        const libdeflate_result result = method == Compression::gzip
                                             ? libdeflate_gzip_decompress_ex(codec_->fast, packed.data(), packed.size(),
                                                                             buffer_.get(), capacity_, &used, &size)
                                             : libdeflate_zlib_decompress_ex(codec_->fast, packed.data(), packed.size(),
                                                                             buffer_.get(), capacity_, &used, &size);
        if (result == LIBDEFLATE_SUCCESS) return {ByteView(buffer_.get(), size), {}};
        if (result == LIBDEFLATE_INSUFFICIENT_SPACE && capacity_ < kMaxInflatedBytes) {
            grow(capacity_ * 2);
            continue;
        }
        break;
    }
    // libdeflate says nothing of what it unpacked before the break; zlib does.
    return deflated_as_far_as_it_goes(packed);
}

Inflated Inflater::deflated_as_far_as_it_goes(ByteView packed) {
    z_stream stream{};
    if (inflateInit2(&stream, 15 + 32) != Z_OK) return {{}, Error{ErrorCode::limit, "no memory to unpack"}};
    stream.next_in = const_cast<u8*>(packed.data());
    stream.avail_in = uInt(std::min<std::size_t>(packed.size(), kMaxInflatedBytes));
    std::size_t size = 0;
    std::optional<Error> error;
    for (;;) {
        if (size == capacity_ && !grow(capacity_ * 2)) {
            error = Error{ErrorCode::limit, "unpacks to more than 64 MiB"};
            break;
        }
        stream.next_out = buffer_.get() + size;
        stream.avail_out = uInt(capacity_ - size);
        const int result = inflate(&stream, Z_NO_FLUSH);
        size = capacity_ - stream.avail_out;
        if (result == Z_STREAM_END) break;
        if (result == Z_OK && stream.avail_out == 0) continue;
        if (result == Z_OK && stream.avail_in > 0) continue;
        error = Error{ErrorCode::damaged,
                      result == Z_DATA_ERROR ? "compressed data is damaged" : "compressed data ends early"};
        break;
    }
    inflateEnd(&stream);
    return {ByteView(buffer_.get(), size), std::move(error)};
}

// Blocks of: "LZ4Block", token (method | level), packed size, size, checksum (little-endian), data; a block of size 0
// ends.
Inflated Inflater::lz4_blocks(ByteView packed) {
    constexpr std::size_t kHead = 21;
    grow(1);
    std::size_t size = 0;
    auto broken = [&](ErrorCode code, const char* what) {
        return Inflated{ByteView(buffer_.get(), size), Error{code, what}};
    };
    auto little32 = [](const u8* p) { return u32(p[0]) | u32(p[1]) << 8 | u32(p[2]) << 16 | u32(p[3]) << 24; };
    for (;;) {
        if (packed.size() < kHead) return broken(ErrorCode::damaged, "LZ4 data ends early");
        if (std::memcmp(packed.data(), "LZ4Block", 8) != 0) return broken(ErrorCode::damaged, "LZ4 block has no magic");
        const u32 method = packed[8] & 0xf0, packed_size = little32(&packed[9]), block_size = little32(&packed[13]),
                  checksum = little32(&packed[17]);
        packed = packed.subspan(kHead);
        if (block_size == 0) return {ByteView(buffer_.get(), size), {}};
        if (packed_size > packed.size()) return broken(ErrorCode::damaged, "LZ4 data ends early");
        // A block unpacks to at most 32 MiB by its level; our own bound is on the whole.
        if (block_size > kMaxInflatedBytes - size || !grow(size + block_size))
            return broken(ErrorCode::limit, "unpacks to more than 64 MiB");
        u8* const out = buffer_.get() + size;
        if (method == 0x10) {
            if (packed_size != block_size) return broken(ErrorCode::damaged, "LZ4 block sizes differ");
            std::memcpy(out, packed.data(), block_size);
        } else if (method == 0x20) {
            const int got = LZ4_decompress_safe(reinterpret_cast<const char*>(packed.data()),
                                                reinterpret_cast<char*>(out), int(packed_size), int(block_size));
            if (got != int(block_size)) return broken(ErrorCode::damaged, "LZ4 block is damaged");
        } else {
            return broken(ErrorCode::unsupported, "LZ4 block method is unknown");
        }
        if ((XXH32(out, block_size, 0x9747b28cu) & 0x0fffffffu) != checksum)
            return broken(ErrorCode::damaged, "LZ4 block checksum differs");
        size += block_size;
        packed = packed.subspan(packed_size);
    }
}

std::optional<Compression> guess_compression(ByteView b) {
    if (b.size() < 3) return {};
    if (b[0] == 0x1f && b[1] == 0x8b) return Compression::gzip;
    if ((b[0] & 0x0f) == 8 && (b[0] << 8 | b[1]) % 31 == 0) return Compression::zlib;
    if (b.size() >= 8 && std::memcmp(b.data(), "LZ4Block", 8) == 0) return Compression::lz4;
    if (b[0] == 10 && b[1] == 0 && b[2] < 32) return Compression::none;
    return {};
}

} // namespace vitrail
