// Imports of the fixtures: what was counted as stored is there after the import.
#include "formats/count.h"
#include "formats/fixtures.h"
#include "formats/legacy_ids.h"
#include "pipeline/import.h"
#include "pipeline/store_sink.h"

#include <filesystem>
#include <gtest/gtest.h>
#include <map>
#include <mutex>
#include <unistd.h>

namespace vitrail {
namespace {

namespace fs = std::filesystem;

// Keeps all in memory.
struct MemorySink : ImportSink {
    StateTable table{std::make_shared<BlockRegistry>()};
    BiomeTable biomes;
    std::mutex mutex;
    LevelInfo seen_level;
    std::map<std::string, DimensionInfo> dimensions;
    std::vector<ImportedColumn> columns;
    bool finished = false;
    i64 fail_after = -1; // columns until put_columns fails

    StateTable& states() override { return table; }
    Result<BiomeId> biome(std::string_view name) override { return biomes.intern(name); }
    Result<> level(const LevelInfo& l, const std::string&) override {
        seen_level = l;
        return {};
    }
    Result<> dimension(const DimensionInfo& d) override {
        dimensions[d.name] = d;
        return {};
    }
    Result<> put_columns(std::vector<ImportedColumn> batch) override {
        std::lock_guard lock(mutex);
        for (auto& c : batch)
            columns.push_back(std::move(c));
        if (fail_after >= 0 && i64(columns.size()) > fail_after) return fail(ErrorCode::io, "disk is full");
        return {};
    }
    Result<> finish() override {
        finished = true;
        return {};
    }
    // Non-air blocks by state, from the chunks themselves.
    std::map<std::string, u64> count() const {
        std::vector<u64> by_id(table.size());
        std::array<StateId, kChunkVolume> states;
        for (const auto& column : columns)
            for (const auto& part : column.chunks) {
                part.chunk->blocks.unpack(states);
                for (const StateId id : states)
                    ++by_id[u32(id)];
            }
        std::map<std::string, u64> out;
        for (u32 id = 1; id < by_id.size(); ++id)
            if (by_id[id]) out[table.info(StateId(id)).state.to_string()] = by_id[id];
        return out;
    }
};

std::map<std::string, u64> stored_counts(const fs::path& source) {
    ThreadPool pool(1);
    auto world = open_world_source(source);
    EXPECT_TRUE(world);
    auto counts = count_world(*world, pool).counts;
    counts.erase("minecraft:air");
    return counts;
}

TEST(Import, KeepsEveryNamedStateOfTheFixtures) {
    const fs::path folder = test::fixtures() / "worlds" / "anvil-1.8-to-1.21";
    VX_NEED_FIXTURE(folder);
    for (const char* version : {"1.13.2", "1.14.4", "1.16", "1.17.1", "1.18.2", "1.19.4", "1.20.6", "1.21.1"}) {
        MemorySink sink;
        ThreadPool pool(1);
        const auto report = import_world(folder / version, sink, pool);
        ASSERT_TRUE(report) << report.error().message;
        EXPECT_EQ(report->read.chunks_unreadable, 0u);
        EXPECT_TRUE(sink.finished);
        EXPECT_EQ(report->columns, sink.columns.size());
        const auto want = stored_counts(folder / version);
        EXPECT_EQ(sink.count(), want) << version;
        EXPECT_EQ(report->counts, want) << version;
    }
}

TEST(Import, GivesOldNumbersModernNamesWithoutLoss) {
    const fs::path folder = test::fixtures() / "worlds" / "anvil-1.8-to-1.21";
    VX_NEED_FIXTURE(folder);
    for (const char* version : {"1.8.9", "1.9", "1.11.2", "1.12.2", "../mcregion/PyTestWorld"}) {
        MemorySink sink;
        ThreadPool pool(1);
        const auto report = import_world(folder / version, sink, pool);
        ASSERT_TRUE(report) << report.error().message;
        // By block name without properties both sides agree.
        auto bare = [](const std::string& text) { return text.substr(0, text.find('[')); };
        std::map<std::string, u64> want, got;
        for (const auto& [name, n] : stored_counts(folder / version)) {
            u32 id = 0, meta = 0;
            ASSERT_EQ(std::sscanf(name.c_str(), "id:%u:%u", &id, &meta), 2);
            if (id == 0) continue;
            std::string modern = legacy_state(LegacyCode(id << 4 | meta)).name;
            if (id == 175 && meta >= 8) modern = "upper half";
            want[modern] += n;
        }
        for (const auto& [name, n] : sink.count()) {
            EXPECT_EQ(name.find("legacy:"), std::string::npos) << name;
            std::string modern = bare(name);
            if (name.find("half=upper") != name.npos && name.find("_door") == name.npos) modern = "upper half";
            got[modern] += n;
        }
        EXPECT_EQ(got, want) << version;
    }
}

TEST(Import, IsTheSameForEveryNumberOfThreads) {
    const fs::path source = test::fixtures() / "worlds" / "mcregion" / "PyTestWorld";
    VX_NEED_FIXTURE(source);
    std::map<std::string, u64> first;
    for (unsigned threads : {0u, 1u, 3u}) {
        MemorySink sink;
        ThreadPool pool(threads);
        ASSERT_TRUE(import_world(source, sink, pool));
        EXPECT_EQ(sink.columns.size(), 445u);
        if (first.empty()) first = sink.count();
        EXPECT_EQ(sink.count(), first);
    }
}

TEST(Import, TellsLevelAndDimensions) {
    const fs::path source = test::fixtures() / "worlds" / "mcregion" / "PyTestWorld";
    VX_NEED_FIXTURE(source);
    MemorySink sink;
    ThreadPool pool(1);
    ASSERT_TRUE(import_world(source, sink, pool));
    EXPECT_TRUE(sink.seen_level.found);
    EXPECT_EQ(sink.seen_level.name, "PyTestWorld");
    EXPECT_TRUE(sink.seen_level.spawn);
    ASSERT_TRUE(sink.dimensions.contains("minecraft:overworld"));
    EXPECT_EQ(sink.dimensions["minecraft:overworld"].min_y, 0);
    EXPECT_EQ(sink.dimensions["minecraft:overworld"].max_y, 256);
}

TEST(Import, EndsWithTheSinksError) {
    const fs::path source = test::fixtures() / "worlds" / "mcregion" / "PyTestWorld";
    VX_NEED_FIXTURE(source);
    MemorySink sink;
    sink.fail_after = 40;
    ThreadPool pool(1);
    const auto report = import_world(source, sink, pool);
    ASSERT_FALSE(report);
    EXPECT_EQ(report.error().message, "disk is full");
    EXPECT_FALSE(sink.finished);
}

TEST(Import, SkipsDamageAndGoesOn) {
    const fs::path folder = test::fixtures() / "corrupt";
    VX_NEED_FIXTURE(folder);
    for (const auto& entry : fs::directory_iterator(folder)) {
        if (entry.path().extension() != ".mca") continue;
        MemorySink sink;
        ThreadPool pool(1);
        const auto report = import_world(entry.path(), sink, pool);
        ASSERT_TRUE(report);
        EXPECT_GT(report->columns, 0u) << entry.path();
        EXPECT_FALSE(import_summary(*report).empty());
        auto stored = stored_counts(entry.path());
        if (!stored.empty() && stored.begin()->first.starts_with("minecraft:")) {
            EXPECT_EQ(sink.count(), stored) << entry.path();
        }
    }
}

TEST(StoreSink, AnImportThatDoesNotEndSaysSo) {
    const fs::path folder = fs::temp_directory_path() / ("vitrail_unfinished_" + std::to_string(::getpid()));
    fs::remove_all(folder);
    for (const bool to_the_end : {false, true}) {
        auto records = WorldRecords::open(folder.string(), std::make_shared<BlockRegistry>(), {.create = true});
        ASSERT_TRUE(records) << records.error().message;
        {
            StoreSink sink(**records);
            LevelInfo info;
            info.name = "Begun";
            ASSERT_TRUE(sink.level(info, "somewhere"));
            if (to_the_end) ASSERT_TRUE(sink.finish());
        }
        const auto level = (*records)->load_level();
        ASSERT_TRUE(level && *level);
        EXPECT_EQ((*level)->unfinished, !to_the_end);
        EXPECT_EQ((*level)->source, "somewhere");
    }
    fs::remove_all(folder);
}

TEST(StoreSink, StopsWhenToldTo) {
    const fs::path folder = fs::temp_directory_path() / ("vitrail_stopped_" + std::to_string(::getpid()));
    fs::remove_all(folder);
    {
        auto records = WorldRecords::open(folder.string(), std::make_shared<BlockRegistry>(), {.create = true});
        ASSERT_TRUE(records) << records.error().message;
        std::atomic<bool> stop{false};
        StoreSink sink(**records, {.stop = &stop});
        ASSERT_TRUE(sink.level({}, "somewhere"));
        EXPECT_TRUE(sink.put_columns({}));
        stop = true;
        EXPECT_FALSE(sink.put_columns({}));
    }
    fs::remove_all(folder);
}

TEST(StoreSink, KeepsAnImportInAWorldFolder) {
    const fs::path source = test::fixtures() / "worlds" / "anvil-1.8-to-1.21" / "1.20.6";
    VX_NEED_FIXTURE(source);
    const fs::path folder = fs::temp_directory_path() / ("vitrail_import_" + std::to_string(::getpid()));
    fs::remove_all(folder);
    {
        auto records = WorldRecords::open(folder.string(), std::make_shared<BlockRegistry>(), {.create = true});
        ASSERT_TRUE(records) << records.error().message;
        StoreSink sink(**records);
        ThreadPool pool(1);
        const auto report = import_world(source, sink, pool);
        ASSERT_TRUE(report) << report.error().message;
        EXPECT_EQ(report->counts, stored_counts(source));
    }
    auto records = WorldRecords::open(folder.string(), std::make_shared<BlockRegistry>(), {});
    ASSERT_TRUE(records);
    const auto level = (*records)->load_level();
    ASSERT_TRUE(level && *level);
    const auto columns = (*records)->list_columns(DimensionId::overworld);
    ASSERT_TRUE(columns);
    std::map<std::string, u64> got;
    std::array<StateId, kChunkVolume> states;
    for (const ColumnPos at : *columns) {
        const auto parts = (*records)->load_column_chunks(DimensionId::overworld, at);
        ASSERT_TRUE(parts);
        for (const auto& part : *parts) {
            part.chunk->blocks.unpack(states);
            for (const StateId id : states)
                if (id != StateId::air) ++got[(*records)->states().info(id).state.to_string()];
        }
    }
    EXPECT_EQ(got, stored_counts(source));
    fs::remove_all(folder);
}

} // namespace
} // namespace vitrail
