// Pictures that were traced, shown by the passes of the eye.
#include "render_fixture.h"

#include <epoxy/gl.h>
#include <functional>

namespace vitrail::render {

namespace {

class FilmTest : public RenderTest {};

// A film of this size; row 0 is the top.
gfx::Texture film_of(u32 width, u32 height, const std::function<Vec4(u32, u32)>& texel) {
    gfx::Texture texture = gfx::make_texture_2d(GL_RGBA32F, width, height);
    std::vector<Vec4> texels;
    for (u32 y = 0; y < height; ++y)
        for (u32 x = 0; x < width; ++x)
            texels.push_back(texel(x, y));
    glTextureSubImage2D(texture.name(), 0, 0, 0, GLsizei(width), GLsizei(height), GL_RGBA, GL_FLOAT, texels.data());
    return texture;
}

} // namespace

TEST_F(FilmTest, ShowsItsLightUpright) {
    auto renderer = make_renderer();
    // Red on the upper left, a gradient else.
    const gfx::Texture film = film_of(64, 48, [](u32 x, u32 y) {
        return x < 8 && y < 8 ? Vec4{1, 0, 0, 5} : Vec4{float(x) / 64, float(y) / 48, 0.5f, 5};
    });
    renderer->show_film(film.name());
    renderer->set_background(true); // colors stay what they are
    const Image picture = draw(*renderer, bench::SampleScene::frame(64, 48, eye_at(0, 0, 0), 0, 0, 8));
    EXPECT_EQ(picture.at(3, 3)[0], 255);
    EXPECT_EQ(picture.at(3, 3)[1], 0);
    EXPECT_LT(picture.at(60, 3)[1], 90); // the top is dark green
    EXPECT_GT(picture.at(60, 44)[1], 230);
    EXPECT_GT(picture.at(60, 20)[0], picture.at(20, 20)[0]);
}

TEST_F(FilmTest, OutlinesHideBehindWhatItShows) {
    auto renderer = make_renderer();
    auto frame = bench::SampleScene::frame(64, 64, eye_at(0.5, 0.5, 0), 0, 0, 8); // looks along +z
    frame.outlines.push_back({{DimensionId::overworld, {0, 0, 6}}, {{{0, 0, 0}, {1, 1, 1}}}});
    const auto changed = [&](float distance) {
        const gfx::Texture film = film_of(64, 64, [&](u32, u32) { return Vec4{0.6f, 0.6f, 0.6f, distance}; });
        renderer->show_film(film.name());
        renderer->set_background(true);
        const Image with = draw(*renderer, frame);
        u32 count = 0;
        for (u32 i = 0; i < with.pixels.size(); i += 3)
            count += with.pixels[i] < 150;
        renderer->show_film(0);
        return count;
    };
    EXPECT_GT(changed(0), 20u);  // sky
    EXPECT_GT(changed(40), 20u); // far
    EXPECT_EQ(changed(3), 0u);   // a wall before it
}

TEST_F(FilmTest, GivesWayToSectionsAgain) {
    auto renderer = make_renderer();
    const auto frame = bench::SampleScene::frame(32, 32, eye_at(0, 0, 0), 0, -60, 8);
    const Image before = draw(*renderer, frame);
    const gfx::Texture film = film_of(16, 16, [](u32, u32) { return Vec4{4, 0, 0, 1}; });
    renderer->show_film(film.name());
    const Image shown = draw(*renderer, frame);
    EXPECT_GT(shown.at(16, 16)[0], 100);
    EXPECT_LT(shown.at(16, 16)[2], 60);
    renderer->show_film(0);
    renderer->forget_frames();
    EXPECT_EQ(draw(*renderer, frame).pixels, before.pixels);
}

} // namespace vitrail::render
