#include "apps/path_frames.h"

#include "apps/commands.h"
#include "apps/video_file.h"

#include <cmath>
#include <fmt/format.h>

namespace vitrail::apps {

constexpr double kFramesMost = 1'000'000;

client::CameraPose pose_of(const scene::CameraMoment& moment, DimensionId dimension) {
    client::CameraPose pose;
    pose.eye = {dimension, world_pos_from_numbers(moment.at[0], moment.at[1], moment.at[2])};
    pose.yaw_deg = float(moment.yaw_deg), pose.pitch_deg = float(moment.pitch_deg);
    pose.fov_deg = float(moment.fov_deg);
    return pose;
}

Result<PathFrames> open_path(const std::string& file, double fps, std::optional<double> seconds,
                             const scene::CameraMoment& otherwise) {
    VX_TRY_ASSIGN(const std::string text, read_text_file(file, 1u << 20));
    auto path = scene::CameraPath::parse({reinterpret_cast<const u8*>(text.data()), text.size()}, otherwise);
    if (!path) return fail(path.error().code, fmt::format("--path {}: {}", file, path.error().message));
    PathFrames frames;
    frames.path = std::move(*path);
    frames.fps = fps;
    const double count = std::max(1.0, std::round(seconds.value_or(frames.path.seconds()) * fps));
    if (count > kFramesMost)
        return fail(ErrorCode::limit, fmt::format("--path {}: {} frames, more than {}", file, count, kFramesMost));
    frames.frames = u32(count);
    return frames;
}

static Result<> draw_frame(client::Still& still, const PathFrames& wanted, u32 frame, const PictureOutput& output,
                           VideoFile* video, const std::atomic<bool>& stop, ProgressLine& progress, TracedStats& stats,
                           client::CameraPose& before) {
    const scene::CameraMoment moment = wanted.path.at(frame / wanted.fps);
    const client::CameraPose pose = pose_of(moment, still.replica().dimension().info().id);
    const float time = float(moment.time);
    const TracedPicture& size = wanted.picture;
    VX_TRY(still.go_to(pose));
    still.set_seconds(float(frame / wanted.fps));
    render::Image image;
    if (wanted.traced) {
        TracedPicture picture = wanted.picture;
        picture.time = time;
        // Where the eye rests, the mean of frames would smear what moves by itself.
        const bool rests =
            pose.eye.at == before.eye.at && pose.yaw_deg == before.yaw_deg && pose.pitch_deg == before.pitch_deg;
        picture.forget = frame == 0 || !picture.denoise || rests;
        if (!picture.denoise) picture.seed += frame; // the noise of all frames would stand still before the land
        VX_TRY(trace_picture(still, pose, picture, stop, progress, stats));
        if (output.kind == PictureOutput::Kind::exr)
            return write_traced_exr(output.file(frame), still.tracer(), size.width, size.height,
                                    {picture.spp, picture.seed, picture.bounces, picture.denoise, time, pose});
        VX_TRY_ASSIGN(image, still.develop(pose, size.width, size.height, time, frame == 0));
    } else {
        if (frame == 0) {
            VX_TRY_ASSIGN(image, still.draw(pose, size.width, size.height, time));
        } else {
            VX_TRY_ASSIGN(image, still.draw_next(pose, size.width, size.height, time));
        }
        progress.step(1);
    }
    before = pose;
    return video ? video->add(image) : render::write_png(output.file(frame), image);
}

Result<TracedStats> render_path(client::Still& still, const PathFrames& wanted, const PictureOutput& output,
                                const std::atomic<bool>& stop) {
    std::unique_ptr<VideoFile> video;
    if (output.kind == PictureOutput::Kind::video) {
        VX_TRY_ASSIGN(video, VideoFile::open(output.before, wanted.picture.width, wanted.picture.height, wanted.fps));
    }
    TracedStats stats;
    client::CameraPose before;
    before.yaw_deg = 1e9f; // of no frame
    ProgressLine progress(wanted.traced ? u64(wanted.frames) * wanted.picture.spp : wanted.frames,
                          wanted.traced ? "samples a pixel" : "frames");
    for (u32 frame = 0; frame < wanted.frames; ++frame) {
        if (wanted.traced) progress.note(fmt::format("frame {} of {}", frame + 1, wanted.frames));
        auto drawn = stop ? Result<>(fail(ErrorCode::denied, "interrupted"))
                          : draw_frame(still, wanted, frame, output, video.get(), stop, progress, stats, before);
        if (!drawn) {
            const std::string kept = video        ? "no video was made"
                                     : frame == 0 ? "no frame was written"
                                                  : fmt::format("frames 0 to {} are written", frame - 1);
            return fail(drawn.error().code, fmt::format("{} ({})", drawn.error().message, kept));
        }
    }
    if (video) VX_TRY(video->finish());
    return stats;
}

} // namespace vitrail::apps
