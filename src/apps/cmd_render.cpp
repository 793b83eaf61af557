#include "apps/commands.h"
#include "apps/path_frames.h"
#include "apps/video_file.h"

#include "base/clock.h"
#include "client/still.h"
#include "client/traced_view.h"
#include "gfx/context.h"
#include "pipeline/new_world.h"
#include "script/content_loader.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace vitrail::apps {

// The demo picture: a place of a seed chosen by eye.
static void choose_demo(RenderOptions& options) {
    options.seed = 7;
    options.size = "1280x720";
    options.time = 2200;
    options.view_distance = 14;
}

// Where a seed's spawn looks best from when no place is given: a little above it, looking along the land.
static Result<client::CameraPose> pose_at_spawn(const Content& content, u64 seed) {
    VX_TRY_ASSIGN(const auto generator, open_generator(kGeneratorName, kGeneratorVersion, content.terrain.get(), seed));
    const BlockPos spawn = spawn_point(*generator);
    client::CameraPose pose;
    pose.eye.at = world_pos_from_numbers(spawn.x + 0.5, spawn.y + 9.0, spawn.z + 0.5);
    pose.yaw_deg = 30;
    pose.pitch_deg = 12;
    return pose;
}

static scene::CameraMoment moment_of(const client::CameraPose& pose, float time) {
    const WorldPos& at = pose.eye.at;
    const auto blocks = [](i64 fixed) { return double(fixed) / double(kFixedOne); };
    return {{blocks(at.x), blocks(at.y), blocks(at.z)}, pose.yaw_deg, pose.pitch_deg, pose.fov_deg, time};
}

static Result<TracedStats> render_one(client::Still& still, const client::CameraPose& pose, const TracedPicture& picture,
                                      const PictureOutput& output, const std::atomic<bool>& stop) {
    TracedStats stats;
    if (!still.traces()) {
        VX_TRY_ASSIGN(const render::Image image, still.draw(pose, picture.width, picture.height, picture.time));
        VX_TRY(render::write_png(output.file(0), image));
        return stats;
    }
    {
        ProgressLine progress(picture.spp, "samples a pixel");
        VX_TRY(trace_picture(still, pose, picture, stop, progress, stats));
    }
    if (output.kind == PictureOutput::Kind::exr) {
        VX_TRY(write_traced_exr(output.file(0), still.tracer(), picture.width, picture.height,
                                {picture.spp, picture.seed, picture.bounces, picture.denoise, picture.time, pose}));
        return stats;
    }
    VX_TRY_ASSIGN(const render::Image image, still.develop(pose, picture.width, picture.height, picture.time));
    VX_TRY(render::write_png(output.file(0), image));
    return stats;
}

