// Resource packs of Minecraft (Java Edition): a zip or a folder of pictures and JSON files, and several of them in
// order. docs/formats/resource-packs.md says what is read.
//
//     PackReport report;
//     VX_TRY_ASSIGN(auto pack, ResourcePack::open("faithful.zip", report));
//     PackStack packs;
//     packs.add(std::move(pack));                       // the later covers the earlier
//     auto file = packs.read("minecraft/textures/block/stone.png", kMaxPicture, report);
//
// A pack is bytes from anyone. Nothing leaves a pack's folder or archive: names with "..", a drive, a root or a
// backslash are no names, links are not followed. A file is read up to a size that the caller gives, whatever its
// header says.
#pragma once

#include "base/bytes.h"
#include "base/result.h"

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace vitrail {

// What was wrong, in words: the first kLines of them, and how many in all.
struct PackReport {
    static constexpr std::size_t kLines = 20;
    u64 problems = 0;
    std::vector<std::string> lines;
    void say(std::string line) {
        ++problems;
        if (lines.size() < kLines) lines.push_back(std::move(line));
    }
};

struct PackInfo {
    std::string name;        // of the file or folder
    std::string description; // plain text, one line, at most 256 bytes
    i32 format = 0;          // pack_format; 0 where pack.mcmeta does not say
    // Formats 1 to 3 (to 1.12) keep block pictures in textures/blocks under old names, and know no flat block names.
    bool old_names() const { return format >= 1 && format <= 3; }
};

class ResourcePack {
public:
    static constexpr u64 kMaxFiles = 65536, kMaxPathBytes = 256, kMaxPackBytes = u64(1) << 30;

    // A folder, or a zip of at most kMaxPackBytes. The files may lie in one folder inside it; a folder of bare
    // textures/ is taken for assets/minecraft. What is left out is said in the report. Errors: not_found, io, damaged
    // (no zip, pack.mcmeta broken or missing), limit.
    static Result<std::shared_ptr<const ResourcePack>> open(const std::filesystem::path& path, PackReport& report);
    // The same from a zip in memory.
    static Result<std::shared_ptr<const ResourcePack>> from_zip(Bytes bytes, std::string name, PackReport& report);
    ~ResourcePack();
    ResourcePack(const ResourcePack&) = delete;
    ResourcePack& operator=(const ResourcePack&) = delete;

    const PackInfo& info() const { return info_; }
    // Paths below assets/, lower case as they are: "minecraft/textures/block/stone.png".
    bool contains(std::string_view path) const { return files_.contains(path); }
    // All paths that begin with `prefix` and end with `suffix`, sorted.
    std::vector<std::string> list(std::string_view prefix, std::string_view suffix) const;
    std::size_t file_count() const { return files_.size(); }
    // Thread-safe. Errors: not_found, limit (larger than `most` bytes, which are all that is ever unpacked), damaged,
    // io.
    Result<Bytes> read(std::string_view path, std::size_t most) const;

private:
    struct Zip;
    struct Place {
        u64 index = 0;              // in the zip
        std::filesystem::path file; // of a folder
    };
    ResourcePack();
    Result<> list_folder(const std::filesystem::path& root, PackReport& report);
    Result<> list_zip(PackReport& report);
    Result<> finish(PackReport& report); // finds the layout, reads pack.mcmeta
    Result<Bytes> read_place(const Place& place, std::size_t most) const;
    PackInfo info_;
    std::map<std::string, Place, std::less<>> files_;
    std::unique_ptr<Zip> zip_;
};

// pack.mcmeta. Errors: damaged.
Result<PackInfo> parse_pack_mcmeta(ByteView text, std::string name);

class PackStack {
public:
    void add(std::shared_ptr<const ResourcePack> pack) { packs_.push_back(std::move(pack)); }
    bool empty() const { return packs_.empty(); }
    const std::vector<std::shared_ptr<const ResourcePack>>& packs() const { return packs_; }

    // The topmost pack that has this path; null where none has.
    const ResourcePack* find(std::string_view path) const;
    // The topmost file that can be read: one that is broken is reported, and the pack below is asked.
    std::optional<Bytes> read(std::string_view path, std::size_t most, PackReport& report) const;

private:
    std::vector<std::shared_ptr<const ResourcePack>> packs_;
};

// A name as packs write it: "block/stone" is minecraft:block/stone. Errors: invalid_argument, for a name that is no
// path inside a pack.
struct ResourceName {
    std::string space = "minecraft", path;
    std::string text() const { return space + ":" + path; }
    // "minecraft/models/block/stone.json" for kind "models", suffix ".json".
    std::string file(std::string_view kind, std::string_view suffix) const;
};
Result<ResourceName> parse_resource_name(std::string_view text);

} // namespace vitrail
