// Shaders that change while the program runs.
#include "render_fixture.h"

#include <chrono>
#include <fstream>
#include <thread>

namespace vitrail::render {

namespace fs = std::filesystem;

class ReloadTest : public RenderTest {
protected:
    void SetUp() override {
        RenderTest::SetUp();
        folder_ = fs::temp_directory_path() / fmt::format("vitrail_shaders_{}", getpid());
        fs::remove_all(folder_);
        fs::copy(fs::path(VITRAIL_SOURCE_DIR) / "src/render/passes", folder_, fs::copy_options::recursive);
    }
    void TearDown() override {
        std::error_code ignored;
        fs::remove_all(folder_, ignored);
        RenderTest::TearDown();
    }
    // Writes the file with one text replaced, a second newer each time, and waits until the renderer looks again.
    void edit(const std::string& path, const std::string& from, const std::string& to) {
        std::ifstream in(folder_ / path);
        std::string text(std::istreambuf_iterator<char>(in), {});
        const std::size_t at = text.find(from);
        ASSERT_NE(at, std::string::npos) << from;
        text.replace(at, from.size(), to);
        std::ofstream(folder_ / path) << text;
        fs::last_write_time(folder_ / path, fs::last_write_time(folder_ / path) + std::chrono::seconds(++edits_));
        std::this_thread::sleep_for(std::chrono::milliseconds(520));
    }
    fs::path folder_;
    int edits_ = 0;
};

TEST_F(ReloadTest, AnEditShowsAndABrokenOneIsTold) {
    Result<std::unique_ptr<Renderer>> made =
        Renderer::create({.effects = preset_effects(Preset::low), .shader_folder = folder_.string()});
    ASSERT_TRUE(made) << made.error().message;
    Renderer& renderer = **made;
    const auto frame = bench::SampleScene::frame(32, 32, eye_at(0, 0, 0), 0, -40, 8);
    const Image plain = draw(renderer, frame);
    EXPECT_EQ(renderer.shader_error(), "");
    const std::string end = "put(vec4(encoded, 1.0));", red = "put(vec4(1.0, 0.0, 0.0, 1.0));";
    edit("tonemap/tonemap.screen.glsl", end, red);
    const Image edited = draw(renderer, frame);
    EXPECT_EQ(renderer.shader_error(), "");
    EXPECT_NE(edited.pixels, plain.pixels);
    EXPECT_EQ(edited.at(16, 16)[0], 255);
    EXPECT_EQ(edited.at(16, 16)[2], 0);
    // What does not build: the program before it stays in use, and one is told where the mistake is.
    edit("tonemap/tonemap.screen.glsl", red, "put(nonsense);");
    EXPECT_EQ(draw(renderer, frame).pixels, edited.pixels);
    EXPECT_NE(renderer.shader_error().find("tonemap"), std::string::npos) << renderer.shader_error();
    EXPECT_NE(renderer.shader_error().find("nonsense"), std::string::npos) << renderer.shader_error();
    EXPECT_EQ(draw(renderer, frame).pixels, edited.pixels);
    errors_before_ = gfx::debug_error_count(); // the driver's complaint was wanted
    // Mended, it is as at first; files that others include count too.
    edit("tonemap/tonemap.screen.glsl", "put(nonsense);", end);
    EXPECT_EQ(draw(renderer, frame).pixels, plain.pixels);
    EXPECT_EQ(renderer.shader_error(), "");
    edit("common/tone.glsl", "vec3 filmic(vec3 c) {", "vec3 filmic(vec3 c) { c = vec3(0.0);");
    EXPECT_EQ(draw(renderer, frame).at(16, 16)[1], 0);
}

TEST_F(ReloadTest, AFolderWithoutShadersIsAnError) {
    fs::remove(folder_ / "tonemap/tonemap.screen.glsl");
    const auto made = Renderer::create({.shader_folder = folder_.string()});
    ASSERT_FALSE(made);
    EXPECT_NE(made.error().message.find("tonemap/tonemap.screen.glsl"), std::string::npos) << made.error().message;
}

} // namespace vitrail::render
