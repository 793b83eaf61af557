#include "scene/camera_path.h"

#include <cmath>
#include <gtest/gtest.h>
#include <string>

namespace vitrail::scene {
namespace {

Result<CameraPath> parse(const std::string& text, const CameraMoment& otherwise = {}) {
    return CameraPath::parse({reinterpret_cast<const u8*>(text.data()), text.size()}, otherwise);
}

CameraPath sound(const std::string& text, const CameraMoment& otherwise = {}) {
    auto path = parse(text, otherwise);
    EXPECT_TRUE(path) << path.error().message;
    return path ? *path : CameraPath();
}

TEST(CameraPath, MeetsItsKeysAndRestsOutside) {
    const CameraPath path =
        sound(R"({"keys": [{"seconds": 1, "at": [0, 80, 0], "look": [30, 10], "fov": 70, "time": 6000},
        {"seconds": 2, "at": [10, 84, 5]}, {"seconds": 4, "at": [12, 90, -7], "look": [60, -20], "fov": 40, "time": 8000}]})");
    EXPECT_EQ(path.keys(), 3u);
    EXPECT_EQ(path.seconds(), 4);
    EXPECT_EQ(path.at(2).at, (std::array<double, 3>{10, 84, 5}));
    for (double before : {-5.0, 0.0, 1.0})
        EXPECT_EQ(path.at(before).at, (std::array<double, 3>{0, 80, 0}));
    for (double after : {4.0, 5.0, 1e9}) {
        EXPECT_EQ(path.at(after).at, (std::array<double, 3>{12, 90, -7}));
        EXPECT_EQ(path.at(after).pitch_deg, -20);
        EXPECT_EQ(path.at(after).fov_deg, 40);
    }
    // A key that says nothing of the look lets it go on: halfway in time between the keys that do.
    EXPECT_NEAR(path.at(2.5).yaw_deg, 45, 1e-9);
    EXPECT_NEAR(path.at(2.5).time, 7000, 1e-9);
}

// Speeds on both sides of a key are equal, whatever the times between keys.
TEST(CameraPath, IsSmooth) {
    const CameraPath path = sound(R"({"keys": [{"seconds": 0, "at": [0, 0, 0]}, {"seconds": 1, "at": [4, 1, 0]},
        {"seconds": 4, "at": [9, 3, 5]}, {"seconds": 4.5, "at": [11, 3, 9]}, {"seconds": 9, "at": [11, 0, 30]}]})");
    const double h = 1e-5;
    for (double t : {1.0, 4.0, 4.5})
        for (int axis = 0; axis < 3; ++axis) {
            const auto x = [&](double s) { return path.at(s).at[std::size_t(axis)]; };
            EXPECT_NEAR((x(t + h) - x(t)) / h, (x(t) - x(t - h)) / h, 1e-3) << t << " " << axis;
        }
    // It begins and ends at rest.
    EXPECT_NEAR(path.at(h).at[0] / h, 0, 1e-3);
}

TEST(CameraPath, GoesEvenlyThroughEvenKeys) {
    const CameraPath path = sound(R"({"keys": [{"seconds": 0, "at": [0, 0, 0]}, {"seconds": 1, "at": [2, 0, 0]},
        {"seconds": 2, "at": [4, 0, 0]}, {"seconds": 3, "at": [6, 0, 0]}]})");
    for (double t = 1; t <= 2; t += 0.125)
        EXPECT_NEAR(path.at(t).at[0], 2 * t, 1e-12);
}

// Between equal keys nothing moves, and nothing goes beyond keys that grow.
TEST(CameraPath, RestsAndNeverTurnsBack) {
    const CameraPath path = sound(R"({"keys": [{"seconds": 0, "at": [0, 0, 0]}, {"seconds": 1, "at": [100, 0, 0]},
        {"seconds": 5, "at": [100, 0, 0]}, {"seconds": 5.1, "at": [101, 0, 0]}, {"seconds": 6, "at": [500, 0, 0]}]})");
    for (double t = 1; t <= 5; t += 0.25)
        EXPECT_EQ(path.at(t).at[0], 100);
    double before = 0;
    for (double t = 0; t <= 6; t += 0.01) {
        EXPECT_GE(path.at(t).at[0], before - 1e-9) << t;
        before = path.at(t).at[0];
    }
}

