#include "bench/trace/ray_scene.h"

namespace vitrail::bench {

using namespace trace;

RayScene::RayScene()
    : states(SampleLand::kinds + 1)
    , media(1)
    , grid({5, 4, 5}) {
    const SampleLand land;
    for (std::size_t i = 2; i < states.size(); ++i)
        states[i].kind = CellKind::cube;
    states[1].kind = CellKind::cube;
    grid.set_states(states, media);
    grid.center_on({SampleLand::kX / 2, SampleLand::kY / 2, SampleLand::kZ / 2});
    std::vector<StateId> cells(kChunkVolume);
    for (i32 i = 0; i < SampleLand::kX * SampleLand::kY * SampleLand::kZ; ++i) {
        for (std::size_t c = 0; c < cells.size(); ++c) {
            const u32 block = land.chunk(std::size_t(i))[c];
            cells[c] = StateId(block ? block + 1 : 0);
        }
        blocks_.push_back(BlockStorage::from_states(std::span<const StateId, kChunkVolume>(cells)));
    }
    fill();
}

void RayScene::fill() {
    std::vector<Grid::Item> items;
    for (i32 y = 0; y < SampleLand::kY; ++y)
        for (i32 z = 0; z < SampleLand::kZ; ++z)
            for (i32 x = 0; x < SampleLand::kX; ++x)
                items.push_back({{x, y, z}, &blocks_[SampleLand::chunk_index(x, y, z)]});
    grid.set_chunks(items);
    grid.refresh();
}

SceneView RayScene::view() {
    SceneView s;
    s.grid = grid.view();
    s.states = states.data(), s.state_count = u32(states.size());
    s.media = media.data();
    return s;
}

namespace {

void find_hits(RayScene& scene, RaySet& set) {
    const SceneView s = scene.view();
    set.hits.resize(set.rays.size());
    for (std::size_t i = 0; i < set.rays.size(); ++i)
        closest_hit(s, set.rays[i], kFar, 0, set.hits[i]);
}

// The place that was hit, on the outer side of its face.
Place outside(const Ray& ray, const Hit& hit) {
    Place p = moved(ray.from, ray.dir, hit.t);
    const IVec3 n = kFaceNormal[hit.face];
    p.cell = {hit.cell.x + n.x, hit.cell.y + n.y, hit.cell.z + n.z};
    const float on = hit.face & 1 ? 0.0f : 1.0f;
    (hit.face >> 1 == 0 ? p.at.x : hit.face >> 1 == 1 ? p.at.y : p.at.z) = on;
    return p;
}

} // namespace

Camera land_camera(u32 width, u32 height) {
    Camera c;
    c.width = width, c.height = height;
    const i32 x = 256, z = 232;
    c.eye = {{x, SampleLand::height(x, z) + 20, z}, {0.5f, 0.5f, 0.5f}};
    c.forward = normalized({0.5f, -0.25f, 0.83f});
    c.right = normalized(cross(c.forward, {0, 1, 0}));
    c.up = cross(c.right, c.forward);
    const float half = 0.7f; // 70 degrees high
    c.up = c.up * half;
    c.right = c.right * (half * float(width) / float(height));
    return c;
}

RaySet camera_rays(RayScene& scene, u32 width, u32 height) {
    const Camera c = land_camera(width, height);
    RaySet set;
    for (u32 by = 0; by < c.height; by += 8)
        for (u32 bx = 0; bx < c.width; bx += 8)
            for (u32 y = by; y < by + 8 && y < c.height; ++y)
                for (u32 px = bx; px < bx + 8 && px < c.width; ++px)
                    set.rays.push_back({c.eye, direction_through(c, float(px) + 0.5f, float(y) + 0.5f)});
    find_hits(scene, set);
    return set;
}

RaySet bounce_rays(RayScene& scene, const RaySet& from) {
    RaySet set;
    Rng rng(17);
    for (std::size_t i = 0; i < from.rays.size(); ++i) {
        if (from.hits[i].kind != HitKind::cube) continue;
        // A point of the unit sphere about the normal's end.
        const float z = 2 * rng.unit() - 1, turn = 6.2831853f * rng.unit(), r = std::sqrt(1 - z * z);
        const IVec3 n = kFaceNormal[from.hits[i].face];
        const Vec3 dir = normalized(Vec3{float(n.x), float(n.y), float(n.z)} * 1.0001f +
                                    Vec3{r * std::cos(turn), r * std::sin(turn), z});
        set.rays.push_back({outside(from.rays[i], from.hits[i]), dir});
    }
    find_hits(scene, set);
    return set;
}

RaySet sun_rays(RayScene& scene, const RaySet& from) {
    RaySet set;
    const Vec3 sun = normalized({0.45f, 0.7f, 0.35f});
    for (std::size_t i = 0; i < from.rays.size(); ++i) {
        if (from.hits[i].kind != HitKind::cube) continue;
        const IVec3 n = kFaceNormal[from.hits[i].face];
        if (float(n.x) * sun.x + float(n.y) * sun.y + float(n.z) * sun.z <= 0) continue;
        set.rays.push_back({outside(from.rays[i], from.hits[i]), sun});
    }
    find_hits(scene, set);
    return set;
}

} // namespace vitrail::bench
