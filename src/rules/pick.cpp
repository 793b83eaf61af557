#include "rules/pick.h"

#include "voxel/ray_walk.h"

#include <algorithm>
#include <cmath>

namespace vitrail {

std::optional<PickHit> pick_block(const Dimension& dimension, WorldPos eye, Vec3 direction, float reach) {
    const double length = std::sqrt(double(direction.x) * direction.x + double(direction.y) * direction.y +
                                    double(direction.z) * direction.z);
    if (!(length > 0) || !std::isfinite(length)) return std::nullopt;
    const double d[3] = {direction.x / length, direction.y / length, direction.z / length};
    for (RayWalk walk(eye, direction, reach); walk.valid(); walk.step()) {
        const StateId id = dimension.state_at(walk.cell());
        if (id == StateId::air) continue;
        const BlockShape& shape = dimension.states().info(id).shape;
        if (shape.pick.empty()) continue;
        const WorldPos corner = corner_of(walk.cell());
        const double from[3] = {double(eye.x - corner.x) * 0x1p-32, double(eye.y - corner.y) * 0x1p-32,
                                double(eye.z - corner.z) * 0x1p-32};
        std::optional<PickHit> best;
        for (const ShapeBox& box : shape.pick) {
            double enter = -1e30, leave = 1e30;
            Face face = walk.entry(); // for an eye inside the box
            for (int a = 0; a < 3; ++a) {
                const double lo = box.min[a] / double(kShapeUnit), hi = box.max[a] / double(kShapeUnit);
                if (d[a] == 0) {
                    if (from[a] < lo || from[a] > hi) leave = -1e30;
                    continue;
                }
                const double t0 = ((d[a] > 0 ? lo : hi) - from[a]) / d[a], t1 = ((d[a] > 0 ? hi : lo) - from[a]) / d[a];
                if (t0 > enter) {
                    enter = t0;
                    if (t0 >= 0) face = Face(a * 2 + (d[a] > 0 ? 0 : 1));
                }
                leave = std::min(leave, t1);
            }
            if (enter > leave || leave < 0) continue;
            const double t = std::max(enter, 0.0);
            if (t > reach || (best && float(t) >= best->t)) continue;
            const auto inside = [&](int a) { return float(std::clamp(from[a] + d[a] * t, 0.0, 1.0)); };
            best = PickHit{walk.cell(), face, float(t), {inside(0), inside(1), inside(2)}};
        }
        if (best) return best;
    }
    return std::nullopt;
}

} // namespace vitrail
