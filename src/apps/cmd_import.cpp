#include "apps/commands.h"

#include "base/clock.h"
#include "formats/count.h"
#include "jobs/thread_pool.h"
#include "pipeline/import.h"
#include "pipeline/store_sink.h"
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

} // namespace

Result<> run_import(const ImportOptions& options) {
    if (!options.count_file.empty()) return run_count(options);
    if (options.world.empty()) return fail(ErrorCode::invalid_argument, "import wants --world DIR, or --count FILE.json");
    if (has_sqlite_store(options.world))
        return fail(ErrorCode::invalid_argument, fmt::format("{} holds a world already: an import fills a new one", options.world));
    // Looked at before a folder is made, so that a wrong source leaves nothing behind.
    {
        VX_TRY_ASSIGN(const auto source, open_world_source(options.source));
        (void)source;
    }
    VX_TRY_ASSIGN(const auto registry, load_base_content());
    const bool existed = fs::exists(options.world);
    Result<ImportReport> report = fail(ErrorCode::io, "");
    {
        VX_TRY_ASSIGN(const auto records, WorldRecords::open(options.world, registry, {.create = true}));
        StoreSink sink(*records);
        ThreadPool pool(default_worker_count());
        ProgressBar bar(options.quiet);
        report = import_world(options.source, sink, pool, [&](const ImportProgress& p) { bar.show(p); });
    }
    if (!report || report->columns == 0) {
        std::error_code ignored;
        if (!existed) fs::remove_all(options.world, ignored);
        else for (const char* name : {"world.sqlite", "world.sqlite-wal", "world.sqlite-shm", "lock"}) fs::remove(fs::path(options.world) / name, ignored);
        if (!report) return tl::unexpected(report.error());
        return fail(ErrorCode::damaged, fmt::format("{}: no chunk in it can be read", options.source));
    }
    fmt::print("{}\n", import_summary(*report));
    return {};
}

} // namespace vitrail::apps
