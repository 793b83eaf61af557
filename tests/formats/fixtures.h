// Where the fixture worlds lie; tests skip where they are absent.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <string>

namespace vitrail::test {

inline std::filesystem::path fixtures() {
    if (const char* given = std::getenv("VITRAIL_FIXTURES")) return given;
    return std::filesystem::path(VITRAIL_SOURCE_DIR) / ".." / "shared" / "fixtures";
}

} // namespace vitrail::test

#define VX_NEED_FIXTURE(path)                                                                                          \
    if (!std::filesystem::exists(path)) GTEST_SKIP() << "skipped: no fixture " << (path).string()
