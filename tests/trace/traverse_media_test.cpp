// Glass, water with its surface, leaves, thin glass, plants: everything that a ray meets on its way, in order, equals a
// list made cell by cell from all cells that the ray passes (found by brute force), in double.
#include "grid_world.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace vitrail::trace {
namespace {

struct Event {
    double t = 0;
    IVec3 cell;
    HitKind kind = HitKind::nothing;
    u32 face = 0, quad = 0;
    bool leaving = false, opaque = false;
};

class Reference {
public:
    Reference(GridWorld& world, const Ray& ray, u32 medium)
        : world_(world)
        , scene_(world.slow_scene())
        , ray_(ray)
        , medium_(medium) {
        struct Cell {
            IVec3 r;
            Passage p;
        };
        std::vector<Cell> cells;
        const IVec3 o = world.corner();
        for (i32 y = 0; y < GridWorld::kSize; ++y)
            for (i32 z = 0; z < GridWorld::kSize; ++z)
                for (i32 x = 0; x < GridWorld::kSize; ++x) {
                    const IVec3 r{o.x + x - ray.from.cell.x, o.y + y - ray.from.cell.y, o.z + z - ray.from.cell.z};
                    const Passage p = passage(ray, r);
                    if (p.passed) cells.push_back({r, p});
                }
        std::sort(cells.begin(), cells.end(), [](const Cell& a, const Cell& b) { return a.p.in.before(b.p.in); });
        IVec3 before;
        bool done = false;
        for (std::size_t i = 0; i < cells.size() && !done; ++i) {
            done = visit(cells[i].r, cells[i].p, i != 0, before);
            before = cells[i].r;
        }
        // Beyond the window there is air.
        if (done || cells.empty() || cells.back().p.out.axis == 3) return;
        const Crossing& out = cells.back().p.out;
        if (sheeted(record(before))) sheet(out.t, before, out_face(out.axis), true);
        if (medium_ != 0) face(out.t, before, out_face(out.axis), true, false);
    }
    std::vector<Event> events;

private:
    IVec3 place(IVec3 r) const { return {ray_.from.cell.x + r.x, ray_.from.cell.y + r.y, ray_.from.cell.z + r.z}; }
    const StateRecord& record(IVec3 r) const { return world_.content.states[world_.state(place(r))]; }
    bool up(u32 axis) const { return (axis == 0 ? ray_.dir.x : axis == 1 ? ray_.dir.y : ray_.dir.z) > 0; }
    u32 in_face(u32 axis) const { return axis * 2 + (up(axis) ? 0 : 1); }
    u32 out_face(u32 axis) const { return axis * 2 + (up(axis) ? 1 : 0); }
    Vec3 local(IVec3 r, double t) const {
        return {float(double(ray_.from.at.x) + t * double(ray_.dir.x) - r.x),
                float(double(ray_.from.at.y) + t * double(ray_.dir.y) - r.y),
                float(double(ray_.from.at.z) + t * double(ray_.dir.z) - r.z)};
    }
    bool sheeted(const StateRecord& r) const {
        return r.kind == CellKind::cutout || (r.kind == CellKind::medium && r.medium == 0);
    }
    void face(double t, IVec3 r, u32 f, bool leaving, bool opaque) {
        events.push_back({t, place(r), HitKind::cube, f, 0, leaving, opaque});
    }
    // The sheet of a cell's face, unless its texel there is a hole.
    void sheet(double t, IVec3 r, u32 f, bool leaving) {
        const StateRecord& rec = record(r);
        if (rec.kind == CellKind::cutout) {
            const Vec2 uv = face_uv(rec.faces[f], local(r, t));
            const u32 x = u32(uv.x * 4), y = u32(uv.y * 4);
            if (world_.content.texels[y * 4 + x] >> 31 == 0) return;
        }
        face(t, r, f, leaving, false);
    }

