// Rays with an easy way are known to meet what closest_hit and shadowed say.
#include "grid_world.h"
#include "trace/kernel/lean_walk.h"
#include "trace/kernel/traverse.h"

#include <gtest/gtest.h>

namespace vitrail::trace {
namespace {

Ray any_ray(GridWorld& world, Rng& rng) {
    const auto any = [&] { return float(rng.unit()); };
    const IVec3 o = world.corner();
    Vec3 dir{any() - 0.5f, any() - 0.5f, any() - 0.5f};
    if (rng.below(8) == 0) (rng.below(2) ? dir.x : dir.z) = 0;
    if (dot(dir, dir) < 1e-4f) dir = {0, 1, 0};
    return {{{o.x + i32(rng.below(64)), o.y + i32(rng.below(64)), o.z + i32(rng.below(64))}, {any(), any(), any()}},
            normalized(dir)};
}

TEST(LeanWalk, KnowsWhatOthersFind) {
    Rng rng(51);
    const BrickBoxes table = make_brick_boxes();
    const auto boxes = [&](u32 i) { return table.of[i]; };
    for (const bool mixed : {false, true}) {
        GridWorld world;
        world.fill(rng, {{t_stone, mixed ? 0.01 : 0.03}});
        if (mixed)
            for (u32 state = t_stone; state < t_states; ++state)
                world.scatter(rng, state, 0.004);
        world.upload();
        const SceneView s = world.scene();
        u32 known = 0, hits = 0, lit = 0, dark = 0, cut = 0;
        constexpr u32 kRays = 40000;
        for (u32 i = 0; i < kRays; ++i) {
            const Ray ray = any_ray(world, rng);
            Hit lean, hit;
            if (lean_closest(s, ray, 0, lean, boxes)) {
                closest_hit(s, ray, kFar, 0, hit);
                ++known, hits += hit.kind != HitKind::nothing;
                ASSERT_EQ(lean.kind, hit.kind) << i;
                if (hit.kind != HitKind::nothing) {
                    ASSERT_EQ(lean.t, hit.t);
                    ASSERT_EQ(lean.cell, hit.cell);
                    ASSERT_EQ(lean.face, hit.face);
                    ASSERT_EQ(lean.state, hit.state);
                }
            }
            AirWalk all, few;
            const LeanEnd whole = lean_walk(s, ray, kFar, 0, all, boxes),
                          begun = lean_walk(s, ray, kFar, 0, few, boxes, 4);
            ASSERT_TRUE(begun == LeanEnd::hard || begun == whole); // what is not finished is not known
            cut += begun != whole;
            const float most = i % 3 ? kFar : 1 + 40 * float(rng.unit());
            const LeanEnd end = lean_shadow(s, ray, most, 0, boxes);
            if (end == LeanEnd::hard) continue;
            bool panes = false;
            const bool is_dark = shadowed(s, ray, most, 0, [&](const Hit&) {
                panes = true;
                return false;
            });
            ASSERT_EQ(end == LeanEnd::stopped, is_dark) << i << ' ' << most;
            ASSERT_FALSE(panes && !is_dark);
            ++(is_dark ? dark : lit);
        }
        EXPECT_GT(known, kRays * (mixed ? 2 : 8) / 10);
        EXPECT_GT(hits, kRays / 10);
        EXPECT_GT(cut, kRays / 10);
        EXPECT_GT(lit, kRays / 20);
        EXPECT_GT(dark, kRays / 20);
        EXPECT_EQ(lean_shadow(s, any_ray(world, rng), kFar, 1, boxes), LeanEnd::hard); // in water
    }
}

} // namespace
} // namespace vitrail::trace
