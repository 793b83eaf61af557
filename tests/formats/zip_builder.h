// Small zips for tests, honest and not: entries stored or deflated, with names and sizes as a test wants them.
#pragma once

#include "base/bytes.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>
#include <zlib.h>

namespace vitrail::test {

class ZipBuilder {
public:
    struct Options {
        bool deflate = false;
        std::optional<u32> claimed_size{}; // instead of the true one
        bool wrong_crc = false;
    };
    void add(std::string_view name, std::string_view data) { add(name, data, Options{}); }
    void add(std::string_view name, ByteView data) {
        add(name, std::string_view(reinterpret_cast<const char*>(data.data()), data.size()), Options{});
    }
    void add(std::string_view name, std::string_view data, Options o) {
        std::string packed(data);
        if (o.deflate) {
            z_stream z{};
            deflateInit2(&z, 9, Z_DEFLATED, -15, 8, Z_DEFAULT_STRATEGY);
            packed.resize(deflateBound(&z, data.size()));
            z.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(data.data()));
            z.avail_in = uInt(data.size());
            z.next_out = reinterpret_cast<Bytef*>(packed.data());
            z.avail_out = uInt(packed.size());
            deflate(&z, Z_FINISH);
            packed.resize(z.total_out);
            deflateEnd(&z);
        }
        u32 crc = u32(crc32(0, reinterpret_cast<const Bytef*>(data.data()), uInt(data.size())));
        if (o.wrong_crc) crc ^= 1;
        const auto common = [&](ByteWriter& w) {
            w.put_u16(20), w.put_u16(0), w.put_u16(o.deflate ? 8 : 0), w.put_u32(0), w.put_u32(crc);
            w.put_u32(u32(packed.size())), w.put_u32(o.claimed_size.value_or(u32(data.size())));
            w.put_u16(u16(name.size())), w.put_u16(0);
        };
        const u32 offset = u32(body_.bytes().size());
        body_.put_u32(0x04034b50);
        common(body_);
        body_.put_raw(name.data(), name.size());
        body_.put_raw(packed.data(), packed.size());
        directory_.put_u32(0x02014b50), directory_.put_u16(20);
        common(directory_);
        directory_.put_u16(0), directory_.put_u16(0), directory_.put_u16(0), directory_.put_u32(0),
            directory_.put_u32(offset);
        directory_.put_raw(name.data(), name.size());
        ++count_;
    }
    Bytes bytes() {
        ByteWriter out;
        out.put_bytes(body_.bytes());
        out.put_bytes(directory_.bytes());
        out.put_u32(0x06054b50), out.put_u32(0), out.put_u16(count_), out.put_u16(count_);
        out.put_u32(u32(directory_.bytes().size())), out.put_u32(u32(body_.bytes().size())), out.put_u16(0);
        return out.bytes();
    }

private:
    ByteWriter body_, directory_;
    u16 count_ = 0; // entries
};

} // namespace vitrail::test