    bool visit(IVec3 r, const Passage& p, bool entered, IVec3 before) {
        const StateRecord& rec = record(r);
        const double t0 = entered ? p.in.t : 0;
        if (entered) {
            const StateRecord& prev = record(before);
            const u32 f = in_face(p.in.axis), b = out_face(p.in.axis);
            if (rec.kind == CellKind::cube) {
                face(t0, r, f, false, true);
                return true;
            }
            if (sheeted(rec) && sheeted(prev)) {
                const bool equal_glass = rec.kind == CellKind::medium && &rec == &prev;
                if (!equal_glass && up(p.in.axis))
                    sheet(t0, before, b, true);
                else if (!equal_glass)
                    sheet(t0, r, f, false);
            } else if (sheeted(rec)) {
                sheet(t0, r, f, false);
            } else if (sheeted(prev)) {
                sheet(t0, before, b, true);
            }
            u32 here = rec.medium;
            bool full = true;
            const bool fluid = rec.medium == 1;
            if (fluid) {
                const LiquidTop top = liquid_top(scene_, place(r), 1);
                full = top.full;
                const Vec3 at = local(r, t0);
                if (!full && double(at.y) > double(liquid_height_at(top, at.x, at.z))) here = 0;
            }
            if (here != medium_) {
                if (fluid && (prev.medium == 1 || (!full && f == 3)))
                    events.push_back({t0, place(r), HitKind::quad, 3, kLiquidSurface, here == 0, false});
                else if (here != 0)
                    face(t0, r, f, false, false);
                else
                    face(t0, before, b, true, false);
                medium_ = here;
            }
        }
        inside(r, rec, t0, p.out.t);
        return false;
    }

    // Crossed sheets and the surface of water, by distance.
    void inside(IVec3 r, const StateRecord& rec, double t0, double t1) {
        std::vector<Event> met;
        const Vec3 at = local(r, t0);
        for (u32 i = 0; i < rec.quads; ++i) {
            // x = z, or x + z = 1.
            const double side = i ? 1 : -1, offset = i ? 1 : 0;
            const double speed = double(ray_.dir.x) + side * double(ray_.dir.z);
            if (std::abs(speed) < 1e-9) continue;
            const double t = (offset - double(at.x) - side * double(at.z)) / speed;
            const Vec3 q = at + ray_.dir * float(t);
            if (t0 + t <= 0 || t < -1e-6 || t0 + t > t1 + 1e-6 || q.y < 0 || q.y > 1 || q.x < 0 || q.x > 1) continue;
            const u32 u = u32(clamp(q.x, 0.0f, 0.9999f) * 4), v = u32(clamp(1 - q.y, 0.0f, 0.9999f) * 4);
            if (world_.content.texels[v * 4 + u] >> 31 == 0) continue;
            // Normals look to +x on the falling sheet, and against on the rising one; both sides show.
            met.push_back(
                {t0 + t, place(r), HitKind::quad, 0, i, dot(ray_.dir, world_.content.quads[i].normal) > 0, false});
        }
        if (rec.medium == 1 && !liquid_top(scene_, place(r), 1).full) {
            const LiquidTop top = liquid_top(scene_, place(r), 1);
            float t = 0, from = 0;
            while (hit_liquid_top(top, at, ray_.dir, from, float(t1 - t0), medium_ == 1, t)) {
                met.push_back({t0 + double(t), place(r), HitKind::quad, 3, kLiquidSurface, medium_ == 1, false});
                medium_ ^= 1;
                from = t + 1e-5f;
            }
        }
        std::sort(met.begin(), met.end(), [](const Event& a, const Event& b) { return a.t < b.t; });
        events.insert(events.end(), met.begin(), met.end());
    }

