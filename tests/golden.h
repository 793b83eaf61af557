// Pictures compared with those a person has looked at: tests/FOLDER/golden/NAME.png. VITRAIL_UPDATE_GOLDEN=1 writes
// them anew: look at each before it is committed (holes, wrong light, seams). They are Mesa's software renderer's, the
// same on every machine; other drivers filter textures differently, so there such tests are skipped.
#pragma once

#include "gfx/context.h"
#include "render/image.h"

#include <cstdlib>
#include <gtest/gtest.h>
#include <string>

namespace vitrail::golden {

struct Tolerance {
    double mean = 1.5; // of the differences of all channels, of 255
    double far = 0.01; // share of pixels that differ by more than 24 in a channel
};

// How two pictures of one size differ.
struct Difference {
    double mean = 0; // of all channels, of 255
    double far = 0;  // share of pixels that differ by more than `step` in a channel
};

inline Difference difference(const render::Image& a, const render::Image& b, u32 step = 24) {
    u64 sum = 0, far = 0;
    for (u32 y = 0; y < a.height; ++y)
        for (u32 x = 0; x < a.width; ++x) {
            u32 worst = 0;
            for (u32 c = 0; c < 3; ++c) {
                const u32 d = u32(std::abs(int(a.at(x, y)[c]) - int(b.at(x, y)[c])));
                sum += d;
                worst = std::max(worst, d);
            }
            far += worst > step;
        }
    const double pixels = double(a.width) * a.height;
    return {double(sum) / pixels / 3, double(far) / pixels};
}

// Why golden pictures cannot be compared here; empty where they can. Needs a current context.
inline std::string cannot_compare() {
    const auto info = gfx::context_info();
    if (info && info->software) return {};
    return "golden pictures are Mesa's; " + (info ? info->renderer : std::string("this driver")) +
           " filters textures differently";
}

inline void compare(const std::string& folder, const std::string& name, const render::Image& image,
                    const Tolerance& tolerance = {}) {
    const std::string path = std::string(VITRAIL_SOURCE_DIR) + "/tests/" + folder + "/golden/" + name + ".png";
    if (std::getenv("VITRAIL_UPDATE_GOLDEN")) {
        ASSERT_TRUE(render::write_png(path, image));
        return;
    }
    const Result<render::Image> golden = render::read_png(path);
    ASSERT_TRUE(golden) << golden.error().message;
    ASSERT_EQ(golden->width, image.width);
    ASSERT_EQ(golden->height, image.height);
    const Difference d = difference(*golden, image);
    EXPECT_LT(d.mean, tolerance.mean) << name;
    EXPECT_LT(d.far, tolerance.far) << name;
    if (d.mean < tolerance.mean && d.far < tolerance.far) return;
    const std::string seen = "/tmp/vitrail_golden_" + folder + "_" + name + ".png";
    (void)render::write_png(seen, image);
    ADD_FAILURE() << "what was drawn: " << seen;
}

} // namespace vitrail::golden
