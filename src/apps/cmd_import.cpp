#include "apps/commands.h"

#include "base/clock.h"
#include "base/log.h"
#include "formats/count.h"
#include "jobs/thread_pool.h"
#include "pipeline/import.h"
#include "pipeline/store_sink.h"
#include "script/content_loader.h"
#include "store/world_records.h"
#include "world/block_registry.h"

#include <cstdio>
#include <filesystem>
#include <fmt/format.h>
#include <mutex>
#include <unistd.h>

namespace vitrail::apps {

namespace fs = std::filesystem;

namespace {

// One line on standard error, drawn again at most ten times a second; nothing where that is no terminal.
class ProgressBar {
public:
    explicit ProgressBar(bool quiet) : on_(!quiet && isatty(STDERR_FILENO)) {}
    ~ProgressBar() {
        if (drawn_) std::fputs("\r\033[K", stderr);
    }
    void show(const ImportProgress& p) {
        if (!on_) return;
        std::lock_guard lock(mutex_);
        const u64 now = now_ns();
        if (drawn_ && now - last_ns_ < 100'000'000) return;
        last_ns_ = now;
        drawn_ = true;
        const double part = p.rows_all ? double(p.rows_done) / double(p.rows_all) : 0;
        const int width = 40, full = int(part * width);
        fmt::print(stderr, "\r[{}{}] {:3.0f} %  {} columns", std::string(std::size_t(full), '#'), std::string(std::size_t(width - full), '.'),
                   part * 100, p.columns);
        std::fflush(stderr);
    }

private:
    bool on_, drawn_ = false;
    u64 last_ns_ = 0;
    std::mutex mutex_;
};

Result<> run_count(const ImportOptions& options) {
    VX_TRY(check_writable(options.count_file));
    VX_TRY_ASSIGN(const WorldSource source, open_world_source(options.source));
    ThreadPool pool(default_worker_count());
    ProgressBar bar(options.quiet);
    const CountReport report =
        count_world(source, pool, [&](u64 done, u64 all) { bar.show({done, all, 0}); });
    if (report.counts.empty())
        return fail(ErrorCode::damaged, fmt::format("{}: no chunk in it can be read", options.source));
    VX_TRY(write_file(options.count_file, counts_to_json(report.counts)));
    fmt::print("{} blocks of {} states in {} sections of {} chunks, {:.2f} s\n", report.voxels, report.counts.size(),
               report.sections, report.read.chunks, report.seconds);
    for (const std::string& line : report.read.lines) fmt::print("  {}\n", line);
    if (report.read.problems > report.read.lines.size())
        fmt::print("  and {} problems more\n", report.read.problems - report.read.lines.size());
    return {};
}

void remove_store(const fs::path& folder) {
    std::error_code ignored;
    for (const char* name : {"world.sqlite", "world.sqlite-wal", "world.sqlite-shm", "lock"}) fs::remove(folder / name, ignored);
}

// Good where the folder holds nothing but an import that was killed. Errors: a world is there.
Result<> check_unfinished(const std::string& folder) {
    const auto records = WorldRecords::open(folder, std::make_shared<BlockRegistry>(), {.read_only = true});
    if (!records && records.error().code == ErrorCode::not_found) return {}; // killed before its store had a table
    if (!records) return tl::unexpected(records.error());
    VX_TRY_ASSIGN(const auto level, (*records)->load_level());
    if (level && level->unfinished) return {};
    VX_TRY_ASSIGN(const auto dimensions, (*records)->load_dimensions());
    if (!level && dimensions.empty() && (*records)->damage().empty()) return {}; // killed before its first record
    return fail(ErrorCode::invalid_argument, fmt::format("{} holds a world already: an import fills a new one", folder));
}

} // namespace

Result<> run_import(const ImportOptions& options) {
    if (!options.count_file.empty()) return run_count(options);
    if (options.world.empty()) return fail(ErrorCode::invalid_argument, "import wants --world DIR, or --count FILE.json");
    const bool unfinished = has_sqlite_store(options.world);
    if (unfinished) VX_TRY(check_unfinished(options.world));
    // Looked at before a folder is made, so that a wrong source leaves nothing behind.
    {
        VX_TRY_ASSIGN(const auto source, open_world_source(options.source));
        (void)source;
    }
    VX_TRY_ASSIGN(const Content content, load_base_content());
    const auto& registry = content.registry;
    std::error_code error;
    const bool existed = fs::exists(options.world, error);
    if (error) return fail(ErrorCode::io, fmt::format("world {}: {}", options.world, error.message()));
    if (unfinished) {
        // Opened for writing, it is ours alone: nobody is filling it now.
        VX_TRY_ASSIGN(const auto held, WorldRecords::open(options.world, registry, {}));
        log_info(fmt::format("{} holds an import that did not end: beginning anew", options.world));
    }
    if (unfinished) remove_store(options.world);
    const std::atomic<bool>& stop = stop_on_signals(); // before the first byte is written
    Result<ImportReport> report = fail(ErrorCode::io, "");
    {
        const auto records = WorldRecords::open(options.world, registry, {.create = true});
        if (records) {
            StoreSink sink(**records, {.stop = &stop});
            ThreadPool pool(default_worker_count());
            ProgressBar bar(options.quiet);
            report = import_world(options.source, sink, pool, [&](const ImportProgress& p) { bar.show(p); });
        } else {
            report = tl::unexpected(records.error());
            if (report.error().code == ErrorCode::busy) return tl::unexpected(report.error()); // another's, not to be removed
        }
    }
    if (!report || report->columns == 0) {
        std::error_code ignored;
        if (!existed) fs::remove_all(options.world, ignored);
        else remove_store(options.world);
        if (!report) return tl::unexpected(report.error());
        return fail(ErrorCode::damaged, fmt::format("{}: no chunk in it can be read", options.source));
    }
    fmt::print("{}\n", import_summary(*report));
    return {};
}

} // namespace vitrail::apps