    GridWorld& world_;
    SceneView scene_;
    Ray ray_;
    u32 medium_;
};

std::string text(const Hit& h) {
    return fmt::format("kind {} cell {} {} {} face {} quad {} leaving {}", int(h.kind), h.cell.x, h.cell.y, h.cell.z,
                       h.face, h.quad, h.leaving);
}
std::string text(const Event& e) {
    return fmt::format("kind {} cell {} {} {} face {} quad {} leaving {}", int(e.kind), e.cell.x, e.cell.y, e.cell.z,
                       e.face, e.quad, e.leaving);
}

// Follows rays to their first opaque cube. Rays whose events come within a hair of each other, or graze a texel's edge,
// are told apart by rounding: they are let go, but must be few.
void compare(GridWorld& world, Rng& rng, u32 rays, u32 least_events) {
    const SceneView s = world.scene();
    u32 differ = 0, events = 0;
    std::string what;
    for (u32 i = 0; i < rays; ++i) {
        const Ray ray = test_ray(rng, world, i % 2 ? 0 : 4);
        const StateRecord& start = world.content.states[world.state(ray.from.cell)];
        if (start.kind == CellKind::cube) continue;
        u32 medium = start.medium;
        if (medium == 1) {
            const LiquidTop top = liquid_top(s, ray.from.cell, 1);
            if (!top.full && ray.from.at.y > liquid_height_at(top, ray.from.at.x, ray.from.at.z)) medium = 0;
        }
        const Reference right(world, ray, medium);
        std::vector<Hit> panes;
        const bool dark = shadowed(s, ray, kFar, medium, [&](const Hit& h) {
            panes.push_back(h);
            return false;
        });
        const bool expected_dark = !right.events.empty() && right.events.back().opaque;
        bool equal = dark == expected_dark && panes.size() + (dark ? 1 : 0) == right.events.size();
        for (std::size_t k = 0; equal && k < panes.size(); ++k) {
            equal = text(panes[k]) == text(right.events[k]) && std::abs(double(panes[k].t) - right.events[k].t) < 1e-4;
            if (!equal) what = text(panes[k]) + " for " + text(right.events[k]);
        }
        Hit hit;
        const bool any = closest_hit(s, ray, kFar, medium, hit);
        if (equal) {
            ASSERT_EQ(any, !right.events.empty());
            if (any) ASSERT_EQ(text(hit), text(right.events[0]));
        }
        differ += !equal;
        events += u32(right.events.size());
    }
    EXPECT_LE(differ, rays / 100) << what;
    EXPECT_GT(events, least_events);
}

TEST(TraverseMedia, GlassAndWater) {
    Rng rng(21);
    GridWorld world;
    world.fill(rng, {{t_glass, 0.1, 4}, {t_water, 0.1, 8}, {t_stone, 0.01}});
    compare(world, rng, 150, 300);
}

TEST(TraverseMedia, WaterOfManyHeights) {
    Rng rng(22);
    GridWorld world;
    // A sea with a bottom of plants, and single blocks of water above it.
    for (i32 z = 0; z < 64; ++z)
        for (i32 x = 0; x < 64; ++x)
            for (i32 y = 0; y < 40; ++y)
                world.at(x, y, z) = y < 12 ? t_stone : y < 13 ? t_sunken : t_water;
    for (u32 i = 0; i < 3000; ++i)
        world.at(i32(rng.below(64)), 30 + i32(rng.below(12)), i32(rng.below(64))) = rng.below(2) ? t_water : t_air;
    world.upload();
    compare(world, rng, 150, 180);
}

TEST(TraverseMedia, SheetsAndPlants) {
    Rng rng(23);
    GridWorld world;
    world.fill(rng, {{t_leaves, 0.1, 2}, {t_thin, 0.05, 2}, {t_plant, 0.05}, {t_stone, 0.01}});
    compare(world, rng, 150, 550);
}

TEST(TraverseMedia, EverythingAtOnce) {
    Rng rng(24);
    GridWorld world;
    for (u32 state = t_stone; state < t_states; ++state)
        world.scatter(rng, state, 0.03, state == t_water ? 4 : 1);
    world.upload();
    compare(world, rng, 150, 600);
}

// Rays that water mirrors flatly pass above cell after cell of it; they are told so by the cells above alone. What they
// meet is the same as when each cell's surface is worked out.
TEST(TraverseMedia, WaysAboveWaterMeetTheSame) {
    Rng rng(25);
    GridWorld world;
    for (i32 i = 0; i < 64 * 64 * 22; ++i)
        world.at(i % 64, i / 4096, i / 64 % 64) = i / 4096 < 18 ? t_stone : t_water;
    for (u32 i = 0; i < 60; ++i) // drops on it, holes in it, sunken plants, stones
        world.at(i32(rng.below(64)), 21 + i32(rng.below(2)), i32(rng.below(64))) = i % 4 == 0   ? t_air
                                                                                   : i % 4 == 1 ? t_sunken
                                                                                   : i % 4 == 2 ? t_stone
                                                                                                : t_water;
    world.upload();
    SceneView quick = world.scene(), slow = world.slow_scene();
    std::vector<MediumRecord> media = world.content.media;
    media[1].liquid_top = 256; // no promise
    slow.media = media.data();
    const IVec3 o = world.corner();
    u32 far = 0, water = 0;
    for (u32 i = 0; i < 4000; ++i) {
        const float turn = rng.unit() * 6.2831853f, rise = (rng.unit() - 0.5f) * (i % 2 ? 0.004f : 0.1f);
        const Ray ray{{{o.x + 2 + i32(rng.below(60)), o.y + 21, o.z + 2 + i32(rng.below(60))},
                       {rng.unit(), i % 3 ? 0.8907f + 0.1f * rng.unit() : 0.890625f, rng.unit()}},
                      normalized({std::cos(turn), rise, std::sin(turn)})};
        Hit a, b;
        ASSERT_EQ(closest_hit(quick, ray, kFar, 0, a), closest_hit(slow, ray, kFar, 0, b));
        ASSERT_EQ(a.kind, b.kind);
        if (a.kind == HitKind::nothing) continue;
        ASSERT_EQ(a.t, b.t);
        ASSERT_EQ(a.cell, b.cell);
        ASSERT_EQ(a.state, b.state);
        ASSERT_EQ(a.quad, b.quad);
        far += a.t > 8;
        water += a.state == t_water;
    }
    EXPECT_GT(far, 300u);
    EXPECT_GT(water, 300u);
}

// A deep sea costs no more than air: the way through it is a few steps.
TEST(TraverseMedia, DeepWaterIsCrossedInFewSteps) {
    GridWorld world;
    for (i32 i = 0; i < 64 * 64 * 64; ++i)
        world.at(i % 64, i / 4096, i / 64 % 64) = t_water;
    world.upload();
    const SceneView s = world.scene();
    const IVec3 o = world.corner();
    const Ray ray{{{o.x + 1, o.y + 60, o.z + 1}, {0.5f, 0.5f, 0.5f}}, normalized({1, -0.9f, 0.95f})};
    Walk w = start_walk(ray);
    u32 steps = 12;
    EXPECT_EQ(next_in_water(s.grid, ray, w, 1e30, steps), Walked::stopped);
    EXPECT_FALSE(in_window_cell(s.grid, w.cell()));
}

// Boxes of entities hide what is behind them, and are hidden by what is before.
TEST(TraverseMedia, EntityBoxes) {
    Rng rng(25);
    GridWorld world;
    world.fill(rng, {{t_stone, 0.001}});
    constexpr u32 kBoxes = 37;
    world.scatter_boxes(rng, kBoxes);
    const SceneView s = world.scene();
    ASSERT_EQ(s.box_count, kBoxes);
    const EntityBox* boxes = s.boxes;
    SceneView bare = s;
    bare.box_count = 0;
    u32 met = 0;
    for (u32 i = 0; i < 400; ++i) {
        Ray ray = test_ray(rng, world, 0);
        if (i % 2) ray.dir = normalized(offset(ray.from, boxes[i % kBoxes].least) + boxes[i % kBoxes].size * 0.5f);
        float nearest = kFar;
        u32 which = 0;
        for (u32 b = 0; b < kBoxes; ++b) {
            const Vec3 to = offset(ray.from, boxes[b].least);
            double in = -1, out = 1e30;
            const float p[3] = {to.x, to.y, to.z}, d[3] = {ray.dir.x, ray.dir.y, ray.dir.z},
                        size[3] = {boxes[b].size.x, boxes[b].size.y, boxes[b].size.z};
            for (u32 a = 0; a < 3; ++a) {
                const double x = double(p[a]) / double(d[a]), y = (double(p[a]) + double(size[a])) / double(d[a]);
                in = std::max(in, std::min(x, y)), out = std::min(out, std::max(x, y));
            }
            if (in > 0 && in < out && in < double(nearest)) nearest = float(in), which = b;
        }
        Hit hit, block;
        const bool any = closest_hit(s, ray, kFar, 0, hit), blocked = closest_hit(bare, ray, kFar, 0, block);
        if (nearest < block.t - 1e-3f) {
            ASSERT_TRUE(any);
            ASSERT_EQ(hit.kind, HitKind::box) << i;
            ASSERT_EQ(hit.quad, which);
            ASSERT_NEAR(hit.t, nearest, 1e-3f);
            ASSERT_TRUE(shadowed(s, ray, nearest + 0.01f, 0, [](const Hit&) { return false; }));
            ++met;
        } else if (nearest > block.t + 1e-3f || !blocked) {
            ASSERT_EQ(hit.kind, block.kind);
            ASSERT_EQ(hit.t, block.t);
        }
    }
    EXPECT_GT(met, 10u);
}

} // namespace
} // namespace vitrail::trace
