// The game's frames while its player flies at full speed over new land, beside those while he stands still: server,
// replica, mesher and renderer as `vitrail play` uses them, in real time, without a window and without a frame limit.
#include "base/clock.h"
#include "bench/harness.h"
#include "client/frame_builder.h"
#include "client/local_game.h"
#include "client/section_feeder.h"
#include "math/angle.h"
#include "platform/headless.h"
#include "rules/pick.h"
#include "script/content_loader.h"
#include "terrain/generator.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <epoxy/gl.h>
#include <filesystem>
#include <fmt/format.h>
#include <thread>
#include <unordered_map>

using namespace vitrail;

namespace {

namespace fs = std::filesystem;

constexpr u32 kWidth = 854, kHeight = 480;
constexpr float kYawDeg = -90; // +x
constexpr i32 kClearance = 24; // blocks above the highest land near

enum Part : std::size_t { whole, world, feed, draw, parts }; // of a frame
constexpr const char* kPartNames[] = {"frame", "messages and steps", "sections", "drawing"};

double process_seconds() {
    timespec t{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return double(t.tv_sec) + double(t.tv_nsec) * 1e-9;
}

struct Phase {
    std::vector<double> wall_ms[parts], cpu_ms[parts]; // of the frames; processor time of the thread that draws
    double seconds = 0, process_s = 0;

    static double percentile(std::vector<double> values, double share) {
        if (values.empty()) return 0;
        std::sort(values.begin(), values.end());
        return values[std::min(values.size() - 1, std::size_t(std::ceil(share * double(values.size()))) - 1)];
    }
    double p99() const { return percentile(wall_ms[whole], 0.99); }
    void print(const char* name) const {
        fmt::print("  {:9} {:5} frames in {:.1f} s, {:.1f} s of processor time of all threads\n", name,
                   wall_ms[whole].size(), seconds, process_s);
        for (std::size_t p = 0; p < parts; ++p)
            fmt::print("    {:18} ms p50 {:7.2f} p99 {:7.2f} longest {:7.2f}; this thread's processor time p50 {:6.2f} "
                       "p99 {:6.2f} "
                       "longest {:6.2f}\n",
                       kPartNames[p], percentile(wall_ms[p], 0.5), percentile(wall_ms[p], 0.99),
                       percentile(wall_ms[p], 1), percentile(cpu_ms[p], 0.5), percentile(cpu_ms[p], 0.99),
                       percentile(cpu_ms[p], 1));
    }
};

// Which columns were not there, or their surface not drawn, when they came nearer than two columns to the view's edge.
struct Lateness {
    u64 looked_at = 0, missing = 0, undrawn = 0;
    double undrawn_s_most = 0;               // from coming near until drawn
    std::unordered_map<ColumnPos, u64> near; // since when; 0: drawn
    u32 waiting_most = 0;                    // sections to be meshed
};

struct Flyer {
    fs::path folder;
    std::unique_ptr<platform::HeadlessContext> context;
    std::unique_ptr<render::Renderer> renderer;
    std::unique_ptr<client::LocalGame> game;
    std::unique_ptr<ThreadPool> pool;
    std::unique_ptr<client::SectionFeeder> feeder;
    u32 view_distance = 0;

    ~Flyer() {
        feeder.reset();
        game.reset();
        renderer.reset();
        std::error_code ignored;
        if (!folder.empty()) fs::remove_all(folder, ignored);
    }

    Result<> open(const Content& content, u32 distance) {
        view_distance = distance;
        std::error_code error;
        std::string pattern = (fs::temp_directory_path(error) / "vitrail-fly-XXXXXX").string();
        if (error || !mkdtemp(pattern.data())) return fail(ErrorCode::io, "no folder for a passing world");
        folder = pattern;
        VX_TRY_ASSIGN(context, platform::HeadlessContext::create());
        VX_TRY_ASSIGN(renderer, render::Renderer::create({.effects = render::preset_effects(render::Preset::low)}));
        VX_TRY(renderer->load_textures(*content.registry));
        client::LocalGameOptions local;
        local.server.folder = folder.string();
        local.server.seed = 7;
        local.server.threads = default_worker_count();
        local.replica.view_distance = distance;
        VX_TRY_ASSIGN(game, client::LocalGame::open(local, content));
        VX_TRY(game->wait_joined(60));
        pool = std::make_unique<ThreadPool>(default_worker_count());
        feeder = std::make_unique<client::SectionFeeder>(*renderer, *pool);
        return {};
    }

    // Up and above the land around and ahead, as a player would fly.
    MoveCommand input(bool fly) {
        const replica::Replica& replica = game->replica();
        MoveCommand command;
        command.yaw = kYawDeg * kRadiansADegree;
        command.toggle_flying = !replica.body().flying;
        const ColumnPos here = column_of(chunk_of(block_of(replica.body().feet.at)));
        i32 top = 64;
        for (i32 x = 0; x <= 4; ++x)
            if (const ColumnHeights* h = replica.dimension().heights({here.x + x, here.z}))
                top = std::max(top, *std::max_element(h->above.begin(), h->above.end()));
        const i32 y = block_of(replica.body().feet.at).y;
        command.jump = y < top + kClearance;
        command.sneak = y > top + kClearance + 12;
        command.forward = fly ? 1 : 0;
        command.sprint = fly;
        return command;
    }

    Result<> frame(bool fly, float seconds, double time, Phase& phase) {
        replica::Replica& replica = game->replica();
        u64 wall[4] = {now_ns()}, cpu[4] = {thread_time_ns()};
        const auto stamp = [&](int i) { wall[i] = now_ns(), cpu[i] = thread_time_ns(); };
        if (!replica.poll()) return fail(ErrorCode::denied, replica.lost_reason());
        replica.move(input(fly), seconds);
        client::CameraPose pose;
        pose.eye = {replica.body().feet.dimension,
                    client::interpolate(eye_of(replica.body_before()), eye_of(replica.body()), replica.alpha())};
        pose.yaw_deg = kYawDeg + 3 * float(std::sin(time * 3));
        pose.pitch_deg = 12;
        bench::keep(
            pick_block(replica.dimension(), pose.eye.at, look_direction(pose.yaw_deg * kRadiansADegree, 0.2f), kReach));
        stamp(1);
        feeder->update(replica, block_of(pose.eye.at), client::feed_budget_ms(seconds));
        stamp(2);
        const auto view =
            client::build_frame(pose, replica.dimension(), kWidth, kHeight, 6000, view_distance, float(time));
        VX_TRY(renderer->render(view));
        glFinish();
        stamp(3);
        for (std::size_t p = world; p < parts; ++p) {
            phase.wall_ms[p].push_back(double(wall[p] - wall[p - 1]) * 1e-6);
            phase.cpu_ms[p].push_back(double(cpu[p] - cpu[p - 1]) * 1e-6);
        }
        phase.wall_ms[whole].push_back(double(wall[3] - wall[0]) * 1e-6);
        phase.cpu_ms[whole].push_back(double(cpu[3] - cpu[0]) * 1e-6);
        return {};
    }

    bool drawn(ColumnPos at, const ColumnHeights& heights) const {
        const i32 y = heights.above[8 * 16 + 8] - 1;
        return renderer->has_section(chunk_of(BlockPos{at.x * 16 + 8, y, at.z * 16 + 8}),
                                     game->replica().dimension().info().id);
    }

    void look_for_late(Lateness& late) const {
        const replica::Replica& replica = game->replica();
        const ColumnPos here = column_of(chunk_of(block_of(replica.body().feet.at)));
        const i32 reach = i32(view_distance) - 2;
        const u64 now = now_ns();
        late.waiting_most = std::max(late.waiting_most, feeder->stats().waiting);
        for (i32 z = -reach; z <= reach; ++z)
            for (i32 x = -reach; x <= reach; ++x) {
                if (x * x + z * z > reach * reach) continue;
                const ColumnPos at{here.x + x, here.z + z};
                const ColumnHeights* heights = replica.dimension().heights(at);
                const bool is_drawn = heights && drawn(at, *heights);
                const auto [entry, fresh] = late.near.try_emplace(at, is_drawn ? 0 : now);
                if (fresh) ++late.looked_at, late.missing += !heights, late.undrawn += !is_drawn;
                if (entry->second == 0) continue;
                late.undrawn_s_most = std::max(late.undrawn_s_most, double(now - entry->second) * 1e-9);
                if (is_drawn) entry->second = 0;
            }
    }

    // Draws frames for so long, or (late == null) until all is there and drawn, at most that long.
    Result<> run(bool fly, double seconds_most, Phase& phase, Lateness* late, bool until_settled = false) {
        const u64 start = now_ns();
        const double process = process_seconds();
        u64 last = start;
        while (seconds_since(start) < seconds_most) {
            const u64 now = now_ns();
            VX_TRY(frame(fly, float(now - last) * 1e-9f, seconds_since(start), phase));
            last = now;
            if (late) look_for_late(*late);
            if (until_settled && feeder->settled() && game->server().stats().idle && seconds_since(start) > 3) break;
        }
        phase.seconds = seconds_since(start);
        phase.process_s = process_seconds() - process;
        return {};
    }
};

Result<double> fly(u32 view_distance) {
    const std::vector<fs::path> roots{fs::path(VITRAIL_SOURCE_DIR) / "content/base"};
    VX_TRY_ASSIGN(const Content content, load_content(roots));
    Flyer flyer;
    VX_TRY(flyer.open(content, view_distance));
    Phase loading, standing, flying, after;
    Lateness late, ignored;
    VX_TRY(flyer.run(false, 60, loading, nullptr, true));
    const double loaded_s = loading.seconds;
    VX_TRY(flyer.run(false, 10, standing, &ignored));
    const auto from = flyer.game->replica().body().feet.at;
    late.near = ignored.near;
    VX_TRY(flyer.run(true, 30, flying, &late));
    const auto stats = flyer.game->server().stats(); // its ticks: the last half minute
    const float way = length(view_from(from, flyer.game->replica().body().feet.at).v);
    VX_TRY(flyer.run(false, 10, after, nullptr, true));
    double load[3] = {};
    if (getloadavg(load, 3) != 3) load[0] = -1;
    fmt::print("  load {:.1f}; {:.1f} s until all was drawn; flown {:.0f} blocks in {:.1f} s; standing p99 {:.1f} ms, "
               "flying p99 {:.1f} ms "
               "({:.2f} times)\n",
               load[0], loaded_s, way, flying.seconds, standing.p99(), flying.p99(), flying.p99() / standing.p99());
    standing.print("standing");
    flying.print("flying");
    after.print("after");
    const auto& t = stats.tick_times;
    fmt::print("  server tick ms while flying ({} ticks): wall p50 {:.2f} p99 {:.2f} longest {:.2f}; processor p50 "
               "{:.2f} p99 {:.2f} longest "
               "{:.2f}\n",
               t.ticks, t.wall_ms_p50, t.wall_ms_p99, t.wall_ms_longest, t.cpu_ms_p50, t.cpu_ms_p99, t.cpu_ms_longest);
    fmt::print("  of {} columns that came within {} columns: {} were not there, {} not drawn yet (the longest for "
               "{:.2f} s more); {} sections "
               "waited at most; {} meshed in all and {} of air; {:.0f} MB resident\n",
               late.looked_at, view_distance - 2, late.missing, late.undrawn, late.undrawn_s_most, late.waiting_most,
               flyer.feeder->stats().meshed, flyer.feeder->stats().without_job, double(resident_memory_bytes()) / 1e6);
    return flying.p99();
}

void fly_row(bench::Context& context, u32 view_distance) {
    const auto p99 = fly(view_distance);
    if (!p99) return context.skip(p99.error().message);
    context.report(*p99);
}

} // namespace

void register_fly_benches(bench::Suite& suite) {
    suite.add(
        "frame.fly.6", "ms",
        "99th percentile of frames while flying at full speed over new land for 30 s, 854x480, low preset, 6 chunks",
        [](bench::Context& c) { fly_row(c, 6); });
    suite.add("frame.fly.12", "ms", "the same with 12 chunks", [](bench::Context& c) { fly_row(c, 12); });
}
