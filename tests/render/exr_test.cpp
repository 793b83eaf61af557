// What is written as EXR is what any reader of the format finds.
#include "render/exr.h"

#include <ImfChannelList.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <unistd.h>

namespace vitrail::render {
namespace {

namespace fs = std::filesystem;

struct ExrTest : testing::Test {
    fs::path folder = fs::temp_directory_path() / ("vitrail_exr_" + std::to_string(getpid()));
    void SetUp() override { fs::create_directories(folder); }
    void TearDown() override { fs::remove_all(folder); }
    std::string file(const char* name) const { return (folder / name).string(); }
};

ExrPicture two_layers(u32 width, u32 height) {
    ExrPicture picture;
    picture.width = width, picture.height = height;
    ExrLayer color{{"R", "G", "B"}, {}, true}, depth{{"depth.Z"}, {}, false};
    for (u32 i = 0; i < width * height; ++i) {
        for (u32 c = 0; c < 3; ++c)
            color.values.push_back(float(i * 3 + c) / 16);
        depth.values.push_back(1000.0f / 3.0f * float(i));
    }
    picture.layers = {color, depth};
    picture.texts = {{"device", "CPU"}};
    picture.numbers = {{"timeOfDay", 6000.5f}};
    picture.counts = {{"spp", 64}, {"seed", 2'000'000'000}};
    return picture;
}

const ExrLayer& channel(const ExrPicture& picture, const std::string& name) {
    for (const ExrLayer& layer : picture.layers)
        if (layer.names[0] == name) return layer;
    static const ExrLayer none;
    ADD_FAILURE() << "no channel " << name;
    return none;
}

TEST_F(ExrTest, SurvivesARoundTrip) {
    const ExrPicture picture = two_layers(7, 5);
    const auto written = write_exr(file("a.exr"), picture);
    ASSERT_TRUE(written) << written.error().message;
    EXPECT_FALSE(fs::exists(file("a.exr.part")));
    const auto read = read_exr(file("a.exr"));
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(read->width, 7u);
    EXPECT_EQ(read->height, 5u);
    ASSERT_EQ(read->layers.size(), 4u);
    EXPECT_TRUE(channel(*read, "G").half);
    EXPECT_FALSE(channel(*read, "depth.Z").half);
    for (u32 i = 0; i < 35; ++i) {
        EXPECT_EQ(channel(*read, "R").values[i], float(i * 3) / 16); // these fit into 16 bits
        EXPECT_EQ(channel(*read, "B").values[i], float(i * 3 + 2) / 16);
        EXPECT_EQ(channel(*read, "depth.Z").values[i], picture.layers[1].values[i]);
    }
    EXPECT_EQ(read->texts.at("device"), "CPU");
    EXPECT_EQ(read->numbers.at("timeOfDay"), 6000.5f);
    EXPECT_EQ(read->counts.at("spp"), 64);
    EXPECT_EQ(read->counts.at("seed"), 2'000'000'000);
}

// The library's own words about the file, without ours in between.
TEST_F(ExrTest, IsAsOthersReadIt) {
    ASSERT_TRUE(write_exr(file("a.exr"), two_layers(16, 9)));
    Imf::InputFile in(file("a.exr").c_str());
    EXPECT_TRUE(in.isComplete());
    EXPECT_EQ(in.header().displayWindow().max.x, 15);
    EXPECT_EQ(in.header().dataWindow().max.y, 8);
    ASSERT_NE(in.header().channels().findChannel("depth.Z"), nullptr);
    EXPECT_EQ(in.header().channels().findChannel("R")->type, Imf::HALF);
}

TEST_F(ExrTest, HoldsWhatHalvesCannot) {
    ExrPicture picture = two_layers(2, 1);
    picture.layers[0].values = {1e9f, -1e9f, std::nanf(""), 1e-12f, INFINITY, 0.5f};
    ASSERT_TRUE(write_exr(file("a.exr"), picture));
    const auto read = read_exr(file("a.exr"));
    ASSERT_TRUE(read);
    EXPECT_EQ(channel(*read, "R").values, (std::vector<float>{65504, 0}));
    EXPECT_EQ(channel(*read, "G").values, (std::vector<float>{-65504, 65504}));
    EXPECT_EQ(channel(*read, "B").values, (std::vector<float>{0, 0.5f}));
}

TEST_F(ExrTest, SaysWhatIsWrong) {
    EXPECT_FALSE(write_exr(file("nowhere/a.exr"), two_layers(2, 2)));
    ExrPicture short_one = two_layers(2, 2);
    short_one.layers[0].values.pop_back();
    EXPECT_FALSE(write_exr(file("a.exr"), short_one));
    EXPECT_TRUE(fs::is_empty(folder));
    EXPECT_FALSE(read_exr(file("none.exr")));
    std::ofstream(file("bad.exr")) << "v/1\x01 nonsense";
    EXPECT_FALSE(read_exr(file("bad.exr")));
}

} // namespace
} // namespace vitrail::render
