#include "base/log.h"

#include <atomic>
#include <cstdio>
#include <string>

namespace vitrail {

static std::atomic<LogLevel> g_least{LogLevel::info};

void set_log_level(LogLevel least) {
    g_least = least;
}

void log_line(LogLevel level, std::string_view text) {
    if (level < g_least.load(std::memory_order_relaxed)) return;
    static constexpr const char* names[] = {"debug", "info", "warning", "error", ""};
    std::string line = "vitrail: ";
    line += names[int(level)];
    line += ": ";
    line += text;
    line += '\n';
    std::fwrite(line.data(), 1, line.size(), stderr);
}

} // namespace vitrail
