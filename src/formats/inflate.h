// Unpacks compressed NBT streams into a buffer that is kept from call to call.
#pragma once

#include "base/bytes.h"
#include "base/result.h"

#include <memory>
#include <optional>

namespace vitrail {

// Numbers as region files write them.
enum class Compression : u8 { gzip = 1, zlib = 2, none = 3, lz4 = 4 };

inline constexpr std::size_t kMaxInflatedBytes = std::size_t(64) << 20;

struct Inflated {
    ByteView bytes;             // valid until the next call
    std::optional<Error> error; // what broke; `bytes` is then what came out before it
};

// One a thread.
class Inflater {
public:
    Inflater();
    ~Inflater();
    Inflater(const Inflater&) = delete;
    Inflater& operator=(const Inflater&) = delete;

    // Never gives more than kMaxInflatedBytes (error: limit). `none` gives a view of the input.
    // lz4: the block stream of net.jpountz (LZ4BlockOutputStream), checksums checked.
    Inflated unpack(Compression method, ByteView packed);

private:
    Inflated deflated(Compression method, ByteView packed);
    Inflated deflated_as_far_as_it_goes(ByteView packed);
    Inflated lz4_blocks(ByteView packed);
    bool grow(std::size_t least);
    struct Codec;
    std::unique_ptr<Codec> codec_;
    std::unique_ptr<u8[]> buffer_;
    std::size_t capacity_ = 0;
};

// By its first bytes: gzip, zlib, an LZ4 block stream or bare NBT; nothing where it looks like none of them.
std::optional<Compression> guess_compression(ByteView packed);

} // namespace vitrail
