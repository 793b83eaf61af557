// ReadReport: what a reader of a Minecraft world met: counts, and the first reasons in words.
#pragma once

#include "base/types.h"

#include <string>
#include <vector>

namespace vitrail {

struct ReadReport {
    static constexpr std::size_t kLines = 20;
    u64 region_files = 0, regions_unreadable = 0;
    u64 chunks = 0;            // decoded, wholly or in part
    u64 chunks_unreadable = 0; // in a region's table, but nothing could be read
    u64 chunks_salvaged = 0;   // of `chunks`: the stream was damaged or cut, what came before the break is kept
    u64 chunks_misplaced = 0;  // of `chunks`: their own position disagrees with their slot, which was believed
    u64 chunks_flawed = 0;     // of `chunks`: the region's table or lengths are wrong for them
    u64 sections_skipped = 0;
    u64 problems = 0; // all reasons met; the first kLines of them are in `lines`
    std::vector<std::string> lines;

    void say(std::string line) {
        ++problems;
        if (lines.size() < kLines) lines.push_back(std::move(line));
    }
    void merge(const ReadReport& o) {
        region_files += o.region_files, regions_unreadable += o.regions_unreadable;
        chunks += o.chunks, chunks_unreadable += o.chunks_unreadable, chunks_salvaged += o.chunks_salvaged;
        chunks_misplaced += o.chunks_misplaced, chunks_flawed += o.chunks_flawed,
            sections_skipped += o.sections_skipped;
        problems += o.problems;
        for (const std::string& line : o.lines)
            if (lines.size() < kLines) lines.push_back(line);
    }
    bool clean() const { return problems == 0; }
};

} // namespace vitrail
