// What a ray meets, made ready for shading. Kernel-safe.
//
//     SurfacePoint p = surface_at(scene, ray, hit, footprint);
//
// footprint: blocks that the ray's cone is wide at the hit, across the ray: textures and waves are filtered by it. 0
// takes the finest texels, and all waves as they are.
#pragma once

#include "math/exp.h"
#include "scene/water.h"
#include "trace/kernel/liquid.h"
#include "trace/kernel/surface_point.h"
#include "trace/kernel/texture.h"

namespace vitrail::trace {

VX_HD Vec3 axis_of_face(u32 face) {
    const float side = face & 1 ? 1.0f : -1.0f;
    return {face >> 1 == 0 ? side : 0.0f, face >> 1 == 1 ? side : 0.0f, face >> 1 == 2 ? side : 0.0f};
}
VX_HD IVec3 next_cell(IVec3 cell, u32 face) {
    const i32 d = face & 1 ? 1 : -1;
    return {cell.x + (face >> 1 == 0 ? d : 0), cell.y + (face >> 1 == 1 ? d : 0), cell.z + (face >> 1 == 2 ? d : 0)};
}

// TintKind in world/block_def.h: 1 grass, 2 foliage, 3 water lie between.
inline constexpr u32 kTintNone = 0, kTintFixed = 4;

// Colors of grass, foliage and water (kind: TintKind) at a place, sRGB-encoded, between the chunk's texels.
VX_HD Vec3 biome_tint(const GridView& g, u32 kind, Place at) {
    constexpr u32 kSide = 6;
    const IVec3 chunk{at.cell.x >> 4, at.cell.y >> 4, at.cell.z >> 4};
    if (!g.tints || !in_window(g, chunk)) return {1, 1, 1};
    const u32* texels = g.tints + g.chunks[slot_of(g, chunk)].tints * kTintWords + (kind - 1) * kSide * kSide;
    const float x = clamp((float(at.cell.x & 15) + at.at.x) * 0.25f + 0.5f, 0.0f, 4.999f),
                z = clamp((float(at.cell.z & 15) + at.at.z) * 0.25f + 0.5f, 0.0f, 4.999f);
    const u32 ix = u32(x), iz = u32(z), first = ix + kSide * iz;
    const float fx = x - float(ix), fz = z - float(iz);
    return lerp(lerp(color_of(texels[first]), color_of(texels[first + 1]), fx),
                lerp(color_of(texels[first + kSide]), color_of(texels[first + kSide + 1]), fx), fz);
}
VX_HD Vec3 tint_at(const SceneView& s, u32 kind, u32 fixed, Place at) {
    if (kind == kTintNone) return {1, 1, 1};
    if (kind == kTintFixed) return color_of(s.fixed_tints[fixed]);
    return biome_tint(s.grid, kind, at);
}

// The medium in a cell at a place of it; of a fluid what lies above its surface is air.
VX_HD u32 medium_at(const SceneView& s, IVec3 cell, Vec3 at) {
    const StateRecord& r = s.states[state_at(s.grid, cell)];
    if (r.medium == 0 || r.kind == CellKind::medium) return r.medium;
    const LiquidTop top = liquid_top(s, cell, r.medium);
    return top.full || at.y <= liquid_height_at(top, at.x, at.z) ? r.medium : 0;
}

// A picture at a surface: which, where on it, and how it lies in the world.
struct PicturePlace {
    u32 layer = 0;
    Vec2 uv;
    u32 tint = 0, fixed_tint = 0;
    Vec3 right, down;    // the picture's axes in the world, about unit
    bool masked = false; // opaque pass: alpha says how much of the tint a texel takes
};

VX_HD PicturePlace picture_of_face(u64 look, Vec3 at) {
    PicturePlace p;
    const u32 face = look_face(look), axis = face >> 1, turns = look_turns(look);
    p.layer = look_texture(look), p.uv = face_uv(look, at);
    p.tint = look_tint(look), p.fixed_tint = look_fixed_tint(look);
    const float side = face & 1 ? 1.0f : -1.0f;
    const Vec3 s = axis == 0   ? Vec3{0, 0, -side}
                   : axis == 1 ? Vec3{1, 0, 0}
                               : Vec3{side, 0, 0},
               t = axis == 1 ? Vec3{0, 0, side} : Vec3{0, -1, 0};
    p.right = turns == 0 ? s : turns == 1 ? t : turns == 2 ? -s : -t;
    p.down = turns == 0 ? t : turns == 1 ? -s : turns == 2 ? -t : s;
    return p;
}

VX_HD PicturePlace picture_of_quad(const TraceQuad& q, Vec2 uv) {
    PicturePlace p;
    p.layer = q.texture, p.uv = uv;
    p.tint = q.look & 7, p.fixed_tint = q.look >> 8 & 255;
    // Along the quad's plane the coordinates grow with (ua, va) over edge_a and (ub, vb) over edge_b.
    const Vec3 n = cross(q.edge_a, q.edge_b);
    const Vec3 a = cross(q.edge_b, n), b = cross(n, q.edge_a); // grow with a, with b
    p.right = normalized(a * q.ua + b * q.ub);
    p.down = normalized(a * q.va + b * q.vb);
    return p;
}

// What glass of a color and opacity does, as the raster renderer's panes (water/glass.glsl).
struct GlassLook {
    Vec3 through;
    float painted;
};
VX_HD GlassLook glass_of(Vec3 color, float alpha) {
    float most = color.x > color.y ? color.x : color.y;
    most = most > color.z ? most : color.z;
    const Vec3 hue = color * (1 / (most > 1e-3f ? most : 1e-3f));
    const float tinted = 1.6f * alpha < 1 ? 1.6f * alpha : 1.0f;
    return {lerp(Vec3{1, 1, 1}, hue, tinted), alpha * alpha};
}

// Bends a shading normal until the ray sees its front.
VX_HD Vec3 seen_from(Vec3 normal, Vec3 dir, float least = 0.02f) {
    const float facing = -dot(normal, dir);
    return facing >= least ? normal : normalized(normal - dir * (least - facing));
}

// Water: the roughness from which waves that are not seen one by one count as such (below, it is as sharp as it is
// flat); what keeps their spread from being a line; the least cosine to their mean normal.
inline constexpr float kRoughWaves = 0.06f, kLeastSpread = 1e-6f, kLeastFacing = 1e-3f;
inline constexpr i32 kDeep = 4; // blocks

inline constexpr float kPolished = 0.15f; // roughness of clear bodies below which they are smooth

// What a texel says of a clear surface. albedo, alpha: of the texel. sheets: how many of them light passes on its way
// through the block; together they take what the picture says.
VX_HD void apply_clear(Vec3 albedo, float alpha, u32 sheets, SurfacePoint& p) {
    if (p.optics == Optics::water) {
        p.albedo = {1, 1, 1};
        p.roughness = 0;
        return;
    }
    GlassLook glass = glass_of(albedo, alpha);
    if (p.optics == Optics::dielectric) {
        // Its inside colors the light; the picture shows as a trace on the surface.
        p.albedo = lerp(Vec3{1, 1, 1}, glass.through, 0.3f);
        if (p.roughness < kPolished) p.roughness = 0;
        return;
    }
    if (sheets == 2) {
        glass.through = {std::sqrt(glass.through.x), std::sqrt(glass.through.y), std::sqrt(glass.through.z)};
        // The frame of a cutout picture is solid on either side.
        if (glass.painted < 1) glass.painted = 1 - std::sqrt(1 - glass.painted);
    }
    p.opacity = glass.painted;
    p.albedo = lerp(glass.through, albedo, glass.painted);
}

// Albedo, roughness, relief and emission of the texel. p: all but these. emission: of the state and quad.
VX_HD void apply_texel(const SceneView& s, const PicturePlace& picture, float footprint, Vec3 emission, u32 sheets,
                       Vec3 dir, SurfacePoint& p) {
    const TextureView& view = s.textures;
    const u32 level = footprint > 0 ? mip_level(view, footprint * float(1u << view.size_bits)) : 0;
    const u32 at = texel_index(view, picture.layer, picture.uv, level);
    const u32 texel = view.albedo[at];
    const MaterialTexel material = material_of(view.material[at]);
    Vec3 tint = tint_at(s, picture.tint, picture.fixed_tint, p.at);
    if (picture.masked) tint = lerp(Vec3{1, 1, 1}, tint, alpha_of(texel));
    p.albedo = linear_from_srgb(color_of(texel) * tint);
    p.roughness = material.roughness;
    p.emission = p.albedo * emission * material.emission;
    const bool clear = p.optics == Optics::thin || p.optics == Optics::dielectric || p.optics == Optics::water;
    if (clear) apply_clear(p.albedo, alpha_of(texel), sheets, p);
    if (p.plant) return;
    // Clear borders are flat: relief would bend all that is seen through them at each texel's edge.
    const Vec3 raised = clear ? p.face : p.face + picture.right * material.slope.x + picture.down * material.slope.y;
    p.normal = seen_from(normalized(raised), dir);
}

VX_HD u32 hash_surface(u32 state, u32 part) {
    u32 h = state * 0x9E3779B1u ^ (part + 1) * 0x85EBCA77u;
    h ^= h >> 15;
    h *= 0x2C1B3C6Du;
    return h ^ h >> 13;
}

VX_HD float ior_between(const SceneView& s, const SurfacePoint& p) {
    const bool border = p.optics == Optics::dielectric || p.optics == Optics::water;
    return border ? s.media[p.medium_behind].ior / s.media[p.medium_here].ior : 1.5f;
}

VX_HD Vec3 emission_of(const StateRecord& r, float scale) {
    return Vec3{float(r.emission[0]), float(r.emission[1]), float(r.emission[2])} *
           (scale * StateRecord::kEmissionUnit);
}

// A lamp's radiance as the eye takes it in. The screen has no room for what dazzles, and lamps would be white holes in
// the picture; so, like the discs of sun and moon, they are seen as painted: in the colors of their picture, which is
// what `emission` is without the state's hue, and as bright as the logarithm tells (Fechner 1860): what is dim is seen
// as it is, 20 as 3, 700 as 6.6.
VX_HD Vec3 seen_emission(const StateRecord& r, Vec3 emission) {
    const auto painted = [](float e, u16 part) { return part > 0 ? e / float(part) : 0.0f; };
    const Vec3 color{painted(emission.x, r.emission[0]), painted(emission.y, r.emission[1]),
                     painted(emission.z, r.emission[2])};
    const auto greatest = [](Vec3 v) {
        const float a = v.x > v.y ? v.x : v.y;
        return a > v.z ? a : v.z;
    };
    const float most = greatest(color);
    return most > 0 ? color * (log_of(1 + greatest(emission)) / most) : Vec3{};
}

// Waves of a level surface: those that the ray's cone is fine enough for bend the normal, the others roughen.
VX_HD void shade_waves(const SceneView& s, const Ray& ray, const Hit& hit, float footprint, SurfacePoint& p) {
    const scene::WavesSeen w = scene::waves_seen({hit.cell.x, hit.cell.y, hit.cell.z}, {hit.u, hit.v}, s.seconds,
                                                 s.wave_height, scene::wave_filter(ray.dir, footprint));
    const Vec3 wavy = normalized({-w.slope.x, 1, -w.slope.y});
    p.normal = hit.leaving ? -wavy : wavy;
    const float rough = std::sqrt(std::sqrt(w.spread.xx + w.spread.zz));
    if (rough < kRoughWaves) return;
    p.roughness = rough;
    // Deep water is dark: paths rather look at what it mirrors.
    const IVec3 below{hit.cell.x, hit.cell.y - kDeep, hit.cell.z};
    p.mirrored = !hit.leaving && s.states[state_at(s.grid, below)].medium == p.medium_behind ? 5.0f : 1.0f;
    p.waves = {w.spread.xx + kLeastSpread, w.spread.xz, w.spread.zz + kLeastSpread};
}

// The surface of a fluid inside its cell.
VX_HD void shade_liquid_top(const SceneView& s, const Ray& ray, const Hit& hit, float footprint, SurfacePoint& p) {
    const StateRecord& r = s.states[hit.state];
    const LiquidTop top = liquid_top(s, hit.cell, r.medium);
    const Vec3 up = liquid_normal(top, hit.u, hit.v);
    p.face = hit.leaving ? -up : up;
    p.inner = p.at.cell = hit.cell;
    p.at.at = {hit.u, clamp(liquid_height_at(top, hit.u, hit.v), 0.0f, 1.0f), hit.v};
    p.medium_here = hit.leaving ? r.medium : u8(0);
    p.medium_behind = hit.leaving ? u8(0) : r.medium;
    p.surface = hash_surface(r.medium, 6); // levels of a fluid are one surface
    // A model's own optics say nothing of the fluid that it stands in.
    p.optics = r.kind == CellKind::liquid ? Optics(r.optics) : Optics::water;
    p.ior = ior_between(s, p);
    if (p.optics != Optics::water) {
        const Vec3 above{hit.u, 1, hit.v};
        apply_texel(s, picture_of_face(r.faces[3], above), footprint, hit.leaving ? Vec3{} : emission_of(r, 1), 1,
                    ray.dir, p);
        return;
    }
    p.albedo = {1, 1, 1};
    p.roughness = 0;
    p.normal = p.face;
    if (top.level() && !top.covered && s.wave_height > 0) shade_waves(s, ray, hit, footprint, p);
    p.normal = seen_from(p.normal, ray.dir, p.roughness > 0 ? kLeastFacing : 0.02f);
}

VX_HD_CALL SurfacePoint surface_at(const SceneView& s, const Ray& ray, const Hit& hit, float footprint) {
    SurfacePoint p;
    const StateRecord& r = s.states[hit.state];
    if (hit.kind == HitKind::quad && hit.quad == kLiquidSurface) {
        shade_liquid_top(s, ray, hit, footprint, p);
        return p;
    }
    const Vec3 out = axis_of_face(hit.face);
    PicturePlace picture;
    u32 sheets = 1;
    float scale = 1;

    if (hit.kind == HitKind::box) {
        const EntityBox& box = s.boxes[hit.quad];
        const Vec3 q = offset(box.least, ray.from) + ray.dir * hit.t;
        p.at = moved(ray.from, ray.dir, hit.t);
        p.inner = p.at.cell;
        p.face = out;
        p.optics = r.kind == CellKind::cube && Optics(r.optics) == Optics::metal ? Optics::metal : Optics::matte;
        picture = picture_of_face((r.faces[hit.face] & ~(u64(7) << 20)) | u64(hit.face) << 20,
                                  {clamp(q.x / box.size.x, 0.0f, 1.0f), clamp(q.y / box.size.y, 0.0f, 1.0f),
                                   clamp(q.z / box.size.z, 0.0f, 1.0f)});
        p.surface = hash_surface(hit.state, 16 + hit.face);
    } else {
        // The place in the block's cell.
        const Vec3 found = offset({hit.cell, {}}, ray.from) + ray.dir * hit.t;
        Vec3 q{clamp(found.x, 0.0f, 1.0f), clamp(found.y, 0.0f, 1.0f), clamp(found.z, 0.0f, 1.0f)};
        p.inner = p.at.cell = hit.cell;
        p.at.at = q;
        if (hit.kind == HitKind::cube) {
            const u32 axis = hit.face >> 1;
            const float plane = hit.face & 1 ? 1.0f : 0.0f;
            if (axis == 0) q.x = plane;
            if (axis == 1) q.y = plane;
            if (axis == 2) q.z = plane;
            const IVec3 beside = next_cell(hit.cell, hit.face);
            p.at.at = q;
            p.face = hit.leaving ? -out : out;
            if (hit.leaving) {
                p.inner = beside;
            } else {
                p.at.cell = beside;
                p.at.at = q - out;
            }
            p.optics = r.kind == CellKind::model ? Optics::water : Optics(r.optics); // the fluid that it stands in
            if (p.optics != Optics::matte && p.optics != Optics::metal) {
                const u32 inside = medium_at(s, hit.cell, q), outside = medium_at(s, beside, q - out);
                p.medium_here = u8(hit.leaving ? inside : outside);
                p.medium_behind = u8(hit.leaving ? outside : inside);
            }
            picture = picture_of_face(r.faces[hit.face], q);
            picture.masked = r.kind == CellKind::cube || r.kind == CellKind::detailed;
            sheets = 2;
            if (hit.leaving) scale = 0;
            p.surface = hash_surface(r.kind == CellKind::liquid ? 0x10000u + r.medium : hit.state, hit.face);
        } else {
            const TraceQuad& quad = s.quads[hit.quad];
            const Vec3 off = found - q;
            if (dot(off, off) > 1e-6f) { // a part that stands out of its cell
                p.at = moved({hit.cell, found}, {}, 0);
                p.inner = p.at.cell;
            }
            p.face = dot(quad.normal, ray.dir) > 0 ? -quad.normal : quad.normal;
            p.optics = Optics(quad.look >> 16 & 15);
            p.plant = quad.look & TraceQuad::kUnshaded;
            if (p.optics != Optics::matte && p.optics != Optics::metal)
                p.medium_here = p.medium_behind = u8(medium_at(s, hit.cell, q));
            if (quad.medium != 0) (hit.leaving ? p.medium_here : p.medium_behind) = u8(quad.medium);
            picture = picture_of_quad(quad, {hit.u, hit.v});
            picture.masked =
                !(quad.look & TraceQuad::kCutout) && p.optics != Optics::thin && p.optics != Optics::dielectric;
            scale = quad.emission_scale;
            if (quad.medium != 0 && hit.leaving) scale = 0;
            p.surface = hash_surface(hit.state, 32 + hit.quad);
        }
    }
    p.ior = ior_between(s, p);
    p.normal = p.plant ? Vec3{0, 1, 0} : p.face;
    apply_texel(s, picture, footprint, emission_of(r, scale), sheets, ray.dir, p);
    return p;
}

} // namespace vitrail::trace
