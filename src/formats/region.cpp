#include "formats/region.h"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

namespace vitrail {

namespace {
constexpr u32 kSector = 4096;
constexpr u8 kExternal = 0x80;

u32 big32(const u8* p) {
    return u32(p[0]) << 24 | u32(p[1]) << 16 | u32(p[2]) << 8 | p[3];
}
} // namespace

std::optional<RegionPos> region_pos_of(const std::string& name) {
    RegionPos out;
    const char* p = name.data();
    const char* const end = p + name.size();
    auto number = [&](i32& v) {
        auto [next, error] = std::from_chars(p, end, v);
        // Beyond this the blocks lie outside the world.
        const bool ok = error == std::errc() && next < end && *next == '.' && std::abs(i64(v)) <= kWorldEdge / 512;
        p = next + 1;
        return ok;
    };
    if (name.rfind("r.", 0) != 0) return {};
    p += 2;
    if (!number(out.x) || !number(out.z)) return {};
    const std::string_view ext(p, std::size_t(end - p));
    if (ext != "mca" && ext != "mcr") return {};
    return out;
}

Result<Bytes> read_file(const std::filesystem::path& path, u64 most) {
    const int fd = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
    if (fd < 0)
        return fail(errno == ENOENT ? ErrorCode::not_found : ErrorCode::io,
                    fmt::format("cannot open {}: {}", path.string(), std::strerror(errno)));
    struct stat info {};
    Bytes out;
    std::optional<Error> error;
    if (::fstat(fd, &info) != 0 || !S_ISREG(info.st_mode)) {
        error = Error{ErrorCode::io, fmt::format("{} is no regular file", path.string())};
    } else if (u64(info.st_size) > most) {
        error = Error{ErrorCode::limit, fmt::format("{} is too large", path.string())};
    } else {
        out.resize(std::size_t(info.st_size));
        std::size_t at = 0;
        while (at < out.size()) {
            const ssize_t got = ::read(fd, out.data() + at, out.size() - at);
            if (got < 0 && errno == EINTR) continue;
            if (got < 0)
                error = Error{ErrorCode::io, fmt::format("cannot read {}: {}", path.string(), std::strerror(errno))};
            if (got <= 0) break;
            at += std::size_t(got);
        }
        out.resize(at);
    }
    ::close(fd);
    if (error) return tl::unexpected(std::move(*error));
    return out;
}

RegionFile::~RegionFile() {
    if (fd_ >= 0) ::close(fd_);
}
RegionFile::RegionFile(RegionFile&& o) noexcept
    : fd_(std::exchange(o.fd_, -1))
    , memory_(std::move(o.memory_))
    , folder_(std::move(o.folder_))
    , size_(o.size_)
    , at_(o.at_)
    , locations_(o.locations_)
    , timestamps_(o.timestamps_)
    , flaws_(o.flaws_) {}

Result<RegionFile> RegionFile::open(const std::filesystem::path& path) {
    RegionFile out;
    out.fd_ = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
    if (out.fd_ < 0) return fail(ErrorCode::io, fmt::format("cannot open {}: {}", path.string(), std::strerror(errno)));
    struct stat info {};
    if (::fstat(out.fd_, &info) != 0 || !S_ISREG(info.st_mode))
        return fail(ErrorCode::io, fmt::format("{} is no regular file", path.string()));
    out.size_ = u64(info.st_size);
    out.folder_ = path.parent_path();
    out.at_ = region_pos_of(path.filename().string()).value_or(RegionPos{});
    if (auto head = out.read_head(); !head)
        return fail(head.error().code, fmt::format("{}: {}", path.string(), head.error().message));
    return out;
}

Result<RegionFile> RegionFile::from_bytes(Bytes bytes, RegionPos at) {
    RegionFile out;
    out.size_ = bytes.size();
    out.memory_ = std::move(bytes);
    out.at_ = at;
    VX_TRY(out.read_head());
    return out;
}

bool RegionFile::read_at(u64 offset, void* out, std::size_t size) const {
    if (offset > size_ || size > size_ - offset) return false;
    if (fd_ < 0) {
        if (size > 0) std::memcpy(out, memory_.data() + offset, size);
        return true;
    }
    u8* p = static_cast<u8*>(out);
    while (size > 0) {
        const ssize_t got = ::pread(fd_, p, size, off_t(offset));
        if (got < 0 && errno == EINTR) continue;
        if (got <= 0) return false;
        p += got, offset += u64(got), size -= std::size_t(got);
    }
    return true;
}

Result<> RegionFile::read_head() {
    if (size_ == 0) return {};
    std::array<u8, 2 * kSector> head{};
    const std::size_t there = std::size_t(std::min<u64>(size_, head.size()));
    if (there < kSector) return fail(ErrorCode::damaged, "region file is shorter than its location table");
    if (!read_at(0, head.data(), there)) return fail(ErrorCode::io, "cannot read the head of the region file");
    struct Extent {
        u32 first, end, slot;
    };
    std::vector<Extent> extents;
    for (u32 slot = 0; slot < kRegionSlots; ++slot) {
        locations_[slot] = big32(&head[slot * 4]);
        timestamps_[slot] = big32(&head[kSector + slot * 4]);
        if (locations_[slot] == 0) continue;
        const u32 first = locations_[slot] >> 8, sectors = locations_[slot] & 255;
        if (first < 2) flaws_[slot] |= kSlotOverlaps;
        if (u64(first + sectors) * kSector > (size_ + kSector - 1) / kSector * kSector) flaws_[slot] |= kSlotBeyondFile;
        extents.push_back({first, first + std::max(sectors, 1u), slot});
    }
    std::sort(extents.begin(), extents.end(), [](const Extent& a, const Extent& b) { return a.first < b.first; });
    Extent widest{0, 0, 0};
    for (const Extent& e : extents) {
        if (e.first < widest.end) flaws_[e.slot] |= kSlotOverlaps, flaws_[widest.slot] |= kSlotOverlaps;
        if (e.end > widest.end) widest = e;
    }
    return {};
}

u32 RegionFile::chunk_count() const {
    return u32(std::count_if(locations_.begin(), locations_.end(), [](u32 l) { return l != 0; }));
}

Result<RegionFile::PackedChunk> RegionFile::read(u32 slot, Bytes& scratch) const {
    if (!has_chunk(slot)) return fail(ErrorCode::not_found, "no chunk in this slot");
    PackedChunk out;
    out.flaws = flaws_[slot];
    const u64 offset = u64(locations_[slot] >> 8) * kSector;
    const u32 sectors = locations_[slot] & 255;
    if (offset < 2 * kSector) return fail(ErrorCode::damaged, "chunk lies inside the head of the region");
    u8 head[5];
    if (!read_at(offset, head, sizeof head)) return fail(ErrorCode::damaged, "chunk lies beyond the end of the region");
    const u32 length = big32(head); // compression number included
    if (length == 0) return fail(ErrorCode::damaged, "chunk has length zero");
    // 255 sectors stand for "as many as the length says" in files of some modded servers.
    if (sectors != 255 && u64(length) + 4 > u64(sectors) * kSector) out.flaws |= kSlotWrongLength;
    const u64 there = size_ - offset - 5;
    u64 size = length - 1;
    if (size > there) {
        out.flaws |= kSlotWrongLength;
        size = there; // a stream cut short may still give most of its chunk
    }
    const bool external = head[4] & kExternal;
    const u8 method = head[4] & 0x7f;
    if (external && fd_ >= 0) {
        const ColumnPos at = column_of_slot(slot);
        VX_TRY_ASSIGN(scratch, read_file(folder_ / fmt::format("c.{}.{}.mcc", at.x, at.z), kMaxPackedBytes));
    } else if (external) {
        return fail(ErrorCode::not_found, "chunk lies in a file of its own, which is not here");
    } else {
        if (size > kMaxPackedBytes) return fail(ErrorCode::limit, "chunk is larger than 64 MiB");
        scratch.resize(std::size_t(size));
        if (!read_at(offset + 5, scratch.data(), scratch.size())) return fail(ErrorCode::io, "cannot read the chunk");
    }
    out.bytes = scratch;
    if (const auto guess = guess_compression(out.bytes); guess && u8(*guess) != method) {
        out.flaws |= kSlotWrongMethod;
        out.method = *guess;
    } else if (method < 1 || method > 4) {
        return fail(ErrorCode::unsupported, fmt::format("unknown compression {}", method));
    } else {
        out.method = Compression(method);
    }
    return out;
}

ChunkReader::Outcome ChunkReader::read(const RegionFile& region, u32 slot) {
    Outcome out;
    auto raw = region.read(slot, packed);
    if (!raw) {
        out.error = std::move(raw).error();
        return out;
    }
    out.flaws = raw->flaws;
    Inflated nbt = inflater.unpack(raw->method, raw->bytes);
    const bool parsed = document.parse(nbt.bytes);
    // A root compound with something in it.
    out.usable = document.root().size() > 0;
    out.stream_broken = nbt.error.has_value();
    // A stream that lacks only its end gave everything: no error then.
    if (!parsed) out.error = nbt.error ? std::move(nbt.error) : document.error();
    return out;
}

} // namespace vitrail
