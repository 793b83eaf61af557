#include "render/passes/sky/sky_pass.h"

#include "scene/cloud_noise.h"

#include <epoxy/gl.h>
#include <fmt/format.h>

namespace vitrail::render {

using scene::SkyState;
using scene::SkyTable;

// The same numbers stand in sky.screen.glsl.
enum Place : GLint { sun_disc = 0, moon_disc = 1, sky_pole = 2, cloud_light = 3, cloud_direction = 4 };

static gfx::Texture make_cloud_texture() {
    using scene::CloudNoise;
    gfx::Texture texture = gfx::make_texture_2d(GL_RG8, CloudNoise::kSide, CloudNoise::kSide, CloudNoise::kLevels);
    const std::vector<u8>& noise = scene::cloud_noise();
    GLint alignment = 4;
    glGetIntegerv(GL_UNPACK_ALIGNMENT, &alignment);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1); // the smallest levels
    for (u32 i = 0; i < CloudNoise::kLevels; ++i) {
        const GLsizei side = GLsizei(CloudNoise::kSide >> i);
        glTextureSubImage2D(texture.name(), GLint(i), 0, 0, side, side, GL_RG, GL_UNSIGNED_BYTE,
                            &noise[std::size_t(CloudNoise::level(i)) * 2]);
    }
    glPixelStorei(GL_UNPACK_ALIGNMENT, alignment);
    gfx::set_filter(texture, GL_LINEAR_MIPMAP_LINEAR, GL_LINEAR, GL_REPEAT);
    return texture;
}

Result<> SkyPass::build(const BuildContext& context) {
    std::vector<std::string> defines{fmt::format("CLOUDS {}", context.effects.sky.clouds)};
    ScreenShader shader{.path = "sky/sky.screen.glsl",
                        .defines = std::move(defines),
                        .formats = {GL_RGBA16F},
                        .area = ScreenArea::background};
    VX_TRY_ASSIGN(day_, ScreenProgram::build(context, shader));
    shader.defines.push_back("NIGHT");
    if (context.effects.sky.stars) shader.defines.push_back("STARS");
    VX_TRY_ASSIGN(night_, ScreenProgram::build(context, shader));
    if (!clouds_) clouds_ = make_cloud_texture();
    for (gfx::Texture& dome : domes_) {
        if (dome) continue;
        // Software OpenGL turns halves into floats one by one, for every pixel whose fog asks the table.
        const u32 format = context.context.software ? GL_RGBA32F : GL_RGBA16F;
        dome = gfx::make_texture_2d(format, SkyTable::kWidth, SkyTable::kHeight);
        gfx::set_filter(dome, GL_LINEAR, GL_LINEAR, GL_CLAMP_TO_EDGE);
    }
    return {};
}

void SkyPass::declare(DeclareContext& c) {
    c.graph.add_pass({"sky", {}, {"color"}, [this](const gfx::PassContext& p) { draw(p); }, "depth"});
}

void SkyPass::prepare(FrameContext& frame) {
    const SkyState& sky = frame.frame->sky;
    if (sky.time != dome_time_ || sky.moon_phase != dome_phase_) {
        dome_ = (dome_ + 1) % u32(domes_.size());
        dome_time_ = sky.time, dome_phase_ = sky.moon_phase;
        static_assert(sizeof(Vec3) == 12);
        glTextureSubImage2D(domes_[dome_].name(), 0, 0, 0, SkyTable::kWidth, SkyTable::kHeight, GL_RGB, GL_FLOAT,
                            sky.dome.texels);
    }
    glBindTextureUnit(u32(Unit::sky), domes_[dome_].name());
    glBindSampler(u32(Unit::sky), 0);
}

void SkyPass::draw(const gfx::PassContext& p) const {
    const SkyState& sky = frame_->frame->sky;
    // Stars fade and the moon sets before the program changes: nobody sees it change.
    const bool night = sky.stars > 0 || sky.moon_direction.y > -0.15f;
    const ScreenProgram& program = night ? night_ : day_;
    const auto set = [&](Place place, Vec3 v, float w) { glProgramUniform4f(program.name(), place, v.x, v.y, v.z, w); };
    constexpr float kEighth = 0.785398163f;
    set(sun_disc, sky.sun_disc, 0);
    if (night) {
        set(moon_disc, sky.moon_disc, float(sky.moon_phase) * kEighth);
        set(sky_pole, sky.pole, sky.star_turn);
    }
    if (frame_->effects->sky.clouds != i32(Clouds::off)) {
        set(cloud_light, sky.cloud_light, 0);
        set(cloud_direction, sky.cloud_direction, 0);
    }
    glBindTextureUnit(u32(Unit::clouds), clouds_.name());
    program.run(p, frame_->plain_array, {"color"}, {});
}

u64 SkyPass::gpu_bytes() const {
    return clouds_.bytes() + domes_[0].bytes() * domes_.size();
}

} // namespace vitrail::render
