// ByteWriter and ByteReader: little-endian, bounds-checked building and reading of byte strings.
// A reader never reads past its end: the first failed read sets `failed()` and every later read gives zero.
#pragma once

#include "base/types.h"

#include <bit>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace vitrail {

using Bytes = std::vector<u8>;
using ByteView = std::span<const u8>;

class ByteWriter {
public:
    void put_u8(u8 v) { bytes_.push_back(v); }
    void put_u16(u16 v) { put_raw(&v, sizeof v); }
    void put_u32(u32 v) { put_raw(&v, sizeof v); }
    void put_u64(u64 v) { put_raw(&v, sizeof v); }
    void put_f32(float v) { put_raw(&v, sizeof v); }
    // LEB128: 7 bits a byte, low bits first.
    void put_varint(u64 v) {
        while (v >= 0x80)
            put_u8(u8(v) | 0x80), v >>= 7;
        put_u8(u8(v));
    }
    // Zigzag, so that small negative numbers stay short.
    void put_svarint(i64 v) { put_varint((u64(v) << 1) ^ u64(v >> 63)); }
    void put_bytes(ByteView v) { put_raw(v.data(), v.size()); }
    void put_string(std::string_view v) {
        put_varint(v.size());
        put_raw(v.data(), v.size());
    }
    void put_raw(const void* data, std::size_t size) {
        static_assert(std::endian::native == std::endian::little);
        if (size == 0) return;
        const std::size_t at = bytes_.size();
        bytes_.resize(at + size);
        std::memcpy(bytes_.data() + at, data, size);
    }
    std::size_t size() const { return bytes_.size(); }
    Bytes& bytes() { return bytes_; }
    Bytes take() { return std::move(bytes_); }

private:
    Bytes bytes_;
};

class ByteReader {
public:
    explicit ByteReader(ByteView bytes)
        : bytes_(bytes) {}
    u8 get_u8() { return get_raw<u8>(); }
    u16 get_u16() { return get_raw<u16>(); }
    u32 get_u32() { return get_raw<u32>(); }
    u64 get_u64() { return get_raw<u64>(); }
    float get_f32() { return get_raw<float>(); }
    u64 get_varint() {
        u64 v = 0;
        for (int shift = 0; shift < 64; shift += 7) {
            const u8 b = get_u8();
            if (shift == 63 && b > 1) failed_ = true;
            v |= u64(b & 0x7f) << shift;
            if (!(b & 0x80)) return failed_ ? 0 : v;
        }
        failed_ = true;
        return 0;
    }
    i64 get_svarint() {
        const u64 v = get_varint();
        return i64(v >> 1) ^ -i64(v & 1);
    }
    // A view into the input; empty and failed where fewer than `size` bytes remain.
    ByteView get_bytes(u64 size) {
        if (failed_ || size > remaining()) {
            failed_ = true;
            return {};
        }
        ByteView view = bytes_.subspan(at_, std::size_t(size));
        at_ += std::size_t(size);
        return view;
    }
    std::string_view get_string(u64 most) {
        const u64 size = get_varint();
        if (size > most) failed_ = true;
        ByteView view = get_bytes(size);
        return {reinterpret_cast<const char*>(view.data()), view.size()};
    }
    std::size_t remaining() const { return bytes_.size() - at_; }
    std::size_t position() const { return at_; }
    bool failed() const { return failed_; }
    void set_failed() { failed_ = true; }
    // All read, nothing left over, nothing failed.
    bool finished() const { return !failed_ && remaining() == 0; }

private:
    template <class T>
    T get_raw() {
        T v{};
        if (failed_ || remaining() < sizeof(T)) {
            failed_ = true;
            return v;
        }
        std::memcpy(&v, bytes_.data() + at_, sizeof v);
        at_ += sizeof v;
        return v;
    }
    ByteView bytes_;
    std::size_t at_ = 0;
    bool failed_ = false;
};

} // namespace vitrail
