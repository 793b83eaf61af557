// Small Minecraft files made by hand: regions, chunks, worlds on disk.
#pragma once

#include "formats/inflate.h"
#include "formats/nbt.h"
#include "formats/region.h"

#include <filesystem>
#include <fstream>
#include <functional>
#include <lz4.h>
#include <map>
#include <string>
#include <unistd.h>
#include <xxhash.h>
#include <zlib.h>

namespace vitrail::test {

inline Bytes deflated(ByteView plain, Compression method) {
    z_stream s{};
    deflateInit2(&s, 6, Z_DEFLATED, method == Compression::gzip ? 31 : 15, 8, Z_DEFAULT_STRATEGY);
    Bytes out(deflateBound(&s, plain.size()) + 32);
    s.next_in = const_cast<u8*>(plain.data());
    s.avail_in = uInt(plain.size());
    s.next_out = out.data();
    s.avail_out = uInt(out.size());
    deflate(&s, Z_FINISH);
    out.resize(s.total_out);
    deflateEnd(&s);
    return out;
}

// The block stream that Minecraft writes: blocks of at most `block` bytes, every third one stored as it is.
inline Bytes lz4_blocks(ByteView plain, std::size_t block = 65536) {
    Bytes out;
    auto little = [&](u32 v) {
        for (int i = 0; i < 4; ++i)
            out.push_back(u8(v >> 8 * i));
    };
    auto head = [&](u8 token, u32 packed, u32 size, u32 sum) {
        for (const char c : std::string("LZ4Block"))
            out.push_back(u8(c));
        out.push_back(token);
        little(packed), little(size), little(sum);
    };
    int n = 0;
    for (std::size_t at = 0; at < plain.size(); at += block) {
        const ByteView part = plain.subspan(at, std::min(block, plain.size() - at));
        const u32 sum = XXH32(part.data(), part.size(), 0x9747b28c) & 0x0fffffff;
        Bytes packed(std::size_t(LZ4_compressBound(int(part.size()))));
        packed.resize(std::size_t(LZ4_compress_default(reinterpret_cast<const char*>(part.data()),
                                                       reinterpret_cast<char*>(packed.data()), int(part.size()),
                                                       int(packed.size()))));
        const bool raw = n++ % 3 == 2;
        head(raw ? 0x16 : 0x26, u32(raw ? part.size() : packed.size()), u32(part.size()), sum);
        if (raw)
            out.insert(out.end(), part.begin(), part.end());
        else
            out.insert(out.end(), packed.begin(), packed.end());
    }
    head(0x16, 0, 0, 0);
    return out;
}

inline Bytes packed(ByteView plain, Compression method) {
    if (method == Compression::none) return Bytes(plain.begin(), plain.end());
    return method == Compression::lz4 ? lz4_blocks(plain) : deflated(plain, method);
}

// A region file from the NBT of its chunks.
class RegionBuilder {
public:
    // external: the chunk's bytes go to a file of their own, given by external_file.
    RegionBuilder& add(u32 slot, ByteView nbt, Compression method = Compression::zlib, bool external = false) {
        Bytes body = packed(nbt, method);
        if (external) external_[slot] = std::exchange(body, {});
        return add_raw(slot, body, u8(u8(method) | (external ? 0x80 : 0)), u32(body.size() + 1));
    }
    RegionBuilder& add_raw(u32 slot, ByteView body, u8 method, u32 length) {
        const u32 first = u32(bytes_.size() / 4096), sectors = u32((body.size() + 5 + 4095) / 4096);
        set_location(slot, first << 8 | sectors);
        for (int i = 3; i >= 0; --i)
            bytes_.push_back(u8(length >> 8 * i));
        bytes_.push_back(method);
        bytes_.insert(bytes_.end(), body.begin(), body.end());
        bytes_.resize((bytes_.size() + 4095) / 4096 * 4096);
        return *this;
    }
    RegionBuilder& set_location(u32 slot, u32 value) {
        for (u32 i = 0; i < 4; ++i)
            bytes_[slot * 4 + i] = u8(value >> (24 - 8 * i));
        return *this;
    }
    const Bytes& bytes() const { return bytes_; }
    const Bytes& external_file(u32 slot) const { return external_.at(slot); }

private:
    Bytes bytes_ = Bytes(8192);
    std::map<u32, Bytes> external_;
};

// A chunk of 1.2 to 1.12: blocks by number, section y to its 4096 codes (id << 4 | meta).
inline Bytes numeric_chunk(i32 x, i32 z, const std::map<i32, std::vector<u16>>& sections, i32 data_version = 0,
                           const std::function<void(nbt::Writer&)>& more = {}) {
    nbt::Writer w;
    w.begin_compound();
    if (data_version) w.put_int("DataVersion", data_version);
    w.begin_compound("Level");
    w.put_int("xPos", x).put_int("zPos", z).put_byte("TerrainPopulated", 1);
    w.begin_list("Sections", nbt::Type::compound, u32(sections.size()));
    for (const auto& [y, codes] : sections) {
        Bytes blocks(4096), data(2048), add(2048);
        bool high = false;
        for (u32 i = 0; i < 4096; ++i) {
            blocks[i] = u8(codes[i] >> 4);
            data[i / 2] |= u8((codes[i] & 15) << (i & 1) * 4);
            add[i / 2] |= u8((codes[i] >> 12) << (i & 1) * 4);
            high = high || codes[i] >> 12;
        }
        w.begin_compound().put_byte("Y", i8(y)).put_bytes("Blocks", blocks).put_bytes("Data", data);
        if (high) w.put_bytes("Add", add);
        w.end_compound();
    }
    w.end_list();
    if (more) more(w);
    w.end_compound();
    w.end_compound();
    return w.take();
}

// A chunk of 1.18 on with one section of two states, the second on the floor (y = 0 of the section).
inline Bytes modern_chunk(i32 x, i32 z, i32 section_y, const std::string& above, const std::string& floor,
                          const std::string& biome = "minecraft:plains", i32 data_version = 3955) {
    std::vector<u64> words(256);
    for (u32 i = 0; i < 16; ++i)
        words[i] = 0x1111111111111111u;
    nbt::Writer w;
    w.begin_compound()
        .put_int("DataVersion", data_version)
        .put_int("xPos", x)
        .put_int("zPos", z)
        .put_int("yPos", section_y);
    w.put_string("Status", "minecraft:full");
    w.begin_list("sections", nbt::Type::compound, 1).begin_compound().put_byte("Y", i8(section_y));
    w.begin_compound("block_states").begin_list("palette", nbt::Type::compound, 2);
    for (const std::string& name : {above, floor})
        w.begin_compound().put_string("Name", name).end_compound();
    w.end_list().put_longs("data", words).end_compound();
    w.begin_compound("biomes")
        .begin_list("palette", nbt::Type::string, 1)
        .put_string("", biome)
        .end_list()
        .end_compound();
    w.end_compound().end_list().end_compound();
    return w.take();
}

inline void write_file(const std::filesystem::path& path, ByteView bytes) {
    std::filesystem::create_directories(path.parent_path());
    std::ofstream(path, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()), std::streamsize(bytes.size()));
}

// A folder that goes with the test.
class TempFolder {
public:
    TempFolder() {
        static int n = 0;
        path_ = std::filesystem::temp_directory_path() /
                ("vitrail_formats_" + std::to_string(::getpid()) + "_" + std::to_string(n++));
        std::filesystem::create_directories(path_);
    }
    ~TempFolder() { std::filesystem::remove_all(path_); }
    const std::filesystem::path& path() const { return path_; }

private:
    std::filesystem::path path_;
};

} // namespace vitrail::test
