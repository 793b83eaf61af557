// A video by the program ffmpeg, which gets raw frames through its standard input.
#pragma once

#include "base/result.h"
#include "formats/image.h"

#include <memory>
#include <string>

namespace vitrail::apps {

// Where ffmpeg lies in $PATH; empty: nowhere.
std::string find_ffmpeg();

class VideoFile {
public:
    // .mp4 (H.264), .webm and .mkv (VP9). What is unfinished lies beside, and goes if it is not finished. Errors:
    // not_found (no ffmpeg), io.
    static Result<std::unique_ptr<VideoFile>> open(const std::string& path, u32 width, u32 height,
                                                   double frames_a_second);
    static bool is_video(const std::string& path); // by its ending
    ~VideoFile();
    VideoFile(const VideoFile&) = delete;
    VideoFile& operator=(const VideoFile&) = delete;

    // RGB of the size above. Errors: io, with ffmpeg's own words.
    Result<> add(const Image& frame);
    // Waits for ffmpeg and gives the file its name. Errors: io.
    Result<> finish();

private:
    VideoFile() = default;
    std::string words(); // the last line that ffmpeg said
    bool end();          // closes its input and waits; whether it ended well
    std::string path_, unfinished_;
    u32 width_ = 0, height_ = 0;
    int socket_ = -1, errors_ = -1;
    int process_ = -1;
};

} // namespace vitrail::apps
