#include "trace/content/optics.h"

#include <algorithm>
#include <cmath>

namespace vitrail::trace {

namespace {

bool full_cube(const BlockLook& look) {
    return look.shape == ShapeKind::cube || look.shape == ShapeKind::pillar;
}

// Sheets of foliage: light comes through.
bool foliage(const BlockLook& look) {
    if (look.material == "leaves") return true;
    if (look.material != "plant") return false;
    switch (look.shape) {
    case ShapeKind::cross:
    case ShapeKind::crop:
    case ShapeKind::faces:
    case ShapeKind::lily_pad:
    case ShapeKind::ladder:
        return true;
    default:
        return false;
    }
}

} // namespace

Optics optics_of(const BlockLook& look, scene::ModelKind kind) {
    const bool opaque_cube = scene::hides(kind);
    if (look.optics != OpticsKind::automatic) {
        const Optics said = Optics(u8(look.optics) - 1);
        // What hides all behind it is drawn with its faces alone.
        if (opaque_cube && said != Optics::metal) return Optics::matte;
        return said;
    }
    static_assert(u8(OpticsKind::matte) == u8(Optics::matte) + 1 && u8(OpticsKind::water) == u8(Optics::water) + 1);
    switch (look.layer) {
    case RenderLayer::solid:
        break;
    case RenderLayer::cutout:
    case RenderLayer::cutout_mipped:
        if (look.material == "glass") return Optics::thin;
        if (foliage(look)) return Optics::leaf;
        break;
    case RenderLayer::translucent:
        if (opaque_cube) break;
        if (look.shape == ShapeKind::liquid) return Optics::water;
        return look.material == "glass" ? Optics::thin : Optics::dielectric;
    }
    return look.material == "metal" && full_cube(look) ? Optics::metal : Optics::matte;
}

float ior_of(const BlockLook& look, Optics optics) {
    if (look.ior > 0) return look.ior;
    if (optics == Optics::water) return 1.333f;
    if (optics != Optics::dielectric) return 1.5f;
    if (look.material == "ice") return 1.31f;
    return look.material == "crystal" ? 2.3f : 1.4f;
}

MediumRecord medium_of(const BlockLook& look, PictureMean mean) {
    MediumRecord m;
    m.kind = 2;
    m.ior = ior_of(look, Optics::dielectric);
    if (look.material == "ice") {
        // Clean ice takes little but red (Warren and Brandt, "Optical constants of ice from the ultraviolet to the
        // microwave", 2008, at 612, 549 and 464 nm); bubbles and cracks make it milky, the more the less clear it is
        // painted.
        m.absorption = {0.14f, 0.05f, 0.004f};
        m.scattering = Vec3{1, 1, 1} * (0.3f * mean.alpha);
    } else {
        // Hue of the picture, deeper the less clear it is painted: a crystal of one block takes what a stained window
        // would. What is cloudy sends back its color by scattering, too.
        const bool crystal = look.material == "crystal" || look.material == "glass";
        const float most = std::max({mean.color.x, mean.color.y, mean.color.z, 1e-3f});
        const float depth = (crystal ? 1.6f : 0.8f) * mean.alpha;
        const auto taken = [&](float c) { return depth * (0.05f - std::log(std::clamp(c / most, 0.02f, 1.0f))); };
        m.absorption = {taken(mean.color.x), taken(mean.color.y), taken(mean.color.z)};
        if (!crystal) m.scattering = mean.color * (0.5f * mean.alpha / most);
    }
    if (look.absorption != std::array<float, 3>{})
        m.absorption = {look.absorption[0], look.absorption[1], look.absorption[2]};
    return m;
}

} // namespace vitrail::trace
