#include "formats/count.h"

#include "base/clock.h"
#include "formats/chunk_walk.h"
#include "formats/legacy_ids.h"

#include <atomic>
#include <fmt/format.h>
#include <memory>
#include <mutex>
#include <vector>

namespace vitrail {

namespace {

struct Worker {
    ChunkReader reader;
    DecodeContext context;
    RawColumn column;
    ReadReport report;
    std::vector<u64> by_name, by_code;
    u64 sections = 0;

    void count(const RawSection& section) {
        auto& counts = section.legacy ? by_code : by_name;
        const std::size_t room = section.legacy ? 65536 : context.names.size();
        if (counts.size() < room) counts.resize(room);
        ++sections;
        if (section.indices.empty()) {
            counts[section.palette[0]] += kChunkVolume;
            return;
        }
        u32 histogram[kChunkVolume] = {};
        for (u16 index : section.indices)
            ++histogram[index];
        for (std::size_t i = 0; i < section.palette.size(); ++i)
            counts[section.palette[i]] += histogram[i];
    }
};

} // namespace

CountReport count_world(const WorldSource& source, ThreadPool& pool, const std::function<void(u64, u64)>& progress) {
    const u64 start = now_ns();
    CountReport out;
    std::vector<std::filesystem::path> files;
    for (const SourceDimension& dimension : source.dimensions)
        for (const SourceRegion& region : dimension.regions)
            files.push_back(region.file);

    RegionCache cache;
    std::mutex mutex;
    std::vector<std::unique_ptr<Worker>> workers;
    std::vector<Worker*> free_list;
    std::atomic<u64> done{0};
    const u32 rows = u32(files.size()) * 32;
    pool.parallel_for(rows, [&](u32 row) {
        Worker* worker = nullptr;
        {
            std::lock_guard lock(mutex);
            if (free_list.empty()) {
                workers.push_back(std::make_unique<Worker>());
                workers.back()->context.blocks_only = true;
                free_list.push_back(workers.back().get());
            }
            worker = free_list.back();
            free_list.pop_back();
        }
        if (const auto region = cache.open(files[row / 32]))
            for (u32 slot = row % 32 * 32; slot < (row % 32 + 1) * 32; ++slot)
                if (region->has_chunk(slot) &&
                    read_chunk(*region, slot, worker->reader, worker->context, worker->column, worker->report))
                    for (const RawSection& section : worker->column.sections)
                        worker->count(section);
        {
            std::lock_guard lock(mutex);
            free_list.push_back(worker);
        }
        const u64 n = done.fetch_add(1) + 1;
        if (progress) progress(n, rows);
    });

    for (const std::string& problem : source.problems)
        out.read.say(problem);
    cache.report(out.read);
    for (const auto& worker : workers) {
        for (u32 n = 0; n < worker->by_name.size(); ++n)
            if (worker->by_name[n]) out.counts[std::string(worker->context.names.text(n))] += worker->by_name[n];
        for (u32 n = 0; n < worker->by_code.size(); ++n)
            if (worker->by_code[n]) out.counts[legacy_count_name(LegacyCode(n))] += worker->by_code[n];
        out.sections += worker->sections;
        out.read.merge(worker->report);
    }
    out.voxels = out.sections * kChunkVolume;
    out.seconds = seconds_since(start);
    return out;
}

std::string counts_to_json(const std::map<std::string, u64>& counts) {
    std::string out = "{";
    for (const auto& [name, count] : counts) {
        out += out.size() > 1 ? ",\n \"" : "\n \"";
        for (const char c : name) {
            if (c == '"' || c == '\\')
                out += '\\', out += c;
            else if (u8(c) < 0x20 || u8(c) > 0x7e)
                out += fmt::format("\\u{:04x}", u8(c));
            else
                out += c;
        }
        out += fmt::format("\": {}", count);
    }
    return out + "\n}\n";
}

} // namespace vitrail