Result<> run_render(const RenderOptions& wanted) {
    RenderOptions options = wanted;
    if (options.demo) choose_demo(options);
    if (options.renderer != "raster" && options.renderer != "trace")
        return fail(ErrorCode::invalid_argument, fmt::format("--renderer is raster or trace, not '{}'", options.renderer));
    if (options.world.empty() == !options.seed)
        return fail(ErrorCode::invalid_argument, "render wants one of --world DIR and --seed N");
    if (options.denoise != "on" && options.denoise != "off")
        return fail(ErrorCode::invalid_argument, fmt::format("--denoise is on or off, not '{}'", options.denoise));
    VX_TRY_ASSIGN(const auto size, parse_size(options.size));
    client::StillOptions still_options;
    still_options.world = options.world;
    still_options.seed = options.seed.value_or(0);
    still_options.dimension = options.dimension;
    still_options.view_distance = u32(options.view_distance);
    VX_TRY_ASSIGN(still_options.effects, effects_of(options.effects, still_options.effects));
    still_options.shader_folder = options.effects.shader_folder;
    still_options.packs = options.packs;
    if (options.renderer == "trace") {
        VX_TRY_ASSIGN(still_options.trace, client::trace_device_named(options.device));
        still_options.trace_devices = u32(options.devices);
    }
    bool from_spawn = false;
    if (options.at.empty()) {
        from_spawn = options.seed.has_value();
        if (!from_spawn && options.path_file.empty())
            return fail(ErrorCode::invalid_argument, "render --world wants --at X,Y,Z and --look YAW,PITCH");
    } else {
        VX_TRY_ASSIGN(const auto at, parse_numbers("--at", options.at, 3));
        still_options.pose.eye.at = world_pos_from_numbers(at[0], at[1], at[2]);
    }
    std::optional<std::pair<float, float>> turned; // yaw, pitch
    if (!options.look.empty()) {
        VX_TRY_ASSIGN(const auto look, parse_numbers("--look", options.look, 2));
        turned = {float(std::fmod(look[0], 360.0)), float(std::clamp(look[1], -90.0, 90.0))};
    }
    const bool traces = options.renderer == "trace";
    VX_TRY_ASSIGN(const PictureOutput output, plan_output(options.output, !options.path_file.empty(), traces));
    VX_TRY(check_writable(output.file(0)));
    if (output.kind == PictureOutput::Kind::video && find_ffmpeg().empty()) VX_TRY(VideoFile::open(output.before, 2, 2, 1)); // says why
    TracedPicture picture;
    picture.width = size.first, picture.height = size.second, picture.time = options.time;
    picture.spp = u32(options.spp), picture.bounces = u32(options.bounces), picture.seed = u32(options.trace_seed);
    picture.denoise = options.denoise == "on";
    if (!options.stats_file.empty()) VX_TRY(check_writable(options.stats_file));
    VX_TRY_ASSIGN(const Content content, load_base_content());
    if (from_spawn) {
        VX_TRY_ASSIGN(still_options.pose, pose_at_spawn(content, *options.seed));
    }
    if (turned) still_options.pose.yaw_deg = turned->first, still_options.pose.pitch_deg = turned->second;
    still_options.pose.fov_deg = options.fov_deg;
    std::optional<PathFrames> path;
    if (!options.path_file.empty()) {
        VX_TRY_ASSIGN(path, open_path(options.path_file, options.fps, options.seconds, moment_of(still_options.pose, options.time)));
        if (options.at.empty() && !from_spawn && !path->path.has_place())
            return fail(ErrorCode::invalid_argument, fmt::format("--path {}: no key says at, and there is no --at", options.path_file));
        path->traced = traces, path->picture = picture;
        still_options.pose = pose_of(path->path.at(0), still_options.pose.eye.dimension);
    }
    still_options.trace_stages = !options.stats_file.empty();
    still_options.stop = &stop_on_signals(); // a passing world lies in a folder that must go
    VX_TRY_ASSIGN(const auto still, client::Still::open(still_options, content));

    const u64 start = now_ns();
    TracedStats traced;
    if (path) {
        VX_TRY_ASSIGN(traced, render_path(*still, *path, output, *still_options.stop));
    } else {
        VX_TRY_ASSIGN(traced, render_one(*still, still_options.pose, picture, output, *still_options.stop));
    }
    const double draw_s = seconds_since(start);
    if (const u32 missing = still->renderer().missing_textures(); missing > 0)
        fmt::print(stderr, "vitrail: info: {} textures are missing, the first is {}\n", missing,
                   still->renderer().missing_texture_names().front());
    if (options.stats_file.empty()) return {};
    nlohmann::json passes_ms = nlohmann::json::object();
    if (still_options.trace) {
        const trace::TracerStats& last = still->tracer().stats();
        passes_ms = {{"trace", last.trace_ms}, {"denoise", last.denoise_ms}, {"update", last.update_ms}};
        for (const trace::TraceStage& s : last.stages) passes_ms["trace " + s.name] = {{"ms", s.ms}, {"items", s.items}};
    } else {
        VX_TRY_ASSIGN(const auto times, still->time_passes(still_options.pose, size.first, size.second, options.time));
        for (const auto& [pass, ms] : times) passes_ms[pass] = ms;
    }
    const auto& frame = still->renderer().stats();
    const auto info = gfx::context_info();
    nlohmann::json stats = {{"seconds", {{"open", still->times().open_s}, {"world", still->times().world_s},
                                               {"mesh", still->times().mesh_s}, {"draw", draw_s}}},
                                  {"frames", path ? path->frames : 1},
                                  {"rays", traced.rays},
                                  {"dropped", traced.dropped},
                                  {"chunks", frame.sections},
                                  {"chunks_visible", frame.sections_visible},
                                  {"triangles", frame.triangles},
                                  {"quads_held", frame.quads_held},
                                  {"draw_calls", frame.draws},
                                  {"gpu_bytes", frame.gpu_bytes},
                                  {"missing_textures", still->renderer().missing_textures()},
                                  {"peak_memory_bytes", peak_memory_bytes()},
                                  {"passes_ms", passes_ms},
                                  {"device", info ? info->renderer : "unknown"}};
    if (still_options.trace) {
        const trace::TracerStats& last = still->tracer().stats();
        stats["device"] = last.device;
        stats["chunks"] = last.chunks;
        stats["trace"] = {{"samples", last.samples}, {"paths", traced.paths}, {"seconds", traced.seconds},
                          {"million_rays_a_second", double(traced.rays) * 1e-6 / std::max(traced.seconds, 1e-9)},
                          {"emitters", last.emitters}, {"host_bytes", last.host_bytes}, {"device_bytes", last.device_bytes}};
    }
    if (const scene::PackLooks* packs = still->packs()) {
        const auto& c = packs->counts();
        stats["packs"] = {{"count", c.packs}, {"textures_replaced", c.replaced_textures}, {"textures_added", c.own_textures},
                          {"textures_made", c.made_textures}, {"blockstates", c.blockstates}, {"models", c.models},
                          {"models_unresolved", c.unresolved_models}, {"problems", packs->report().problems},
                          {"missing", packs->missing()}};
    }
    return write_file(options.stats_file, stats.dump(1) + "\n");
}

} // namespace vitrail::apps
