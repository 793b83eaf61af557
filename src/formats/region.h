// Region files: 32 x 32 chunk slots in one .mca (Anvil) or .mcr (McRegion) file (docs/formats/minecraft.md).
// Nothing in the file is trusted. A chunk is read on its own with one positioned read, so an open region costs its 8
// KiB head and a worker the packed and unpacked bytes of one chunk.
#pragma once

#include "formats/inflate.h"
#include "formats/nbt.h"
#include "voxel/coords.h"

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace vitrail {

inline constexpr u32 kRegionSlots = 1024; // slot = x | z << 5, chunk coordinates within the region
inline constexpr std::size_t kMaxPackedBytes = std::size_t(64) << 20;

struct RegionPos {
    i32 x = 0, z = 0; // chunk coordinate divided by 32, rounded down
    friend bool operator==(const RegionPos&, const RegionPos&) = default;
    friend auto operator<=>(const RegionPos&, const RegionPos&) = default;
};

// The place from a name like r.-1.0.mca; nothing for other names.
std::optional<RegionPos> region_pos_of(const std::string& file_name);

// What is wrong with a slot although it may still be readable.
enum SlotFlaw : u8 {
    kSlotOverlaps = 1,    // shares sectors with another slot or the head
    kSlotBeyondFile = 2,  // its sectors reach beyond the end of the file
    kSlotWrongLength = 4, // the stored length does not fit its sectors
    kSlotWrongMethod = 8, // the bytes are not what the compression number says
};

class RegionFile {
public:
    // Errors: io; damaged, for a file shorter than a location table. An empty file is a region without chunks.
    static Result<RegionFile> open(const std::filesystem::path& path);
    // A region in memory, for tests and fuzzing; external chunks are not looked for.
    static Result<RegionFile> from_bytes(Bytes bytes, RegionPos at = {});
    ~RegionFile();
    RegionFile(RegionFile&& other) noexcept;
    RegionFile& operator=(RegionFile&&) = delete;

    RegionPos position() const { return at_; }
    u64 size_bytes() const { return size_; }
    bool has_chunk(u32 slot) const { return locations_[slot] != 0; }
    u32 chunk_count() const;
    ColumnPos column_of_slot(u32 slot) const { return {at_.x * 32 + i32(slot & 31), at_.z * 32 + i32(slot >> 5)}; }
    u32 timestamp(u32 slot) const { return timestamps_[slot]; } // seconds since 1970; 0 where unknown

    struct PackedChunk {
        ByteView bytes; // into the scratch buffer
        Compression method = Compression::zlib;
        u8 flaws = 0; // SlotFlaw bits
    };
    // The packed bytes of a slot, in `scratch`. Any number of threads may read one region, each with its own scratch.
    // Errors: not_found (no chunk), damaged, io, limit.
    Result<PackedChunk> read(u32 slot, Bytes& scratch) const;

private:
    RegionFile() = default;
    Result<> read_head();
    bool read_at(u64 offset, void* out, std::size_t size) const; // false: io error or beyond the end
    int fd_ = -1;
    Bytes memory_;
    std::filesystem::path folder_;
    u64 size_ = 0;
    RegionPos at_;
    std::array<u32, kRegionSlots> locations_{}, timestamps_{}; // locations: first sector << 8 | sectors
    std::array<u8, kRegionSlots> flaws_{};
};

// Scratch of one worker, and a chunk's NBT read through it.
struct ChunkReader {
    Bytes packed;
    Inflater inflater;
    nbt::Document document;

    struct Outcome {
        bool usable = false;        // `document` holds at least a part of the chunk
        bool stream_broken = false; // the compressed stream is damaged or lacks its end
        u8 flaws = 0;               // SlotFlaw bits
        std::optional<Error> error; // why the NBT is absent or not whole; with `usable`, what came before it is there
    };
    Outcome read(const RegionFile& region, u32 slot);
};

// Bytes of a whole file. Errors: not_found, io, limit (larger than most).
Result<Bytes> read_file(const std::filesystem::path& path, u64 most);

} // namespace vitrail
