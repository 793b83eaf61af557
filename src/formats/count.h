// Counts the block states of a Minecraft world as stored, without importing it.
#pragma once

#include "formats/level_dat.h"
#include "formats/read_report.h"
#include "jobs/thread_pool.h"

#include <functional>
#include <map>
#include <string>

namespace vitrail {

struct CountReport {
    // id:ID:META for blocks before 1.13, minecraft:name[a=b,...] after. Air counts; so do half-made chunks.
    std::map<std::string, u64> counts;
    u64 sections = 0, voxels = 0;
    ReadReport read;
    double seconds = 0;
};

// progress(done, all) in region rows of 32 chunks; from any worker.
CountReport count_world(const WorldSource& source, ThreadPool& pool,
                        const std::function<void(u64, u64)>& progress = {});

// One JSON object, name to number.
std::string counts_to_json(const std::map<std::string, u64>& counts);

} // namespace vitrail
