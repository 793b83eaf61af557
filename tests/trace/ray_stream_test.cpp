// Streams give what single rays give, bit for bit.
#include "grid_world.h"
#include "trace/cpu/ray_stream.h"

#include <gtest/gtest.h>

namespace vitrail::trace {
namespace {

bool same(const Hit& a, const Hit& b) {
    return std::memcmp(&a.t, &b.t, sizeof a.t) == 0 && a.cell == b.cell && a.state == b.state && a.kind == b.kind &&
           a.face == b.face && a.leaving == b.leaving && a.quad == b.quad && a.u == b.u && a.v == b.v;
}

struct Rays {
    std::vector<Ray> rays;
    std::vector<float> t_max;
    std::vector<u8> media;
};

// Of all kinds; some from outside of the window, some that end early, some in media.
Rays many_rays(Rng& rng, const GridWorld& world, u32 count, u32 kinds) {
    Rays r;
    for (u32 i = 0; i < count; ++i) {
        r.rays.push_back(test_ray(rng, world, i));
        IVec3& from = r.rays.back().from.cell;
        if (i % 17 == 0) from = {from.x + i32(rng.below(300)) - 150, from.y + 90, from.z - i32(rng.below(90))};
        r.t_max.push_back(rng.below(3) ? kFar : float(rng.below(60)));
        r.media.push_back(u8(kinds > 1 && rng.below(8) == 0 ? rng.below(kinds) : 0));
    }
    return r;
}

void compare(GridWorld& world, const Rays& r) {
    const SceneView s = world.scene();
    std::vector<Hit> hits(r.rays.size());
    std::vector<Lit> lit(r.rays.size());
    for (StreamCode code : {StreamCode::scalar, StreamCode::avx512, StreamCode::best}) {
        if (!stream_code_available(code)) continue;
        trace_stream(code, s, {r.rays, r.t_max, r.media}, hits);
        shadow_stream(code, s, {r.rays, r.t_max, r.media}, lit);
        for (u32 i = 0; i < r.rays.size(); ++i) {
            Hit hit;
            closest_hit(s, r.rays[i], r.t_max[i], r.media[i], hit);
            ASSERT_TRUE(same(hits[i], hit)) << i << ' ' << int(code) << ' ' << hits[i].t << ' ' << hit.t;
            u32 panes = 0;
            const bool dark = shadowed(s, r.rays[i], r.t_max[i], r.media[i], [&](const Hit& hit) {
                // No light goes straight through leaves and the plant's sheets.
                panes += hit.state != t_leaves && !(hit.kind == HitKind::quad && hit.quad < 2);
                return true;
            });
            ASSERT_EQ(lit[i], panes ? Lit::panes : dark ? Lit::shadow : Lit::open) << i << ' ' << int(code);
        }
    }
}

TEST(RayStream, EqualsSingleRaysThroughCubes) {
    Rng rng(31);
    for (double density : {0.0005, 0.01, 0.2, 0.9}) {
        GridWorld world;
        world.scatter(rng, t_stone, density);
        world.scatter(rng, t_stone, 0.05, 16);
        world.upload();
        compare(world, many_rays(rng, world, 6000, 1));
    }
}

TEST(RayStream, EqualsSingleRaysThroughEverything) {
    Rng rng(32);
    GridWorld world({-134217696, 4, 134217688});
    world.scatter(rng, t_stone, 0.02);
    for (u32 state : {t_glass, t_leaves, t_thin, t_plant, t_sunken})
        world.scatter(rng, state, 0.004);
    world.scatter(rng, t_water, 0.03, 8);
    world.upload();
    compare(world, many_rays(rng, world, 6000, 3));
}

TEST(RayStream, FewRaysAndNone) {
    Rng rng(33);
    GridWorld world;
    world.upload();
    compare(world, many_rays(rng, world, 40, 1)); // an empty world
    world.scatter(rng, t_stone, 0.1);
    world.upload();
    for (u32 count : {0u, 1u, 15u, 17u, 255u, 257u})
        compare(world, many_rays(rng, world, count, 1));
}

} // namespace
} // namespace vitrail::trace
