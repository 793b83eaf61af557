// Surfaces: what they send back and let through against integrals, tables and the laws of optics.
#include "trace/kernel/bsdf.h"
#include "trace/kernel/sampler.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <vector>

namespace vitrail::trace {

static SurfacePoint surface_of(Optics optics, float roughness, Vec3 albedo = {1, 1, 1}) {
    SurfacePoint p{};
    p.face = p.normal = normalized({0.3f, 0.8f, -0.4f});
    p.optics = optics;
    p.roughness = roughness;
    p.albedo = albedo;
    return p;
}
static Vec3 at_cosine(const SurfacePoint& p, float cosine, float turn = 0.7f) {
    const float s = std::sqrt(1 - cosine * cosine);
    return to_world(frame_of(p.normal), {s * std::cos(turn), s * std::sin(turn), cosine});
}

struct Case {
    std::string name;
    SurfacePoint point;
};
static std::vector<Case> all_cases() {
    std::vector<Case> out;
    for (float r : {0.0f, 0.02f, 0.1f, 0.25f, 0.5f, 0.75f, 1.0f}) {
        out.push_back({fmt::format("matte {}", r), surface_of(Optics::matte, r)});
        out.push_back({fmt::format("metal {}", r), surface_of(Optics::metal, r)});
        for (float ior : {1.33f, 2.3f, 1 / 1.33f, 1 / 2.3f}) {
            SurfacePoint p = surface_of(Optics::dielectric, r);
            p.ior = ior;
            out.push_back({fmt::format("dielectric {} {}", r, ior), p});
        }
    }
    out.push_back({"leaf", surface_of(Optics::leaf, 1)});
    SurfacePoint plant = surface_of(Optics::leaf, 1);
    plant.plant = true;
    out.push_back({"plant", plant});
    SurfacePoint thin = surface_of(Optics::thin, 0);
    for (float opacity : {0.0f, 0.3f, 1.0f}) {
        thin.opacity = opacity;
        out.push_back({fmt::format("thin {}", opacity), thin});
    }
    SurfacePoint water = surface_of(Optics::water, 0);
    water.ior = 1.33f;
    out.push_back({"water", water});
    return out;
}

TEST(Fresnel, TabulatedValues) {
    // Born and Wolf, Principles of Optics: glass of 1.52 in air, by degrees: mean of both polarizations.
    EXPECT_NEAR(fresnel_dielectric(1, 1.5f), 0.04, 1e-6);
    EXPECT_NEAR(fresnel_dielectric(1, 1.333f), 0.02037, 1e-5);
    EXPECT_NEAR(fresnel_dielectric(1, 2.42f), 0.17240, 1e-5);
    const auto degrees = [](double a) { return float(std::cos(a * 3.14159265358979 / 180)); };
    EXPECT_NEAR(fresnel_dielectric(degrees(45), 1.5f), 0.05024, 1e-5); // (0.303^2 + 0.092^2) / 2
    EXPECT_NEAR(fresnel_dielectric(degrees(60), 1.5f), 0.08919, 1e-5);
    EXPECT_NEAR(fresnel_dielectric(degrees(80), 1.5f), 0.38776, 1e-4);
    EXPECT_NEAR(fresnel_dielectric(0, 1.5f), 1, 1e-6);
    // Brewster's angle: only one polarization is mirrored, by ((n^2 - 1) / (n^2 + 1))^2.
    EXPECT_NEAR(fresnel_dielectric(std::cos(std::atan(1.5f)), 1.5f), 0.5 * std::pow(1.25 / 3.25, 2), 1e-5);
    // The same from both sides of the border.
    for (float c : {0.2f, 0.6f, 0.95f}) {
        float behind;
        const float f = fresnel_dielectric(c, 1.7f, behind);
        EXPECT_NEAR(fresnel_dielectric(behind, 1 / 1.7f), f, 1e-5);
    }
    // Two faces, summed reflection by reflection.
    const double f = double(fresnel_dielectric(0.6f, 1.5f));
    double sum = f, inside = (1 - f);
    for (int i = 0; i < 50; ++i)
        inside *= f, sum += inside * (1 - f), inside *= f;
    EXPECT_NEAR(slab_reflectance(0.6f, 1.5f), sum, 1e-6);
}

TEST(Fresnel, TotalReflectionBeginsAtTheCriticalAngle) {
    for (float n : {1.33f, 1.5f, 2.3f}) {
        const float critical = std::asin(1 / n);
        EXPECT_LT(fresnel_dielectric(std::cos(critical - 0.002f), 1 / n), 1);
        EXPECT_EQ(fresnel_dielectric(std::cos(critical + 0.002f), 1 / n), 1);
    }
}

// Everything around shines 1: what comes back is at most 1, and 1 where nothing is taken.
TEST(Bsdf, WhiteFurnace) {
    for (const Case& c : all_cases())
        for (float cosine : {0.06f, 0.15f, 0.3f, 0.6f, 0.9f, 1.0f}) {
            const Vec3 eye = at_cosine(c.point, cosine);
            double sum = 0;
            constexpr u32 count = 4096;
            for (u32 i = 0; i < count; ++i) {
                Sampler s = make_sampler(1, 2, i, 3);
                const float choose = next_1d(s);
                const BsdfSample b = sample_bsdf(c.point, eye, choose, next_2d(s));
                ASSERT_TRUE(std::isfinite(b.weight.x) && b.weight.x >= 0 && b.pdf >= 0) << c.name;
                EXPECT_NEAR(length(b.dir), 1, 1e-4) << c.name << ' ' << cosine;
                sum += double(b.weight.x) / count;
            }
            const bool rough = c.point.optics == Optics::dielectric && !is_sharp(c.point);
            EXPECT_LT(sum, 1.012) << c.name << ' ' << cosine;
            const double r = double(c.point.roughness);
            EXPECT_GT(sum, 0.988 - (rough ? 0.75 * r * r + 0.12 * std::min(4 * r, 1.0) * (1 - double(cosine)) : 0))
                << c.name << ' ' << cosine;
        }
}

// Means over a grid on the sphere of directions.
template <class F>
static void over_sphere(const SurfacePoint& p, u32 rings, F&& f) {
    const Frame frame = frame_of(p.normal);
    for (u32 i = 0; i < rings; ++i)
        for (u32 j = 0; j < rings; ++j) {
            // Denser near the poles and the horizon, where lobes are narrow.
            const float z = 1 - 2 * (float(i) + 0.5f) / float(rings), turn = 2 * kPi * (float(j) + 0.5f) / float(rings);
            const float s = std::sqrt(1 - z * z);
            f(to_world(frame, {s * std::cos(turn), s * std::sin(turn), z}), double(4 * kPi / float(rings * rings)));
        }
}

TEST(Bsdf, PdfIntegratesToTheChanceOfASample) {
    for (const Case& c : all_cases()) {
        if (!is_sharp(c.point) && c.point.roughness < 0.25f) continue; // too narrow for the grid; see Histogram
        for (float cosine : {0.2f, 0.7f}) {
            const Vec3 eye = at_cosine(c.point, cosine);
            double integral = 0, value = 0, chance = 0, weight = 0;
            over_sphere(c.point, 320, [&](Vec3 d, double solid) {
                const BsdfValue v = bsdf_at(c.point, eye, d);
                integral += double(v.pdf) * solid, value += double(v.value.x) * solid;
                ASSERT_EQ(eval_bsdf(c.point, eye, d).x, v.value.x);
                ASSERT_EQ(pdf_bsdf(c.point, eye, d), v.pdf);
            });
            constexpr u32 count = 1 << 13;
            for (u32 i = 0; i < count; ++i) {
                Sampler s = make_sampler(9, 2, i, 4);
                const float choose = next_1d(s);
                const BsdfSample b = sample_bsdf(c.point, eye, choose, next_2d(s));
                if (b.pdf > 0) chance += 1.0 / count, weight += double(b.weight.x) / count;
            }
            EXPECT_NEAR(integral, chance, 0.012) << c.name << ' ' << cosine;
            EXPECT_NEAR(value, weight, 0.012) << c.name << ' ' << cosine;
        }
    }
}

// Samples fall where the pdf says, and carry what eval says.
TEST(Bsdf, SamplesFollowTheirPdf) {
    for (const Case& c : all_cases())
        for (float cosine : {0.25f, 0.8f}) {
            const Vec3 eye = at_cosine(c.point, cosine);
            constexpr u32 count = 1 << 15, rings = 12, sectors = 12;
            std::vector<double> found(rings * sectors), wanted(rings * sectors);
            const Frame f = frame_of(c.point.normal);
            const auto bin = [&](Vec3 d) {
                const Vec3 l = to_local(f, d);
                const float turn = std::atan2(l.y, l.x) / (2 * kPi) + 0.5f;
                return std::min(u32((l.z + 1) * 0.5f * rings), rings - 1) * sectors +
                       std::min(u32(turn * sectors), sectors - 1);
            };
            for (u32 i = 0; i < count; ++i) {
                Sampler s = make_sampler(3, 3, i, 5);
                const float choose = next_1d(s);
                const BsdfSample b = sample_bsdf(c.point, eye, choose, next_2d(s));
                if (b.pdf == 0) continue;
                found[bin(b.dir)] += 1.0 / count;
                const BsdfValue v = bsdf_at(c.point, eye, b.dir);
                // Two ways of computing the same: the half vector of a sharp lobe comes back with rounding.
                const float near = c.point.roughness < 0.3f ? 0.05f : 0.01f;
                ASSERT_NEAR(v.pdf, b.pdf, near * b.pdf + 1e-4f) << c.name << ' ' << cosine;
                ASSERT_NEAR(v.value.x, b.weight.x * b.pdf, near * b.weight.x * b.pdf + 1e-4f) << c.name;
                EXPECT_EQ(b.through, dot(b.dir, c.point.face) < 0) << c.name;
            }
            if (c.point.roughness < 0.25f && !is_sharp(c.point)) continue; // the grid below is too coarse
            over_sphere(c.point, 360,
                        [&](Vec3 d, double solid) { wanted[bin(d)] += double(pdf_bsdf(c.point, eye, d)) * solid; });
            for (u32 i = 0; i < found.size(); ++i)
                EXPECT_NEAR(found[i], wanted[i], 0.004 + 0.03 * wanted[i]) << c.name << ' ' << cosine << " bin " << i;
        }
}

TEST(Bsdf, Reciprocal) {
    for (const Case& c : all_cases()) {
        if (c.point.plant) continue; // has no side
        for (u32 i = 0; i < 200; ++i) {
            Sampler s = make_sampler(1, 1, i, 8);
            const Vec2 u = next_2d(s), v = next_2d(s);
            const Vec3 a = at_cosine(c.point, 0.05f + 0.95f * u.x, 6.28f * u.y);
            const Vec3 b = at_cosine(c.point, (0.05f + 0.95f * v.x), 6.28f * v.y);
            const float ab = eval_bsdf(c.point, a, b).x / dot(c.point.normal, b);
            const float ba = eval_bsdf(c.point, b, a).x / dot(c.point.normal, a);
            EXPECT_NEAR(ab, ba, 0.002f * ab + 1e-5f) << c.name;
            // Through a border: seen from the other side, where what lies behind is before.
            if (c.point.optics != Optics::dielectric && c.point.optics != Optics::leaf) continue;
            const Vec3 t = -b;
            SurfacePoint back = c.point;
            back.face = back.normal = -c.point.normal;
            back.ior = 1 / c.point.ior;
            // In radiance over index squared the two are equal but for the index: f / n^2 is what is reciprocal.
            const float there = eval_bsdf(c.point, a, t).x / std::abs(dot(c.point.normal, t));
            const float again = eval_bsdf(back, t, a).x / std::abs(dot(c.point.normal, a));
            const float n2 = c.point.optics == Optics::dielectric ? c.point.ior * c.point.ior : 1.0f;
            EXPECT_NEAR(there, again * n2, 0.01f * there + 1e-4f) << c.name;
        }
    }
}

TEST(Bsdf, RefractsBySnellAndMirrorsEvenly) {
    for (float n : {1.33f, 2.3f, 1 / 1.33f})
        for (float cosine : {0.3f, 0.7f, 0.99f}) {
            SurfacePoint p = surface_of(Optics::dielectric, 0, {0.5f, 0.6f, 0.7f});
            p.ior = n;
            const Vec3 eye = at_cosine(p, cosine);
            const float f = fresnel_dielectric(cosine, n);
            const BsdfSample mirror = sample_bsdf(p, eye, f * 0.99f, {0.5f, 0.5f});
            EXPECT_TRUE(mirror.delta && !mirror.through && mirror.pdf == 0);
            EXPECT_NEAR(dot(mirror.dir, p.normal), cosine, 1e-5);
            EXPECT_NEAR(length(eye + mirror.dir - p.normal * (2 * cosine)), 0, 1e-5); // in one plane
            EXPECT_EQ(mirror.weight.x, 1);
            if (f >= 1) continue;
            const BsdfSample passes = sample_bsdf(p, eye, f + (1 - f) * 0.5f, {0.5f, 0.5f});
            EXPECT_TRUE(passes.delta && passes.through);
            EXPECT_NEAR(length(cross(passes.dir, p.normal)) * n, length(cross(eye, p.normal)), 1e-5);
            EXPECT_NEAR(dot(cross(passes.dir, p.normal), eye), 0, 1e-5);
            EXPECT_LT(dot(passes.dir, p.normal), 0);
            EXPECT_EQ(passes.weight.y, 0.6f);
        }
}

TEST(Microfacet, CircleIsRound) {
    for (u32 i = 0; i < 1000; ++i) {
        const float u = float(i) / 1000;
        EXPECT_NEAR(on_circle(u).x, std::cos(2 * 3.14159265358979 * double(u)), 1e-6);
        EXPECT_NEAR(on_circle(u).y, std::sin(2 * 3.14159265358979 * double(u)), 1e-6);
    }
}

// In a closed crystal ball of light nothing grows: what crosses in and out of it is conserved.
TEST(Bsdf, CrystalsGainNothing) {
    // Radiance over index squared is 1 everywhere. From the air: what is mirrored and what comes through is 1; so from
    // within. Through two parallel faces the whole is the slab's, which is 1 together with its mirror image.
    SurfacePoint in = surface_of(Optics::dielectric, 0), out = in;
    in.ior = 2.3f, out.ior = 1 / 2.3f;
    for (float cosine : {0.1f, 0.5f, 1.0f}) {
        double passed = 0, back = 0;
        for (u32 i = 0; i < 4096; ++i) {
            Sampler s = make_sampler(0, 0, i, 1);
            const Vec3 eye = at_cosine(in, cosine);
            BsdfSample b = sample_bsdf(in, eye, next_1d(s), {});
            double weight = double(b.weight.x);
            bool inside = b.through, far = true;
            for (u32 bounce = 0; inside && bounce < 64; ++bounce) {
                // The other face: the same normal, turned to the ray.
                out.face = out.normal = far ? in.normal : -in.normal;
                const Vec3 d = b.dir;
                b = sample_bsdf(out, -d, next_1d(s), {});
                weight *= double(b.weight.x);
                if (b.through) {
                    inside = false;
                    (far ? passed : back) += weight / 4096;
                }
                far = !far;
            }
            if (!b.through) back += weight / 4096;
        }
        EXPECT_NEAR(passed + back, 1, 1e-4) << cosine;
        EXPECT_NEAR(back, slab_reflectance(cosine, 2.3f), 0.02) << cosine;
    }
}

// Dark below a bright coat: only the coat's mirrors are left; more of them at flat angles.
TEST(Bsdf, CoatMirrorsAsFresnelSays) {
    for (float cosine : {0.2f, 0.5f, 1.0f}) {
        const SurfacePoint p = surface_of(Optics::matte, 0.2f, {0, 0, 0});
        const Vec3 eye = at_cosine(p, cosine);
        double sum = 0;
        for (u32 i = 0; i < 4096; ++i) {
            Sampler s = make_sampler(4, 4, i, 1);
            const float choose = next_1d(s);
            sum += double(sample_bsdf(p, eye, choose, next_2d(s)).weight.x) / 4096;
        }
        EXPECT_NEAR(sum, fresnel_dielectric(cosine, 1.5f), 0.02) << cosine; // Schlick's approximation is 0.018 off
    }
}

// The shading normal leans far from the face: no light through the wall, none lost to nowhere but below it.
TEST(Bsdf, LeaningNormalsLeakNoLight) {
    for (Case c : all_cases()) {
        if (c.point.plant) continue;
        c.point.normal = normalized(c.point.face + at_cosine(c.point, 0.1f, 2) * 0.6f);
        for (u32 i = 0; i < 1000; ++i) {
            Sampler s = make_sampler(2, 7, i, 2);
            const Vec2 e = next_2d(s);
            SurfacePoint flat = c.point;
            flat.normal = c.point.face;
            const Vec3 eye = at_cosine(flat, 0.02f + 0.98f * e.x, 6.28f * e.y);
            if (dot(eye, c.point.normal) <= 0) continue;
            const float choose = next_1d(s);
            const BsdfSample b = sample_bsdf(c.point, eye, choose, next_2d(s));
            ASSERT_TRUE(std::isfinite(b.weight.x) && std::isfinite(b.dir.x)) << c.name;
            if (b.weight.x > 0) {
                EXPECT_EQ(b.through, dot(b.dir, c.point.face) < 0) << c.name;
            }
            EXPECT_LT(b.weight.x, 3) << c.name;
            if (c.point.optics == Optics::matte || c.point.optics == Optics::metal) {
                EXPECT_GE(dot(b.dir, c.point.face) * b.weight.x, 0) << c.name;
            }
        }
    }
}

// What the fits in microfacet.h stand for.
TEST(Microfacet, LossesAreTheirIntegrals) {
    for (float roughness : {0.1f, 0.3f, 0.55f, 0.8f, 1.0f})
        for (float cosine : {0.02f, 0.1f, 0.35f, 0.7f, 1.0f}) {
            const float alpha = roughness * roughness, sine = std::sqrt(1 - cosine * cosine);
            const Vec3 eye{sine, 0, cosine};
            double all = 0, grazing = 0;
            constexpr u32 count = 4096;
            for (u32 i = 0; i < count; ++i) {
                Sampler s = make_sampler(8, 8, i, 6);
                const Vec3 h = sample_visible_normal(eye, alpha, next_2d(s)), l = mirrored(eye, h);
                if (l.z <= 0) continue;
                const float hidden = ggx_hidden(eye, alpha);
                const double w = double((1 + hidden) / (1 + hidden + ggx_hidden(l, alpha)));
                all += w / count, grazing += w * double(schlick(dot(eye, h))) / count;
            }
            const MirrorLoss m = mirror_loss(cosine, roughness);
            EXPECT_NEAR(m.lost, 1 - all, 0.010) << roughness << ' ' << cosine;
            EXPECT_NEAR(m.grazing, grazing, 0.010) << roughness << ' ' << cosine;
        }
    for (float roughness : {0.0f, 0.2f, 0.5f, 0.9f}) {
        MirrorLoss sum{0, 0};
        for (u32 i = 0; i < 2000; ++i) {
            const float c = (float(i) + 0.5f) / 2000;
            const MirrorLoss m = mirror_loss(c, roughness);
            sum.lost += m.lost * c / 1000, sum.grazing += m.grazing * c / 1000;
        }
        EXPECT_NEAR(mean_mirror_loss(roughness).lost, sum.lost, 0.002);
        EXPECT_NEAR(mean_mirror_loss(roughness).grazing, sum.grazing, 0.002);
    }
}

} // namespace vitrail::trace
