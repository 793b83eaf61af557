// Where light goes that meets a surface: one function a question, whatever the surface is made of. Kernel-safe.
//
// All directions are unit and lead away from the surface. What a path carries is radiance divided by the square of the
// medium's index: it stays the same along a ray and across a border, so that no factor is due where light refracts, and
// neither in the water nor behind a crystal anything is brighter than its light.
//
// Lobes are chosen and weighted by the same probabilities. Mirrors and clear borders are deltas: their samples have
// pdf 0 and `delta`, and they are left out of eval_bsdf and pdf_bsdf. A direction on the other side of the geometric
// face than its lobe means gets nothing, so shading normals leak no light through walls.
//
// Reciprocal but for `plant`. With white albedo nothing is lost or won, within 0.01, but by shading normals and by
// rough borders of media, whose small mirrors are met only once. Those of index 1.33 lose, seen straight on from before
// and behind, 0 and 0 of the light at roughness 0.25, 0.01 and 0.05 at 0.5, 0.04 and 0.27 at 0.8; at a cosine of 0.3 it
// is 0.01 and 0.03, 0.07 and 0.23, 0.27 and 0.48.
#pragma once

#include "trace/kernel/fresnel.h"
#include "trace/kernel/microfacet.h"
#include "trace/kernel/surface_point.h"
#include "trace/kernel/wave_lobe.h"