// Numbers stay between their keys, also where they turn.
TEST(CameraPath, NeverShootsOver) {
    const CameraPath path =
        sound(R"({"keys": [{"seconds": 0, "fov": 20, "look": [0, 0]}, {"seconds": 1, "fov": 150, "look": [0, 90]},
        {"seconds": 1.1, "fov": 149, "look": [0, 89]}, {"seconds": 5, "fov": 5, "look": [0, -90]}, {"seconds": 6, "fov": 6}]})");
    for (double t = 0; t < 7; t += 0.003) {
        EXPECT_GE(path.at(t).fov_deg, 5 - 1e-9);
        EXPECT_LE(path.at(t).fov_deg, 150 + 1e-9);
        if (t > 1.1) {
            EXPECT_LE(path.at(t).fov_deg, 149 + 1e-9);
        }
    }
}

TEST(CameraPath, TurnsTheShortestWay) {
    const CameraPath path = sound(
        R"({"keys": [{"seconds": 0, "look": [350, 0]}, {"seconds": 1, "look": [10, 0]}, {"seconds": 2, "look": [-170, 0]}]})");
    EXPECT_LT(std::abs(path.at(0.5).yaw_deg), 10);
    EXPECT_LT(std::abs(path.at(1).yaw_deg - 10), 1e-9);
    EXPECT_NEAR(std::abs(path.at(2).yaw_deg), 170, 1e-9);
}

TEST(CameraPath, TimesOfDayGoOnOverMidnight) {
    const CameraPath path = sound(R"({"keys": [{"seconds": 0, "time": 23000}, {"seconds": 2, "time": 25000}]})");
    EXPECT_NEAR(path.at(1).time, 0, 1e-9);
    EXPECT_NEAR(path.at(2).time, 1000, 1e-9);
}

TEST(CameraPath, TakesTheRestFromElsewhere) {
    CameraMoment otherwise;
    otherwise.at = {5, 6, 7}, otherwise.fov_deg = 33, otherwise.time = 123;
    const CameraPath path = sound(R"({"keys": [{"seconds": 3, "look": [0, 0]}]})", otherwise);
    EXPECT_FALSE(path.has_place());
    EXPECT_EQ(path.at(1).at, otherwise.at);
    EXPECT_EQ(path.at(1).fov_deg, 33);
    EXPECT_EQ(path.at(1).time, 123);
}

TEST(CameraPath, RefusesWhatIsWrong) {
    const std::pair<const char*, const char*> wrong[] = {
        {"", "JSON"},
        {"{", "JSON"},
        {"[]", "keys"},
        {R"({"keys": []})", "without keys"},
        {R"({"keys": [1]})", "key 1"},
        {R"({"keys": [{"at": [0, 0, 0]}]})", "key 1: says no seconds"},
        {R"({"keys": [{"seconds": 0}, {"seconds": 0}]})", "key 2: seconds do not grow"},
        {R"({"keys": [{"seconds": -1}]})", "key 1: seconds"},
        {R"({"keys": [{"seconds": "1"}]})", "key 1: seconds"},
        {R"({"keys": [{"seconds": 0, "at": [0, 0]}]})", "key 1: at"},
        {R"({"keys": [{"seconds": 0, "at": [0, 0, 1e30]}]})", "key 1: at"},
        {R"({"keys": [{"seconds": 0, "at": [0, 0, null]}]})", "key 1: at"},
        {R"({"keys": [{"seconds": 0, "look": 3}]})", "key 1: look"},
        {R"({"keys": [{"seconds": 0, "fov": 180}]})", "key 1: fov"},
        {R"({"keys": [{"seconds": 0, "time": -1}]})", "key 1: time"},
        {R"({"keys": [{"seconds": 0, "fow": 70}]})", "fow"},
    };
    for (const auto& [text, says] : wrong) {
        const auto path = parse(text);
        ASSERT_FALSE(path) << text;
        EXPECT_NE(path.error().message.find(says), std::string::npos) << text << ": " << path.error().message;
    }
    std::string many = R"({"keys": [)";
    for (std::size_t i = 0; i <= CameraPath::kKeysMost; ++i)
        many += std::string(i ? "," : "") + R"({"seconds": )" + std::to_string(i) + "}";
    EXPECT_FALSE(parse(many + "]}"));
}

} // namespace
} // namespace vitrail::scene
