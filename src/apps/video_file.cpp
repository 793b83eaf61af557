#include "apps/video_file.h"

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>
#include <utility>
#include <vector>

extern char** environ;

namespace vitrail::apps {

namespace fs = std::filesystem;

std::string find_ffmpeg() {
    const char* path = std::getenv("PATH");
    std::string rest = path ? path : "";
    while (!rest.empty()) {
        const std::size_t end = rest.find(':');
        const std::string folder = rest.substr(0, end);
        rest = end == std::string::npos ? "" : rest.substr(end + 1);
        const std::string program = folder + "/ffmpeg";
        if (!folder.empty() && access(program.c_str(), X_OK) == 0) return program;
    }
    return {};
}

bool VideoFile::is_video(const std::string& path) {
    const std::string ending = fs::path(path).extension().string();
    return ending == ".mp4" || ending == ".webm" || ending == ".mkv";
}

Result<std::unique_ptr<VideoFile>> VideoFile::open(const std::string& path, u32 width, u32 height,
                                                   double frames_a_second) {
    const std::string program = find_ffmpeg();
    if (program.empty())
        return fail(ErrorCode::not_found, "a video wants the program ffmpeg, which is not installed (Debian: apt "
                                          "install ffmpeg); numbered frames need none");
    std::unique_ptr<VideoFile> video(new VideoFile);
    const fs::path file = fs::absolute(path); // a name that begins with '-' is no option then
    const std::string ending = file.extension().string();
    video->path_ = path, video->width_ = width, video->height_ = height;
    video->unfinished_ = (file.parent_path() / (file.stem().string() + ".part" + ending)).string();

    // Players read H.264 and VP9 with half as many colors a side: those want even sizes: an odd row or column is left out.
    std::vector<std::string> words = {program,
                                      "-hide_banner",
                                      "-nostdin",
                                      "-loglevel",
                                      "error",
                                      "-y",
                                      "-f",
                                      "rawvideo",
                                      "-pixel_format",
                                      "rgb24",
                                      "-video_size",
                                      fmt::format("{}x{}", width, height),
                                      "-framerate",
                                      fmt::format("{}", frames_a_second),
                                      "-i",
                                      "pipe:0",
                                      "-vf",
                                      "crop=trunc(iw/2)*2:trunc(ih/2)*2,scale=out_color_matrix=bt709:out_range=tv",
                                      "-pix_fmt",
                                      "yuv420p",
                                      "-colorspace",
                                      "bt709",
                                      "-color_primaries",
                                      "bt709",
                                      "-color_trc",
                                      "bt709",
                                      "-color_range",
                                      "tv"};
    const std::vector<std::string> codec =
        ending == ".mp4"
            ? std::vector<std::string>{"-c:v", "libx264", "-preset", "slow", "-crf", "17", "-movflags", "+faststart"}
            : std::vector<std::string>{"-c:v", "libvpx-vp9", "-crf", "24", "-b:v", "0", "-row-mt", "1"};
    words.insert(words.end(), codec.begin(), codec.end());
    words.push_back("file:" + video->unfinished_); // else a colon would name a protocol
    std::vector<char*> arguments;
    for (std::string& word : words)
        arguments.push_back(word.data());
    arguments.push_back(nullptr);

    // A socket, so that a write after ffmpeg's end is an error and no signal.
    int ends[2];
    if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0)
        return fail(ErrorCode::io, fmt::format("ffmpeg: {}", std::strerror(errno)));
    video->socket_ = ends[0];
    video->errors_ = memfd_create("ffmpeg", MFD_CLOEXEC);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, ends[1], 0);
    posix_spawn_file_actions_addopen(&actions, 1, "/dev/null", O_WRONLY, 0);
    if (video->errors_ >= 0) posix_spawn_file_actions_adddup2(&actions, video->errors_, 2);
    // Control-C is for us to hear: what ffmpeg has made is thrown away in order then.
    posix_spawnattr_t attributes;
    posix_spawnattr_init(&attributes);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
    posix_spawnattr_setpgroup(&attributes, 0);
    pid_t process = -1;
    const int spawned = posix_spawn(&process, program.c_str(), &actions, &attributes, arguments.data(), environ);
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&actions);
    close(ends[1]);
    if (spawned != 0) return fail(ErrorCode::io, fmt::format("{} does not start: {}", program, std::strerror(spawned)));
    video->process_ = process;
    return video;
}

VideoFile::~VideoFile() {
    if (process_ >= 0) kill(process_, SIGTERM);
    (void)end();
    if (errors_ >= 0) close(errors_);
    if (!unfinished_.empty()) std::remove(unfinished_.c_str());
}

bool VideoFile::end() {
    if (socket_ >= 0) close(std::exchange(socket_, -1));
    if (process_ < 0) return false;
    int status = 0;
    pid_t ended;
    do
        ended = waitpid(process_, &status, 0);
    while (ended < 0 && errno == EINTR);
    process_ = -1;
    return ended >= 0 && WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

std::string VideoFile::words() {
    char text[2048];
    const ssize_t length = errors_ >= 0 ? pread(errors_, text, sizeof text, 0) : 0;
    std::string said(text, length > 0 ? std::size_t(length) : 0);
    while (!said.empty() && said.back() == '\n')
        said.pop_back();
    if (const std::size_t line = said.rfind('\n'); line != std::string::npos) said = said.substr(line + 1);
    return said.empty() ? "it ended without a word" : said.substr(0, 300);
}

Result<> VideoFile::add(const Image& frame) {
    if (frame.width != width_ || frame.height != height_ || frame.channels != 3)
        return fail(ErrorCode::invalid_argument, "a frame of another size than the video");
    std::size_t sent = 0;
    while (sent < frame.pixels.size()) {
        const ssize_t n = send(socket_, frame.pixels.data() + sent, frame.pixels.size() - sent, MSG_NOSIGNAL);
        if (n > 0)
            sent += std::size_t(n);
        else if (n < 0 && errno == EINTR)
            continue;
        else {
            (void)end();
            return fail(ErrorCode::io, fmt::format("{}: ffmpeg does not go on: {}", path_, words()));
        }
    }
    return {};
}

Result<> VideoFile::finish() {
    if (!end()) return fail(ErrorCode::io, fmt::format("{}: ffmpeg could not make it: {}", path_, words()));
    if (std::rename(unfinished_.c_str(), path_.c_str()) != 0)
        return fail(ErrorCode::io, fmt::format("{}: cannot be written: {}", path_, std::strerror(errno)));
    unfinished_.clear();
    return {};
}

} // namespace vitrail::apps
