// Lamps sampled directly: what is listed, chances and densities, and light against quadrature.
#include "trace/kernel/lights.h"

#include "base/rng.h"
#include "trace/lamp_world.h"

#include <gtest/gtest.h>

#include <cstring>
#include <set>

namespace vitrail::test {
namespace {

using namespace trace;

Vec3 random_direction(Rng& rng) {
    const float z = 2 * rng.unit() - 1, turn = 6.2831853f * rng.unit(), r = std::sqrt(std::fmax(0.0f, 1 - z * z));
    return {r * std::cos(turn), r * std::sin(turn), z};
}

// Lamps of all kinds, in clusters, over several regions of chunks.
void scatter(LampWorld& w, Rng& rng, int count) {
    const u32 kinds[] = {LampWorld::lamp,      LampWorld::torch, LampWorld::lava,
                         LampWorld::half_lamp, LampWorld::spike, LampWorld::stone};
    for (int i = 0; i < count; ++i) {
        const i32 wide = rng.below(3) ? 10 : 100;
        const IVec3 cell{i32(rng.below(u32(2 * wide))) - wide, i32(rng.below(40)) - 20,
                         i32(rng.below(u32(2 * wide))) - wide};
        w.set(cell, kinds[rng.below(6)]);
    }
}

struct Lit {
    LampWorld world;
    LightStore store;
    Lit() { store.set_states(world.view, u32(world.quads.size())); }
    void update() {
        world.publish_all(&store);
        store.update(world.view.grid);
        world.view.lights = store.view();
    }
};

TEST(Lights, OpenFacesAlone) {
    Lit l;
    for (i32 x = 0; x < 5; ++x)
        for (i32 z = 0; z < 5; ++z) {
            l.world.set({x, 0, z}, LampWorld::lava);
            l.world.set({x, -1, z}, LampWorld::lava);
            l.world.set({x, -2, z}, LampWorld::stone);
        }
    l.world.set({15, 4, 0}, LampWorld::lamp); // at a chunk's border
    l.world.set({16, 4, 0}, LampWorld::stone);
    l.world.set({40, 4, 0}, LampWorld::half_lamp);
    for (u32 f = 0; f < 6; ++f) { // walled in
        const IVec3 n = kFaceNormal[f];
        l.world.set({60 + n.x, n.y, n.z}, LampWorld::stone);
    }
    l.world.set({60, 0, 0}, LampWorld::lamp);
    l.update();
    std::map<std::array<i32, 3>, Emitter> found;
    for (const Emitter& e : l.store.emitters())
        if (e.power > 0) found[{e.cell.x, e.cell.y, e.cell.z}] = e;
    EXPECT_EQ(found.size(), l.store.count());
    EXPECT_EQ(found.size(), 25u + 16 + 2); // the lower lava's inner cells are covered
    EXPECT_EQ((found[{2, 0, 2}].faces), 8u);
    EXPECT_EQ((found[{0, 0, 0}].faces), 8u | 1 | 16);
    EXPECT_EQ((found[{15, 4, 0}].faces), 63u & ~2u);
    EXPECT_EQ((found[{40, 4, 0}].faces), 63u);
    EXPECT_NEAR((found[{40, 4, 0}].power), 3, 1e-4);
    EXPECT_NEAR((found[{15, 4, 0}].power), 10, 1e-4);
    EXPECT_EQ((find_emitter(l.world.view.lights, {60, 0, 0})), kNoEmitter);
}

// Less than 1 only where the tree leads to lamps that cannot shine there: a box seems to reach, its lamps do not.
TEST(Lights, ChancesSumToOne) {
    Lit l;
    Rng rng(3);
    scatter(l.world, rng, 400);
    l.update();
    const LightView& lights = l.world.view.lights;
    ASSERT_GT(lights.count, 200u);
    double mean = 0;
    int whole = 0;
    for (int i = 0; i < 300; ++i) {
        const Place at{{i32(rng.below(60)) - 30, i32(rng.below(50)) - 25, i32(rng.below(60)) - 30},
                       {rng.unit(), rng.unit(), rng.unit()}};
        const Vec3 normal = i % 3 ? random_direction(rng) : Vec3{}, p = light_place(lights, at);
        double sum = 0;
        bool all = true;
        for (u32 e = 0; e < l.store.emitters().size(); ++e) {
            if (!(l.store.emitters()[e].power > 0)) continue;
            const float chance = chance_of_emitter(lights, e, p, normal);
            sum += chance;
            if (chance == 0) {
                all = false;
                EXPECT_EQ(light_importance(lights.nodes[lights.emitters[e].node], p, normal), 0);
            }
        }
        EXPECT_LT(sum, 1.0001);
        if (all) EXPECT_NEAR(sum, 1, 1e-4);
        mean += sum / 300, whole += all;
        float choose = rng.unit(), chance = 0;
        const u32 chosen = choose_emitter(lights, p, normal, choose, chance);
        if (chosen == kNoEmitter) {
            EXPECT_LT(sum, 0.9999);
            continue;
        }
        EXPECT_NEAR(chance / chance_of_emitter(lights, chosen, p, normal), 1, 1e-4);
        EXPECT_GE(choose, 0);
        EXPECT_LT(choose, 1);
    }
    EXPECT_GT(mean, 0.8);
    EXPECT_GT(whole, 0);
}

// Irradiance over a lamp's radiance by fine quadrature over its pieces; nothing hides anything.
double quadrature(const LampWorld& w, IVec3 cell, u32 state, u32 faces, Place at, Vec3 normal) {
    constexpr int n = 200;
    double sum = 0;
    const auto piece = [&](Vec3 corner, Vec3 a, Vec3 b, Vec3 facing, bool both, bool triangle) {
        const double area = length(cross(a, b)) / (n * n);
        for (int i = 0; i < n * n; ++i) {
            const float x = (float(i % n) + 0.5f) / n, y = (float(i / n) + 0.5f) / n;
            const int across = i % n + i / n - (n - 1); // cells on the rim of a triangle count half
            if (triangle && across > 0) continue;
            const Vec3 way = offset(at, {cell, {}}) + corner + a * x + b * y;
            const double d2 = dot(way, way), d = std::sqrt(d2);
            double there = -dot(facing, way) / d;
            if (both) there = std::abs(there);
            const double here = dot(normal, way) / d;
            if (there > 0 && here > 0) sum += there * here / d2 * area * (triangle && across == 0 ? 0.5 : 1);
        }
    };
    for (u32 f = 0; f < 6; ++f) {
        if (!(faces >> f & 1)) continue;
        const float top =
            w.records[state].kind == CellKind::liquid ? float(w.records[state].liquid_height + 1) / 256 : 1;
        const IVec3 o = kFaceNormal[f];
        const Vec3 out{float(o.x), float(o.y), float(o.z)};
        const u32 axis = f >> 1;
        Vec3 corner = axis == 0   ? Vec3{f & 1 ? 1.0f : 0, 0, 0}
                      : axis == 1 ? Vec3{0, f & 1 ? top : 0, 0}
                                  : Vec3{0, 0, f & 1 ? 1.0f : 0};
        const Vec3 a = axis == 0 ? Vec3{0, 0, 1} : Vec3{1, 0, 0}, b = axis == 1 ? Vec3{0, 0, 1} : Vec3{0, top, 0};
        piece(corner, a, b, out, false, false);
    }
    if (faces & Emitter::kQuads)
        for (u32 i = 0; i < w.records[state].quads; ++i) {
            const TraceQuad& q = w.quads[w.records[state].first_quad + i];
            piece(q.corner, q.edge_a, q.edge_b, q.normal, q.look & TraceQuad::kTwoSided, q.look & TraceQuad::kTriangle);
        }
    return sum;
}

TEST(Lights, IrradianceAsQuadrature) {
    Rng rng(5);
    for (u32 state : {u32(LampWorld::lamp), u32(LampWorld::torch), u32(LampWorld::lava), u32(LampWorld::spike)}) {
        Lit l;
        const IVec3 cell{3, 2, -4};
        l.world.set(cell, state);
        l.update();
        const SceneView& s = l.world.view;
        ASSERT_EQ(s.lights.count, 1u);
        const u32 faces = s.lights.emitters[find_emitter(s.lights, cell)].faces;
        const Place places[] = {{{3, 3, -4}, {0.2f, 0.3f, 0.9f}},
                                {{4, 2, -4}, {0.05f, 0.4f, 0.4f}},
                                {{1, 5, -3}, {0.5f, 0.5f, 0.5f}},
                                {{-9, 9, 4}, {0.1f, 0.2f, 0.3f}},
                                {{4, 0, -5}, {0.7f, 0.1f, 0.6f}}};
        for (const Place& at : places) {
            const Vec3 to_lamp = normalized(offset(at, {cell, {0.5f, 0.4f, 0.5f}}));
            const Vec3 normal = normalized(to_lamp + random_direction(rng) * 0.7f);
            const double want = quadrature(l.world, cell, state, faces, at, normal);
            double sum = 0, sum2 = 0;
            constexpr int n = 40000;
            for (int i = 0; i < n; ++i) {
                EmitterSample e;
                if (!sample_emitter(s, at, normal, rng.unit(), {rng.unit(), rng.unit()}, e)) continue;
                const double v = std::fmax(0.0f, dot(normal, e.dir)) / e.pdf;
                sum += v, sum2 += v * v;
            }
            const double mean = sum / n, sigma = std::sqrt((sum2 / n - mean * mean) / n);
            EXPECT_NEAR(mean, want, 4 * sigma + 0.003 * want) << state << " at " << at.cell.x;
        }
    }
}

TEST(Lights, DensityOfHitsIsThatOfSamples) {
    Lit l;
    Rng rng(7);
    scatter(l.world, rng, 200);
    l.update();
    const SceneView& s = l.world.view;
    int compared = 0;
    for (int i = 0; i < 4000; ++i) {
        const Place at{{i32(rng.below(40)) - 20, i32(rng.below(40)) - 20, i32(rng.below(40)) - 20},
                       {rng.unit(), rng.unit(), rng.unit()}};
        const Vec3 normal = i & 1 ? random_direction(rng) : Vec3{};
        EmitterSample e;
        if (!sample_emitter(s, at, normal, rng.unit(), {rng.unit(), rng.unit()}, e)) continue;
        Vec3 facing{};
        if (e.hit.kind == HitKind::cube) {
            const IVec3 n = kFaceNormal[e.hit.face];
            facing = {float(n.x), float(n.y), float(n.z)};
        } else if (e.hit.quad == kLiquidSurface) {
            facing = liquid_normal(liquid_top(s, e.hit.cell, 1), e.hit.u, e.hit.v);
        } else {
            facing = s.quads[e.hit.quad].normal;
        }
        const float pdf = emitter_pdf(s, at, normal, e.dir, e.hit, facing);
        EXPECT_NEAR(pdf / e.pdf, 1, 2e-3) << int(e.hit.kind);
        ++compared;
    }
    EXPECT_GT(compared, 3000);
}

// Rays at random find a cube with the density that is said: its integral over the sphere is 1.
TEST(Lights, DensityIntegratesToOneOverWhatIsSeen) {
    Lit l;
    const IVec3 cell{0, 0, 0};
    l.world.set(cell, LampWorld::lamp);
    l.update();
    const SceneView& s = l.world.view;
    Rng rng(11);
    for (const Place& at : {Place{{1, 1, 0}, {0.3f, 0.4f, 0.5f}}, Place{{0, 1, 0}, {0.5f, 0.1f, 0.2f}},
                            Place{{3, 4, -2}, {0.5f, 0.1f, 0.2f}}}) {
        double sum = 0, sum2 = 0;
        constexpr int n = 400000;
        const Vec3 q = offset({cell, {}}, at);
        for (int i = 0; i < n; ++i) {
            const Vec3 d = random_direction(rng);
            const float o[3] = {q.x, q.y, q.z}, v[3] = {d.x, d.y, d.z};
            float t0 = 0, t1 = kFar;
            u32 face = 0;
            for (u32 a = 0; a < 3; ++a) {
                const float ta = (0 - o[a]) / v[a], tb = (1 - o[a]) / v[a];
                if (std::fmin(ta, tb) > t0) t0 = std::fmin(ta, tb), face = 2 * a + (v[a] < 0);
                t1 = std::fmin(t1, std::fmax(ta, tb));
            }
            if (t0 >= t1) continue;
            Hit hit;
            hit.t = t0, hit.cell = cell, hit.state = LampWorld::lamp, hit.kind = HitKind::cube, hit.face = u8(face);
            const IVec3 f = kFaceNormal[face];
            const double p = emitter_pdf(s, at, {}, d, hit, {float(f.x), float(f.y), float(f.z)}) * 12.566370614;
            sum += p, sum2 += p * p;
        }
        const double mean = sum / n, sigma = std::sqrt((sum2 / n - mean * mean) / n);
        EXPECT_NEAR(mean, 1, 4 * sigma + 1e-3);
    }
}

// After any edits the lamps, and their chances from anywhere, are those of a store made anew.
TEST(Lights, EditsAsMadeAnew) {
    Lit l;
    Rng rng(13);
    scatter(l.world, rng, 300);
    l.update();
    for (int round = 0; round < 30; ++round) {
        std::set<std::array<i32, 3>> touched;
        for (int i = 0; i < 5; ++i) {
            const IVec3 cell{i32(rng.below(40)) - 20, i32(rng.below(40)) - 20, i32(rng.below(40)) - 20};
            l.world.set(cell, rng.below(u32(LampWorld::states_end)));
            touched.insert({cell.x >> 4, cell.y >> 4, cell.z >> 4});
        }
        if (round == 20) { // a chunk goes
            l.world.chunks.erase({0, 0, 0});
            touched.insert({0, 0, 0});
        }
        for (const auto& at : touched)
            l.world.publish(&l.store, {at[0], at[1], at[2]});
        l.store.update(l.world.view.grid);
        if (round % 5 != 4 && round != 20) continue;
        LightStore fresh;
        fresh.set_states(l.world.view, u32(l.world.quads.size()));
        for (const auto& [at, chunk] : l.world.chunks)
            fresh.mark({at[0], at[1], at[2]}, chunk);
        fresh.update(l.world.view.grid);
        ASSERT_EQ(l.store.count(), fresh.count());
        const LightView a = l.store.view(), b = fresh.view();
        const Vec3 p{rng.unit() * 30, rng.unit() * 30, rng.unit() * 30};
        double sum = 0;
        for (const Emitter& e : fresh.emitters()) {
            if (!(e.power > 0)) continue;
            const u32 there = find_emitter(a, e.cell);
            ASSERT_NE(there, kNoEmitter);
            EXPECT_EQ(a.emitters[there].faces, e.faces);
            const float chance = chance_of_emitter(a, there, p, {});
            EXPECT_EQ(chance, chance_of_emitter(b, find_emitter(b, e.cell), p, {}));
            sum += chance;
        }
        EXPECT_LT(sum, 1.0001);
        EXPECT_GT(sum, 0.5);
    }
}

// What is sent to a device after each change makes its copy equal.
TEST(Lights, ChangesBringACopyUpToDate) {
    Lit l;
    Rng rng(17);
    std::vector<Emitter> emitters;
    std::vector<LightNode> nodes;
    std::vector<u32> table;
    std::size_t sent = 0;
    for (int round = 0; round < 12; ++round) {
        if (round == 0) scatter(l.world, rng, 1500), l.world.publish_all(&l.store);
        const IVec3 cell{i32(rng.below(30)), 5, i32(rng.below(30))};
        l.world.set(cell, LampWorld::lamp);
        l.world.publish(&l.store, {cell.x >> 4, 0, cell.z >> 4});
        l.store.update(l.world.view.grid);
        const LightStore::Changes c = l.store.take_changes();
        const LightView v = l.store.view();
        emitters.resize(c.emitter_size), nodes.resize(c.node_size), table.resize(c.table_size);
        sent = 0;
        for (ArrayRange r : c.emitters)
            std::copy_n(v.emitters + r.first, r.count, emitters.begin() + r.first), sent += r.count;
        for (ArrayRange r : c.nodes)
            std::copy_n(v.nodes + r.first, r.count, nodes.begin() + r.first), sent += r.count;
        for (ArrayRange r : c.table)
            std::copy_n(v.table + r.first, r.count, table.begin() + r.first);
        ASSERT_EQ(std::memcmp(nodes.data(), v.nodes, nodes.size() * sizeof(LightNode)), 0);
        ASSERT_EQ(std::memcmp(table.data(), v.table, table.size() * sizeof(u32)), 0);
        for (u32 i = 0; i < emitters.size(); ++i)
            ASSERT_EQ(emitters[i].node, v.emitters[i].node);
    }
    EXPECT_LT(sent, (emitters.size() + nodes.size()) / 2);
}

// The window follows the player: lamps that leave it go.
TEST(Lights, OnlyTheWindow) {
    Lit l;
    l.world.set({-120, 0, 0}, LampWorld::lamp);
    l.world.set({20, 0, 0}, LampWorld::lamp);
    l.update();
    EXPECT_EQ(l.store.count(), 2u);
    l.world.view.grid.first.x += 4;
    l.world.publish_all(nullptr);
    l.store.update(l.world.view.grid);
    EXPECT_EQ(l.store.count(), 1u);
    EXPECT_NE(find_emitter(l.store.view(), {20, 0, 0}), kNoEmitter);
}

} // namespace
} // namespace vitrail::test
