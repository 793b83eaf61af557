#include "store/keys.h"

namespace vitrail::keys {

static void put_big(Bytes& out, u32 v) {
    out.push_back(u8(v >> 24));
    out.push_back(u8(v >> 16));
    out.push_back(u8(v >> 8));
    out.push_back(u8(v));
}

static u32 get_big(const u8* p) {
    return u32(p[0]) << 24 | u32(p[1]) << 16 | u32(p[2]) << 8 | p[3];
}

// Flipping the sign bit makes byte order number order.
static u32 ordered(i32 v) {
    return u32(v) ^ 0x80000000u;
}
static i32 restored(u32 v) {
    return i32(v ^ 0x80000000u);
}

Bytes number(u32 value) {
    Bytes out;
    put_big(out, value);
    return out;
}

Bytes big_number(u64 value) {
    Bytes out;
    out.reserve(8);
    put_big(out, u32(value >> 32));
    put_big(out, u32(value));
    return out;
}

Bytes text(std::string_view value) {
    return Bytes(value.begin(), value.end());
}

Bytes chunk(DimensionId dimension, ChunkPos at) {
    Bytes out;
    out.reserve(16);
    put_big(out, u32(dimension));
    put_big(out, ordered(at.x));
    put_big(out, ordered(at.z));
    put_big(out, ordered(at.y));
    return out;
}

Bytes column(DimensionId dimension, ColumnPos at) {
    Bytes out;
    out.reserve(12);
    put_big(out, u32(dimension));
    put_big(out, ordered(at.x));
    put_big(out, ordered(at.z));
    return out;
}

Bytes after(Bytes prefix) {
    while (!prefix.empty() && prefix.back() == 0xff)
        prefix.pop_back();
    if (!prefix.empty()) ++prefix.back();
    return prefix;
}

std::optional<u32> read_number(ByteView key) {
    if (key.size() != 4) return std::nullopt;
    return get_big(key.data());
}

std::optional<Located<ChunkPos>> read_chunk(ByteView key) {
    if (key.size() != 16) return std::nullopt;
    const u8* p = key.data();
    return Located<ChunkPos>{DimensionId(get_big(p)),
                             {restored(get_big(p + 4)), restored(get_big(p + 12)), restored(get_big(p + 8))}};
}

std::optional<Located<ColumnPos>> read_column(ByteView key) {
    if (key.size() != 12) return std::nullopt;
    const u8* p = key.data();
    return Located<ColumnPos>{DimensionId(get_big(p)), {restored(get_big(p + 4)), restored(get_big(p + 8))}};
}

} // namespace vitrail::keys
