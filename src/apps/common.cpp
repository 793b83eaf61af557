#include "apps/commands.h"

#include "script/content_loader.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fmt/format.h>
#include <fstream>
#include <new>
#include <unistd.h>

namespace vitrail::apps {

namespace fs = std::filesystem;

static std::atomic<bool> g_stop{false};

const std::atomic<bool>& stop_on_signals() {
    struct sigaction action {};
    action.sa_handler = [](int) { g_stop = true; };
    action.sa_flags = int(SA_RESETHAND);
    for (int number : {SIGINT, SIGTERM}) sigaction(number, &action, nullptr);
    return g_stop;
}

std::string one_line(std::string text) {
    for (char& c : text)
        if (static_cast<unsigned char>(c) < 32 || c == 127) c = ' ';
    return text;
}

int exit_status(const char* program, const std::function<Result<>()>& command) {
    std::string message;
    try {
        const Result<> result = command();
        if (result) return 0;
        message = result.error().message;
    } catch (const std::bad_alloc&) {
        message = "not enough memory";
    } catch (const std::exception& error) { // the standard library's, of file systems and threads
        message = error.what();
    }
    std::fprintf(stderr, "%s: %s\n", program, one_line(message).c_str());
    return 2;
}

Result<fs::path> content_folder() {
    std::vector<fs::path> places;
    std::error_code ignored;
    if (const char* chosen = std::getenv("VITRAIL_CONTENT"); chosen && *chosen) {
        if (!fs::is_directory(fs::path(chosen) / "base", ignored))
            return fail(ErrorCode::not_found, fmt::format("no content folder: VITRAIL_CONTENT is {}, which has no folder base", chosen));
        return fs::weakly_canonical(chosen, ignored);
    }
    const fs::path program = fs::read_symlink("/proc/self/exe", ignored).parent_path();
    if (!program.empty()) {
        places.push_back(program / "../../../content"); // build/PRESET/bin
        places.push_back(program / "../share/vitrail/content");
    }
#ifdef VITRAIL_SOURCE_DIR
    places.emplace_back(fs::path(VITRAIL_SOURCE_DIR) / "content");
#endif
    for (const fs::path& place : places)
        if (fs::is_directory(place / "base", ignored)) return fs::weakly_canonical(place, ignored);
    return fail(ErrorCode::not_found, fmt::format("no content folder: looked in {} (set VITRAIL_CONTENT)", places.front().string()));
}

Result<Content> load_base_content() {
    VX_TRY_ASSIGN(const fs::path folder, content_folder());
    const std::vector<fs::path> roots{folder / "base"};
    std::error_code error;
    const bool any = std::any_of(fs::directory_iterator(roots[0], error), {}, [](const auto& entry) { return entry.path().extension() == ".lua"; });
    if (error || !any) return fail(ErrorCode::not_found, fmt::format("no script in {}: the content is not complete", roots[0].string()));
    return load_content(roots);
}

Result<std::vector<double>> parse_numbers(const std::string& option, const std::string& text, std::size_t count) {
    std::vector<double> out;
    const char* at = text.data();
    const char* end = at + text.size();
    while (at < end) {
        double value = 0;
        const auto [next, error] = std::from_chars(at, end, value);
        if (error != std::errc() || !std::isfinite(value) || (next < end && *next != ',')) break;
        out.push_back(value);
        at = next < end ? next + 1 : next;
        if (next < end && at == end) break; // a comma at the end
        if (next == end) {
            if (out.size() != count) break;
            return out;
        }
    }
    return fail(ErrorCode::invalid_argument, fmt::format("{} wants {} numbers with commas between, not '{}'", option, count, text));
}

Result<std::pair<u32, u32>> parse_size(const std::string& text) {
    u32 width = 0, height = 0;
    const std::size_t x = text.find('x');
    if (x != std::string::npos) {
        const auto a = std::from_chars(text.data(), text.data() + x, width);
        const auto b = std::from_chars(text.data() + x + 1, text.data() + text.size(), height);
        if (a.ec == std::errc() && a.ptr == text.data() + x && b.ec == std::errc() && b.ptr == text.data() + text.size() &&
            width >= 16 && height >= 16 && width <= 16384 && height <= 16384 && u64(width) * height <= 64'000'000)
            return std::pair{width, height};
    }
    return fail(ErrorCode::invalid_argument, fmt::format("--size wants WxH of 16 to 16384 a side and at most 64 million pixels, not '{}'", text));
}

Result<std::pair<std::string, std::string>> parse_change(const std::string& option, const std::string& text) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos) return fail(ErrorCode::invalid_argument, fmt::format("{} wants KEY=VALUE, not '{}'", option, text));
    return std::pair{text.substr(0, equals), text.substr(equals + 1)};
}

Result<std::string> read_text_file(const std::string& path, std::size_t bytes_most) {
    std::error_code error;
    if (fs::is_directory(path, error)) return fail(ErrorCode::io, fmt::format("cannot read {}: it is a folder", path));
    std::ifstream file(path, std::ios::binary);
    if (!file) return fail(ErrorCode::not_found, fmt::format("cannot read {}: {}", path, std::strerror(errno)));
    std::string text(bytes_most + 1, '\0'); // no asking for the size: a pipe has none
    file.read(text.data(), std::streamsize(text.size()));
    text.resize(std::size_t(file.gcount()));
    if (text.size() > bytes_most) return fail(ErrorCode::limit, fmt::format("{}: longer than {} bytes", path, bytes_most));
    return text;
}

// Pipes and devices (/dev/stdout) are written to, not replaced by a file.
static bool is_stream(const std::string& path) {
    std::error_code error;
    const fs::file_status there = fs::status(path, error);
    return !error && fs::exists(there) && !fs::is_regular_file(there) && !fs::is_directory(there);
}

Result<> write_file(const std::string& path, const std::string& text) {
    if (is_stream(path)) {
        std::ofstream file(path, std::ios::binary | std::ios::app);
        file << text;
        return file.flush() ? Result<>{} : fail(ErrorCode::io, fmt::format("cannot write {}: {}", path, std::strerror(errno)));
    }
    const std::string draft = fmt::format("{}.{}.part", path, getpid());
    {
        std::ofstream file(draft, std::ios::binary);
        file << text;
        if (!file.flush()) {
            const std::string why = std::strerror(errno);
            std::error_code ignored;
            fs::remove(draft, ignored);
            return fail(ErrorCode::io, fmt::format("cannot write {}: {}", path, why));
        }
    }
    std::error_code error;
    fs::rename(draft, path, error);
    if (error) {
        std::error_code ignored;
        fs::remove(draft, ignored);
        return fail(ErrorCode::io, fmt::format("cannot write {}: {}", path, error.message()));
    }
    return {};
}

Result<> check_writable(const std::string& path) {
    std::error_code error;
    if (fs::is_directory(path, error)) return fail(ErrorCode::io, fmt::format("cannot write {}: it is a folder", path));
    if (is_stream(path)) return {};
    const std::string draft = fmt::format("{}.{}.part", path, getpid());
    std::ofstream file(draft, std::ios::binary);
    if (!file) return fail(ErrorCode::io, fmt::format("cannot write {}: {}", path, std::strerror(errno)));
    file.close();
    fs::remove(draft, error);
    return {};
}

} // namespace vitrail::apps
