#include "apps/picture_output.h"

#include "apps/video_file.h"
#include "render/exr.h"

#include <filesystem>
#include <fmt/format.h>

namespace vitrail::apps {

// Depth of the sky: farther than all land, and a number that compositing programs take.
constexpr float kSkyDepth = 1e10f;

static double number_of(i64 fixed) {
    return double(fixed) / double(kFixedOne);
}

std::string PictureOutput::file(u32 frame) const {
    return numbered ? fmt::format("{}{:0{}}{}", before, frame, digits, after) : before;
}

// The place of the one %d, %4d or %04d.
static Result<> find_number(const std::string& name, PictureOutput& output) {
    const auto wrong = [&] {
        return fail(ErrorCode::invalid_argument, fmt::format("frames of a path want one number in --output, such as "
                                                             "frame-%04d.png, or a video (.mp4, .webm, .mkv), not '{}'",
                                                             name));
    };
    const std::size_t percent = name.find('%');
    if (percent == std::string::npos || name.find('%', percent + 1) != std::string::npos) return wrong();
    std::size_t end = percent + 1;
    u32 digits = 0;
    while (end < name.size() && name[end] >= '0' && name[end] <= '9' && digits < 100)
        digits = digits * 10 + u32(name[end++] - '0');
    if (end >= name.size() || name[end] != 'd' || digits > 9) return wrong();
    if (name.find('/', percent) != std::string::npos) return wrong(); // folders are not made
    output.numbered = true;
    output.before = name.substr(0, percent), output.after = name.substr(end + 1), output.digits = std::max(digits, 1u);
    return {};
}

Result<PictureOutput> plan_output(const std::string& name, bool path, bool traced) {
    PictureOutput output;
    output.before = name;
    if (VideoFile::is_video(name))
        output.kind = PictureOutput::Kind::video;
    else if (std::filesystem::path(name).extension() == ".exr")
        output.kind = PictureOutput::Kind::exr;
    if (output.kind == PictureOutput::Kind::exr && !traced)
        return fail(ErrorCode::invalid_argument, "EXR holds traced light: it wants --renderer trace");
    if (output.kind == PictureOutput::Kind::video && !path)
        return fail(ErrorCode::invalid_argument, "a video wants a camera path: --path FILE");
    if (path && output.kind != PictureOutput::Kind::video) VX_TRY(find_number(name, output));
    return output;
}

Result<> write_traced_exr(const std::string& path, trace::Tracer& tracer, u32 width, u32 height,
                          const ExrFacts& facts) {
    render::ExrPicture picture;
    picture.width = width, picture.height = height;
    picture.layers.push_back({{"R", "G", "B"}, tracer.read(trace::Layer::color), true});
    picture.layers.push_back({{"albedo.R", "albedo.G", "albedo.B"}, tracer.read(trace::Layer::albedo), true});
    picture.layers.push_back({{"normal.X", "normal.Y", "normal.Z"}, tracer.read(trace::Layer::normal), true});
    std::vector<float> depth = tracer.read(trace::Layer::distance);
    for (float& d : depth)
        if (!(d > 0)) d = kSkyDepth;
    picture.layers.push_back({{"depth.Z"}, std::move(depth), false});
    picture.texts = {{"software", "vitrail 0.1.0"},
                     {"device", tracer.stats().device},
                     {"denoise", facts.denoised ? "on" : "off"},
                     {"eye", fmt::format("{:.3f},{:.3f},{:.3f}", number_of(facts.pose.eye.at.x),
                                         number_of(facts.pose.eye.at.y), number_of(facts.pose.eye.at.z))}};
    picture.counts = {{"spp", i32(facts.spp)}, {"seed", i32(facts.seed)}, {"bounces", i32(facts.bounces)}};
    picture.numbers = {{"timeOfDay", facts.time},
                       {"yaw", facts.pose.yaw_deg},
                       {"pitch", facts.pose.pitch_deg},
                       {"fieldOfView", facts.pose.fov_deg}};
    return render::write_exr(path, picture);
}

} // namespace vitrail::apps
