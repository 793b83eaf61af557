#include "formats/chunk_walk.h"

#include <fmt/format.h>

namespace vitrail {

std::shared_ptr<const RegionFile> RegionCache::open(const std::filesystem::path& path) {
    std::lock_guard lock(mutex_);
    Entry& entry = entries_[path];
    if (entry.bad) return nullptr;
    if (auto file = entry.file.lock()) return file;
    auto opened = RegionFile::open(path);
    if (!opened) {
        entry.bad = true;
        ++report_.regions_unreadable;
        report_.say(opened.error().message);
        return nullptr;
    }
    auto file = std::make_shared<const RegionFile>(std::move(*opened));
    entry.file = file;
    return file;
}

void RegionCache::report(ReadReport& out) const {
    std::lock_guard lock(mutex_);
    out.region_files += entries_.size();
    out.merge(report_);
}

static std::string flaw_text(u8 flaws) {
    std::string out;
    auto add = [&](SlotFlaw bit, const char* text) {
        if (!(flaws & bit)) return;
        if (!out.empty()) out += ", ";
        out += text;
    };
    add(kSlotOverlaps, "its sectors overlap others");
    add(kSlotBeyondFile, "its sectors reach beyond the file");
    add(kSlotWrongLength, "its length does not fit its sectors");
    add(kSlotWrongMethod, "it is compressed otherwise than it says");
    return out;
}

bool read_chunk(const RegionFile& region, u32 slot, ChunkReader& reader, DecodeContext& context, RawColumn& out,
                ReadReport& report) {
    const ColumnPos at = region.column_of_slot(slot);
    const ChunkReader::Outcome read = reader.read(region, slot);
    out.clear();
    auto say = [&](const std::string& what) { report.say(fmt::format("chunk {}, {}: {}", at.x, at.z, what)); };
    if (!read.usable) {
        ++report.chunks_unreadable;
        say(read.error ? read.error->message : "it is empty");
        return false;
    }
    if (auto decoded = decode_chunk(reader.document.root(), at, context, out); !decoded) {
        ++report.chunks_unreadable;
        say(decoded.error().message);
        return false;
    }
    ++report.chunks;
    if (read.error || read.stream_broken) {
        ++report.chunks_salvaged;
        say(read.error ? fmt::format("{}; what came before it is kept", read.error->message)
                       : "compressed data lacks its end, but the chunk is whole");
    }
    if (read.flaws) {
        ++report.chunks_flawed;
        say(flaw_text(read.flaws));
    }
    if (out.position_disagrees) {
        ++report.chunks_misplaced;
        say("it says it lies elsewhere; kept where the region's table has it");
    }
    report.sections_skipped += out.sections_skipped;
    for (const std::string& problem : out.problems)
        say(problem);
    return true;
}

} // namespace vitrail
