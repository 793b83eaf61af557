// What count and import share: the work of a world cut into strips of regions, scratch memory handed from task to task,
// and a chunk read, decoded and reported.
#pragma once

#include "formats/anvil.h"
#include "formats/read_report.h"
#include "formats/region.h"

#include <map>
#include <memory>
#include <mutex>

namespace vitrail {

// Opens regions on demand; keeps only those that someone holds.
class RegionCache {
public:
    // Null where the file cannot be used; that is reported once.
    std::shared_ptr<const RegionFile> open(const std::filesystem::path& path);
    // Files opened or refused so far, and why.
    void report(ReadReport& out) const;

private:
    mutable std::mutex mutex_;
    struct Entry {
        std::weak_ptr<const RegionFile> file;
        bool bad = false;
    };
    std::map<std::filesystem::path, Entry> entries_;
    ReadReport report_;
};

// Reads and decodes the chunk in a slot; what was wrong goes into `report`. False where there is no usable chunk.
bool read_chunk(const RegionFile& region, u32 slot, ChunkReader& reader, DecodeContext& context, RawColumn& out,
                ReadReport& report);

} // namespace vitrail
