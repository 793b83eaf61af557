// Counts against the independent reader's oracle, and over damaged files.
#include "formats/count.h"
#include "formats/fixtures.h"

#include <fstream>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace vitrail {
namespace {

namespace fs = std::filesystem;

CountReport count(const fs::path& source, unsigned threads = 2) {
    ThreadPool pool(threads);
    auto world = open_world_source(source);
    EXPECT_TRUE(world) << world.error().message;
    return world ? count_world(*world, pool) : CountReport{};
}

void expect_equal(const fs::path& source, const nlohmann::json& oracle, bool sections) {
    const CountReport got = count(source);
    for (const std::string& line : got.read.lines)
        if (line.find("level.dat") == line.npos) ADD_FAILURE() << source << ": " << line;
    EXPECT_EQ(got.read.chunks, oracle["chunks"].get<u64>()) << source;
    EXPECT_EQ(got.read.chunks_unreadable, 0u);
    EXPECT_EQ(got.voxels, oracle["voxels"].get<u64>()) << source;
    if (sections) {
        EXPECT_EQ(got.sections, oracle["sections_decoded"].get<u64>()) << source;
    }
    const auto want = oracle["counts"].get<std::map<std::string, u64>>();
    EXPECT_EQ(got.counts.size(), want.size()) << source;
    int differences = 0;
    for (const auto& [name, n] : want) {
        const auto it = got.counts.find(name);
        const u64 have = it == got.counts.end() ? 0 : it->second;
        if (have != n && ++differences <= 5) ADD_FAILURE() << source << " " << name << ": " << have << ", oracle " << n;
    }
    for (const auto& [name, n] : got.counts)
        if (!want.contains(name) && ++differences <= 5)
            ADD_FAILURE() << source << " " << name << ": " << n << ", oracle none";
    EXPECT_EQ(differences, 0) << source;
}

TEST(Count, EqualsTheOracleOfEveryAnvilFixture) {
    const fs::path folder = test::fixtures() / "worlds" / "anvil-1.8-to-1.21";
    VX_NEED_FIXTURE(folder);
    std::ifstream file(folder / "BLOCK-COUNT-ORACLE.json");
    const auto oracle = nlohmann::json::parse(file);
    ASSERT_EQ(oracle.size(), 12u);
    for (const auto& [version, want] : oracle.items())
        expect_equal(folder / version, want, true);
}

TEST(Count, EqualsTheOracleOfTheMcRegionFixture) {
    const fs::path folder = test::fixtures() / "worlds" / "mcregion";
    VX_NEED_FIXTURE(folder);
    std::ifstream file(folder / "BLOCK-COUNT-ORACLE.json");
    expect_equal(folder / "PyTestWorld", nlohmann::json::parse(file)["PyTestWorld/region"], false);
}

TEST(Count, IsTheSameForEveryNumberOfThreads) {
    const fs::path folder = test::fixtures() / "worlds" / "anvil-1.8-to-1.21" / "1.13.2";
    VX_NEED_FIXTURE(folder);
    EXPECT_EQ(count(folder, 0).counts, count(folder, 3).counts);
}

TEST(Count, SkipsAndCountsWhatIsDamaged) {
    const fs::path folder = test::fixtures() / "corrupt";
    VX_NEED_FIXTURE(folder);
    // An independent strict reader could read 13 of its 20 chunks.
    const CountReport hand_made = count(folder / "twoolie-regiontest.mca");
    EXPECT_GE(hand_made.read.chunks, 13u);
    EXPECT_GT(hand_made.read.problems, 0u);
    EXPECT_LE(hand_made.read.lines.size(), ReadReport::kLines);
    // Every stream lacks its end; the chunks are there.
    const CountReport cut = count(folder / "hephaistos-issue4-r.0.0.mca");
    EXPECT_EQ(cut.read.chunks, 121u);
    EXPECT_EQ(cut.read.chunks_salvaged, 121u);
    EXPECT_GT(cut.voxels, 0u);
    for (const char* name : {"querz-r.0.0.mca", "querz-r.2.2.mca"})
        count(folder / name);
    ThreadPool pool(1);
    EXPECT_FALSE(open_world_source(folder / "invalid_compression.dat"));
    for (const char* name : {"max_depth_reached.dat", "invalid_data_tag.dat", "invalid_compression.dat"}) {
        const auto bytes = read_file(folder / name, 1 << 20);
        ASSERT_TRUE(bytes);
        (void)read_level_dat(*bytes);
    }
}

TEST(Count, WritesOneJsonObject) {
    EXPECT_EQ(counts_to_json({}), "{\n}\n");
    EXPECT_EQ(counts_to_json({{"a\"b", 1}, {"minecraft:air", 2}}), "{\n \"a\\\"b\": 1,\n \"minecraft:air\": 2\n}\n");
}

TEST(WorldSource, SaysInOneLineWhatIsWrongWithASource) {
    for (const char* path : {"/nonexistent/world", "/", "/etc/passwd"}) {
        const auto world = open_world_source(path);
        ASSERT_FALSE(world);
        EXPECT_EQ(world.error().message.find('\n'), std::string::npos);
    }
}

} // namespace
} // namespace vitrail
