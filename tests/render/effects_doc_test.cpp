#include "render/effects.h"

#include <fstream>
#include <gtest/gtest.h>
#include <iterator>

namespace vitrail::render {

// The page that players read says what the program does (write it anew: `vitrail effects`).
TEST(Effects, TheirPageIsTheTable) {
    std::ifstream file(std::string(VITRAIL_SOURCE_DIR) + "/docs/effects.md");
    const std::string page(std::istreambuf_iterator<char>(file), {});
    EXPECT_NE(page.find(effects_table()), std::string::npos);
}

} // namespace vitrail::render
