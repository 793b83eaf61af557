#include "apps/commands.h"
#include "apps/video_file.h"

#include "gfx/context.h"
#include "platform/headless.h"
#include "terrain/cuda/device.h"
#include "trace/cuda/cuda_tracer.h"

#include <cstdlib>
#include <fmt/format.h>
#include <sqlite3.h>
#include <thread>

namespace vitrail::apps {

Result<> run_doctor() {
    fmt::print("processor   {} threads, avx2 {}, avx512 {}\n", std::thread::hardware_concurrency(),
               __builtin_cpu_supports("avx2") ? "yes" : "no", __builtin_cpu_supports("avx512vbmi2") ? "yes" : "no");
    if (auto context = platform::HeadlessContext::create()) {
        if (const auto info = gfx::context_info())
            fmt::print("opengl      {} on {} ({}){}\n", info->version, info->renderer, (*context)->description(),
                       info->software ? ", drawn by the processor" : "");
        else fmt::print("opengl      {}\n", info.error().message);
    } else {
        fmt::print("opengl      none: {}\n", context.error().message);
    }
    const char* display = std::getenv("DISPLAY");
    const char* wayland = std::getenv("WAYLAND_DISPLAY");
    fmt::print("display     {}\n", wayland && *wayland ? wayland : display && *display ? display : "none (pictures still work)");
    fmt::print("cuda        {}\ntracing     {}\naudio       not in this build\n", cuda_summary(),
               trace::cuda_tracer_summary());
    const std::string ffmpeg = find_ffmpeg();
    fmt::print("ffmpeg      {}\n", ffmpeg.empty() ? "none (videos want it: apt install ffmpeg)" : ffmpeg);
    fmt::print("store       SQLite {}\n", sqlite3_libversion());
    const auto content = content_folder();
    fmt::print("content     {}\n", content ? content->string() : content.error().message);
    return {};
}

} // namespace vitrail::apps
