// Camera paths from anyone: what is taken in gives sound poses at every moment.
#include "scene/camera_path.h"

#include <cmath>
#include <cstdlib>

using namespace vitrail;

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
    const auto path = scene::CameraPath::parse({data, size}, {});
    if (!path) return 0;
    if (path->keys() == 0 || !(path->seconds() >= 0)) std::abort();
    for (int i = -1; i <= 20; ++i) {
        const scene::CameraMoment m = path->at(path->seconds() * i / 19);
        for (double x : m.at)
            if (!std::isfinite(x)) std::abort();
        if (!(m.pitch_deg >= -90 && m.pitch_deg <= 90 && std::abs(m.yaw_deg) <= 180 && m.time >= 0 && m.time < 24000))
            std::abort();
        if (!(m.fov_deg >= 5 - 1e-6 && m.fov_deg <= 150 + 1e-6)) std::abort();
    }
    return 0;
}