namespace vitrail::trace {

struct BsdfSample {
    Vec3 dir;
    Vec3 weight;        // f |cos| / pdf; 0: the path ends
    float pdf = 0;      // per solid angle, of all lobes together; 0: delta
    bool delta = false; // exact direction
    bool through = false;
};
struct BsdfValue {
    Vec3 value; // f |cos|
    float pdf = 0;
};

inline constexpr float kSharpest = 0.04f;                         // roughness below which a mirror is exact
inline constexpr float kLeafMirrored = 0.6f, kLeafThrough = 0.4f; // of a leaf's albedo
inline constexpr float kPlantUp = 0.6f; // share of what a plant scatters as the ground below it would; rest: evenly

VX_HD Vec3 sample_cosine(Vec2 u) { // pdf: z / pi
    const float r = std::sqrt(u.x);
    const Vec2 turn = on_circle(u.y);
    return {r * turn.x, r * turn.y, std::sqrt(1 - u.x)};
}
VX_HD Vec3 mirrored(Vec3 to_eye, Vec3 normal) {
    return normal * (2 * dot(to_eye, normal)) - to_eye;
}
VX_HD bool is_sharp(const SurfacePoint& p) {
    return p.roughness < kSharpest;
}
VX_HD float greatest(Vec3 v) {
    const float a = v.x > v.y ? v.x : v.y;
    return a > v.z ? a : v.z;
}

// ---- Matte under a coat, and metal: mirrors above, and what they let through or lose spread evenly. The even part is
// (1 - E(in)) (1 - E(out)) / (1 - mean E), E being what the mirrors send back: with white albedo exactly the rest
// (Kelemen and Szirmay-Kalos, "A Microfacet Based Coupled Specular-Matte BRDF Model", 2001; for metals Kulla and Conty,
// "Revisiting Physically Based Shading at Imageworks", 2017).

struct Gloss {
    float f0 = 0;         // coat: reflectance seen straight on
    float out_left = 0;   // of the eye's direction: share that the mirrors do not send back
    float mean_left = 1;  // mean of it over all directions
    float p_mirror = 0.5; // probability of the mirrors' lobe
    Vec3 even;            // albedo of the even part
};
VX_HD float left_by_mirrors(const SurfacePoint& p, const Gloss& g, float cosine) {
    const MirrorLoss m = mirror_loss(cosine, p.roughness);
    return p.optics == Optics::metal ? m.lost : 1 - m.grazing - g.f0 * (1 - m.lost - m.grazing);
}
VX_HD Gloss gloss_of(const SurfacePoint& p, float cosine) {
    Gloss g;
    const MirrorLoss mean = mean_mirror_loss(p.roughness);
    if (p.optics == Optics::metal) {
        g.mean_left = mean.lost;
        const Vec3 f = p.albedo * (20.0f / 21) + Vec3{1, 1, 1} * (1.0f / 21); // mean of Schlick's reflectance
        const float lost = mean.lost, sent = 1 - lost;
        g.even = {f.x * f.x * sent / (1 - f.x * lost), f.y * f.y * sent / (1 - f.y * lost),
                  f.z * f.z * sent / (1 - f.z * lost)};
    } else {
        g.f0 = normal_reflectance(p.ior);
        g.mean_left = 1 - mean.grazing - g.f0 * (1 - mean.lost - mean.grazing);
        g.even = p.albedo;
    }
    g.out_left = left_by_mirrors(p, g, cosine);
    const float sent = p.optics == Optics::metal ? (1 - g.out_left) * greatest(p.albedo) : 1 - g.out_left;
    const float even = g.out_left * greatest(g.even);
    g.p_mirror = sent / (sent + even + 1e-6f);
    return g;
}
VX_HD Vec3 mirror_color(const SurfacePoint& p, const Gloss& g, float cosine) {
    const float white = schlick(cosine);
    return p.optics == Optics::metal ? p.albedo * (1 - white) + Vec3{white, white, white}
                                     : Vec3{1, 1, 1} * (g.f0 + (1 - g.f0) * white);
}
VX_HD BsdfValue value_of_gloss(const SurfacePoint& p, const Gloss& g, Vec3 o, Vec3 l) {
    if (l.z <= 0) return {};
    const float in_left = left_by_mirrors(p, g, l.z);
    const float even = g.out_left * in_left / (kPi * (g.mean_left > 1e-4f ? g.mean_left : 1e-4f)) * l.z;
    BsdfValue v{g.even * even, (1 - g.p_mirror) * l.z * (1 / kPi)};
    if (is_sharp(p)) return v;
    const float alpha = p.roughness * p.roughness;
    const Vec3 h = normalized(o + l);
    const float d = ggx_density(h, alpha) / (4 * o.z), hidden = ggx_hidden(o, alpha);
    v.value += mirror_color(p, g, dot(o, h)) * (d / (1 + hidden + ggx_hidden(l, alpha)));
    v.pdf += g.p_mirror * d / (1 + hidden);
    return v;
}

// ---- Rough borders of media (Walter et al. 2007). o.z > 0; light from both sides. Passages are shadowed on each side
// by itself, reflections together.

VX_HD BsdfValue value_of_border(const SurfacePoint& p, Vec3 o, Vec3 l, Vec3 h) {
    const float alpha = p.roughness * p.roughness, oh = dot(o, h), lh = dot(l, h);
    const bool through = l.z < 0;
    if (oh <= 0 || (through ? lh >= 0 : lh <= 0)) return {};
    const float f = fresnel_dielectric(oh < 1 ? oh : 1, p.ior), hidden = ggx_hidden(o, alpha);
    const float seen = ggx_density(h, alpha) * oh / ((1 + hidden) * o.z); // density of h
    const float other = ggx_hidden(l, alpha);
    if (!through) {
        const float pdf = seen * f / (4 * oh);
        return {Vec3{1, 1, 1} * (pdf * (1 + hidden) / (1 + hidden + other)), pdf};
    }
    const float bend = oh + p.ior * lh;
    const float pdf = seen * (1 - f) * p.ior * p.ior * -lh / (bend * bend);
    return {p.albedo * (pdf / (1 + other)), pdf};
}
VX_HD BsdfValue value_of_border(const SurfacePoint& p, Vec3 o, Vec3 l) {
    if (l.z > 0) return value_of_border(p, o, l, normalized(o + l));
    const Vec3 h = normalized(o + l * p.ior);
    return value_of_border(p, o, l, h.z < 0 ? -h : h);
}

// ---- Water whose waves are too small to be seen: a Gaussian of slopes (wave_lobe.h), each a sharp border, of those
// that the eye sees. What they bend to the wrong side of the level face is mirrored at it, as at sharp water
// (sample_clear_border), so nothing is lost, and every direction is come to in two ways.

// The chance that such a border is asked what it mirrors, which is f of the light.
VX_HD float chance_of_mirror(const SurfacePoint& p, float f) {
    return f * p.mirrored / (f * p.mirrored + 1 - f);
}
// Of directions `l` that are mirrored (through: passages), before any is turned back.
VX_HD void add_waves(const SurfacePoint& p, const WaveLobe& w, Vec3 o, Vec3 l, bool through, float& value, float& pdf) {
    Vec3 h = through ? o + l * p.ior : o + l;
    if (through && p.ior > 1) h = -h;
    if (!(h.y > 0)) return;
    const float long2 = dot(h, h), scale = 1 / std::sqrt(long2), oh = dot(o, h) * scale, lh = dot(l, h) * scale;
    if (oh <= 0 || (through && lh >= 0)) return;
    const float density = density_of_slope(w, {-h.x / h.y, -h.z / h.y});
    if (!(density > 0)) return;
    // A slope is the normal's tangent: an area of slopes is seen as y^3 of it, and shows oh / y of the level area.
    const float y2 = h.y * h.y / long2, seen = density / (w.visible * y2 * y2); // of normals, over oh
    const float f = fresnel_dielectric(oh < 1 ? oh : 1, p.ior), chance = chance_of_mirror(p, f);
    const float bend = oh + p.ior * lh, turned = through ? oh * p.ior * p.ior * -lh / (bend * bend) : 0.25f;
    value += seen * turned * (through ? 1 - f : f);
    pdf += seen * turned * (through ? 1 - chance : chance);
}
// With y up on the eye's side.
VX_HD Vec3 above_face(const SurfacePoint& p, Vec3 v) {
    return p.face.y > 0 ? v : -v;
}
VX_HD Vec3 eye_above(const SurfacePoint& p, Vec3 to_eye) {
    const Vec3 o = above_face(p, to_eye);
    return {o.x, o.y > 1e-4f ? o.y : 1e-4f, o.z};
}
VX_HD BsdfValue value_of_waves(const SurfacePoint& p, const WaveLobe& w, Vec3 o, Vec3 l) {
    const bool through = l.y < 0;
    float value = 0, pdf = 0;
    add_waves(p, w, o, l, through, value, pdf);
    add_waves(p, w, o, {l.x, -l.y, l.z}, through, value, pdf);
    return {{value, value, value}, pdf};
}
VX_HD BsdfValue value_of_waves(const SurfacePoint& p, Vec3 to_eye, Vec3 to_light) {
    const Vec3 o = eye_above(p, to_eye);
    return value_of_waves(p, wave_lobe(p.waves, p.normal, o), o, above_face(p, to_light));
}
VX_HD BsdfSample sample_waves(const SurfacePoint& p, Vec3 to_eye, float choose, Vec2 u) {
    const Vec3 o = eye_above(p, to_eye);
    const WaveLobe w = wave_lobe(p.waves, p.normal, o);
    const Vec2 slope = sample_slope(w, u);
    const Vec3 h = normalized({-slope.x, 1, -slope.y});
    const float oh = clamp(dot(o, h), 1e-5f, 1.0f);
    float behind;
    const float f = fresnel_dielectric(oh, p.ior, behind);
    BsdfSample s;
    s.through = choose >= chance_of_mirror(p, f);
    Vec3 l = s.through ? normalized(h * (oh / p.ior - behind) - o * (1 / p.ior)) : mirrored(o, h);
    if ((l.y < 0) != s.through) l.y = -l.y;
    s.dir = above_face(p, l);
    const BsdfValue v = value_of_waves(p, w, o, l);
    s.pdf = v.pdf;
    if (v.pdf > 0) s.weight = v.value * (1 / v.pdf);
    return s;
}

// ----

// Is `dir` on the side of the geometric face that it is on for shading?
VX_HD bool keeps_side(const SurfacePoint& p, Vec3 dir, bool through) {
    return (dot(p.face, dir) < 0) == through;
}
// The eye, local; never below the horizon.
VX_HD Vec3 local_eye(const Frame& f, Vec3 to_eye) {
    Vec3 o = to_local(f, to_eye);
    if (o.z < 1e-3f) o = normalized({o.x, o.y, 1e-3f});
    return o;
}

// Value and pdf together.
VX_HD_CALL BsdfValue bsdf_at(const SurfacePoint& p, Vec3 to_eye, Vec3 to_light) {
    if (p.plant) {
        const float pdf = (kPlantUp * (to_light.y > 0 ? to_light.y : 0) + (1 - kPlantUp) * 0.25f) * (1 / kPi);
        return {p.albedo * pdf, pdf};
    }
    if (p.optics == Optics::water) return is_sharp(p) ? BsdfValue{} : value_of_waves(p, to_eye, to_light);
    const float cosine = dot(p.normal, to_light);
    const bool through = cosine < 0;
    if (!keeps_side(p, to_light, through)) return {};
    switch (p.optics) {
    case Optics::matte:
    case Optics::metal: {
        if (through) return {};
        const Frame f = frame_of(p.normal);
        const Vec3 o = local_eye(f, to_eye);
        return value_of_gloss(p, gloss_of(p, o.z), o, to_local(f, to_light));
    }
    case Optics::leaf: {
        const float pdf = (through ? -cosine * kLeafThrough : cosine * kLeafMirrored) * (1 / kPi);
        return {p.albedo * pdf, pdf};
    }
    case Optics::thin: {
        if (through) return {};
        const float pdf = cosine * p.opacity * (1 / kPi);
        return {p.albedo * pdf, pdf};
    }
    case Optics::water:
        break;
    case Optics::dielectric: {
        if (is_sharp(p)) return {};
        const Frame f = frame_of(p.normal);
        return value_of_border(p, local_eye(f, to_eye), to_local(f, to_light));
    }
    }
    return {};
}

VX_HD Vec3 eval_bsdf(const SurfacePoint& p, Vec3 to_eye, Vec3 to_light) {
    return bsdf_at(p, to_eye, to_light).value;
}
VX_HD float pdf_bsdf(const SurfacePoint& p, Vec3 to_eye, Vec3 to_light) {
    return bsdf_at(p, to_eye, to_light).pdf;
}

// Share of light that goes straight through a sheet of thin glass.
VX_HD Vec3 thin_passage(const SurfacePoint& p, Vec3 dir) {
    return p.albedo * ((1 - p.opacity) * (1 - slab_reflectance(std::abs(dot(p.normal, dir)), p.ior)));
}

// Mirror or passage at a clear border. A direction that waves bend to the wrong side of the face is mirrored at it: it
// would meet the next wave.
VX_HD BsdfSample sample_clear_border(const SurfacePoint& p, Vec3 to_eye, float choose) {
    float cosine = dot(p.normal, to_eye), behind;
    cosine = clamp(cosine, 1e-4f, 1.0f);
    const float f = fresnel_dielectric(cosine, p.ior, behind);
    BsdfSample s;
    s.delta = true;
    s.through = choose >= f;
    if (s.through) {
        s.dir = normalized(p.normal * (cosine / p.ior - behind) - to_eye * (1 / p.ior));
        s.weight = p.albedo;
    } else {
        s.dir = mirrored(to_eye, p.normal);
        s.weight = {1, 1, 1};
    }
    if (!keeps_side(p, s.dir, s.through)) s.dir = s.dir - p.face * (2 * dot(s.dir, p.face));
    return s;
}

VX_HD BsdfSample sample_gloss(const SurfacePoint& p, Vec3 to_eye, float choose, Vec2 u) {
    const Frame f = frame_of(p.normal);
    const Vec3 o = local_eye(f, to_eye);
    const Gloss g = gloss_of(p, o.z);
    const bool mirror = choose < g.p_mirror;
    BsdfSample s;
    if (mirror && is_sharp(p)) {
        s.dir = to_world(f, {-o.x, -o.y, o.z});
        s.delta = true;
        if (keeps_side(p, s.dir, false)) s.weight = mirror_color(p, g, o.z) * (1 / g.p_mirror);
        return s;
    }
    Vec3 l;
    if (mirror) {
        const Vec3 h = sample_visible_normal(o, p.roughness * p.roughness, u);
        l = mirrored(o, h);
    } else {
        l = sample_cosine(u);
    }
    s.dir = to_world(f, l);
    if (l.z <= 0 || !keeps_side(p, s.dir, false)) return s;
    const BsdfValue v = value_of_gloss(p, g, o, l);
    s.pdf = v.pdf;
    if (v.pdf > 0) s.weight = v.value * (1 / v.pdf);
    return s;
}

VX_HD BsdfSample sample_rough_border(const SurfacePoint& p, Vec3 to_eye, float choose, Vec2 u) {
    const Frame f = frame_of(p.normal);
    const Vec3 o = local_eye(f, to_eye), h = sample_visible_normal(o, p.roughness * p.roughness, u);
    const float oh = clamp(dot(o, h), 0.0f, 1.0f);
    float behind;
    const float mirrors = fresnel_dielectric(oh, p.ior, behind);
    BsdfSample s;
    s.through = choose >= mirrors;
    const Vec3 l = s.through ? normalized(h * (oh / p.ior - behind) - o * (1 / p.ior)) : mirrored(o, h);
    s.dir = to_world(f, l);
    if ((l.z < 0) != s.through || !keeps_side(p, s.dir, s.through)) return s;
    const BsdfValue v = value_of_border(p, o, l, h);
    s.pdf = v.pdf;
    if (v.pdf > 0) s.weight = v.value * (1 / v.pdf);
    return s;
}

// choose: 0 <= choose < 1, which lobe; u: where in it. A sample of weight 0 goes nowhere.
VX_HD_CALL BsdfSample sample_bsdf(const SurfacePoint& p, Vec3 to_eye, float choose, Vec2 u) {
    BsdfSample s;
    if (p.plant) {
        if (choose < kPlantUp) {
            const Vec3 l = sample_cosine(u);
            s.dir = {l.x, l.z, l.y};
        } else {
            const float y = 1 - 2 * u.x, r = std::sqrt(clamp(1 - y * y, 0.0f, 1.0f));
            const Vec2 turn = on_circle(u.y);
            s.dir = {r * turn.x, y, r * turn.y};
        }
        s.pdf = (kPlantUp * (s.dir.y > 0 ? s.dir.y : 0) + (1 - kPlantUp) * 0.25f) * (1 / kPi);
        s.weight = p.albedo;
        s.through = dot(p.face, s.dir) < 0;
        return s;
    }
    switch (p.optics) {
    case Optics::matte:
    case Optics::metal:
        return sample_gloss(p, to_eye, choose, u);
    case Optics::thin: {
        if (choose >= p.opacity) {
            const float mirrors = slab_reflectance(clamp(dot(p.normal, to_eye), 0.0f, 1.0f), p.ior);
            s.delta = true;
            s.through = choose >= p.opacity + (1 - p.opacity) * mirrors;
            s.dir = s.through ? -to_eye : mirrored(to_eye, p.normal);
            if (keeps_side(p, s.dir, s.through)) s.weight = s.through ? p.albedo : Vec3{1, 1, 1};
            return s;
        }
        break;
    }
    case Optics::leaf:
        s.through = choose >= kLeafMirrored;
        break;
    case Optics::water:
        return is_sharp(p) ? sample_clear_border(p, to_eye, choose) : sample_waves(p, to_eye, choose, u);
    case Optics::dielectric:
        return is_sharp(p) ? sample_clear_border(p, to_eye, choose) : sample_rough_border(p, to_eye, choose, u);
    }
    // An even lobe, on either side.
    const Vec3 l = sample_cosine(u);
    s.dir = to_world(frame_of(p.normal), {l.x, l.y, s.through ? -l.z : l.z});
    if (!keeps_side(p, s.dir, s.through)) return s;
    const float share = p.optics == Optics::thin ? p.opacity : s.through ? kLeafThrough : kLeafMirrored;
    s.pdf = share * l.z * (1 / kPi);
    s.weight = p.albedo;
    return s;
}

} // namespace vitrail::trace
