// Import of a whole region into a fresh store: decoding, conversion, encoding, committing.
#include "bench/harness.h"
#include "pipeline/import.h"
#include "pipeline/store_sink.h"

#include <cstdlib>
#include <filesystem>
#include <unistd.h>

namespace vitrail {

namespace fs = std::filesystem;

static fs::path fixture(const char* version) {
    const char* given = std::getenv("VITRAIL_FIXTURES");
    const fs::path root = given ? fs::path(given) : fs::path(VITRAIL_SOURCE_DIR) / ".." / "shared" / "fixtures";
    return root / "worlds" / "anvil-1.8-to-1.21" / version;
}

// Takes what is given, so that only reading and conversion are timed.
namespace {
class NoSink : public ImportSink {
public:
    StateTable& states() override { return table_; }
    Result<BiomeId> biome(std::string_view name) override { return biomes_.intern(name); }
    Result<> level(const LevelInfo&, const std::string&) override { return {}; }
    Result<> dimension(const DimensionInfo&) override { return {}; }
    Result<> put_columns(std::vector<ImportedColumn> batch) override {
        bench::keep(batch);
        return {};
    }
    Result<> finish() override { return {}; }

private:
    StateTable table_{std::make_shared<BlockRegistry>()};
    BiomeTable biomes_;
};
} // namespace

static void bench_import(bench::Context& c, const char* version, double columns, bool store) {
    const fs::path source = fixture(version);
    if (!fs::exists(source)) return c.skip("no fixture " + source.string());
    const fs::path folder = fs::temp_directory_path() / ("vitrail_bench_import_" + std::to_string(::getpid()));
    ThreadPool pool(default_worker_count());
    c.measure(
        columns, [&] { fs::remove_all(folder); },
        [&] {
            if (!store) {
                NoSink sink;
                if (!import_world(source, sink, pool)) c.skip("import failed");
                return;
            }
            auto records = WorldRecords::open(folder.string(), std::make_shared<BlockRegistry>(), {.create = true});
            if (!records) return c.skip(records.error().message);
            StoreSink sink(**records);
            if (!import_world(source, sink, pool)) c.skip("import failed");
        });
    fs::remove_all(folder);
}

void register_land_benches(bench::Suite& suite);

} // namespace vitrail

void register_pipeline_benches(vitrail::bench::Suite& suite) {
    vitrail::register_land_benches(suite);
    using vitrail::bench::Context;
    // Only columns that hold blocks count: half-made ones without any are left out of worlds.
    suite.add("import.anvil", "/s", "chunk columns, 1.14.4 region (299, all full) into a fresh store, all cores",
              [](Context& c) { vitrail::bench_import(c, "1.14.4", 299, true); });
    suite.add("import.anvil_modern", "/s",
              "chunk columns, 1.19.4 region (196 of its 529) into a fresh store, all cores",
              [](Context& c) { vitrail::bench_import(c, "1.19.4", 196, true); });
    suite.add("import.anvil_old", "/s", "chunk columns, 1.9 region (326, numeric ids) into a fresh store, all cores",
              [](Context& c) { vitrail::bench_import(c, "1.9", 326, true); });
    suite.add("import.anvil_no_store", "/s", "chunk columns, 1.14.4 region, read and converted only",
              [](Context& c) { vitrail::bench_import(c, "1.14.4", 299, false); });
}
