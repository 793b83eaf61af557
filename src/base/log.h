// Log lines go to standard error as `vitrail: LEVEL: text`; thread-safe, one write a line.
#pragma once

#include <string_view>

namespace vitrail {

enum class LogLevel { debug, info, warning, error, none };

void set_log_level(LogLevel least);
void log_line(LogLevel level, std::string_view text);
inline void log_info(std::string_view text) {
    log_line(LogLevel::info, text);
}
inline void log_warning(std::string_view text) {
    log_line(LogLevel::warning, text);
}
inline void log_error(std::string_view text) {
    log_line(LogLevel::error, text);
}

} // namespace vitrail
