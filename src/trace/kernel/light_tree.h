// Which lamp lights a place: an emitter chosen with a chance that follows what it may give there, and that chance again
// for an emitter that was met. Kernel-safe.
//
// The chance of every node is a product of ratios of importances (Conty Estevez and Kulla 2018): power over the squared
// distance, times bounds of both cosines. The bounds are 0 only where nothing of the node can arrive, but for rounding:
// an emitter that never is chosen is found by chance with its full weight, so that the mean stays right.
#pragma once

#include "trace/kernel/light_view.h"

namespace vitrail::trace {

// Of a place to the tree: blocks.
VX_HD Vec3 light_place(const LightView& l, Place p) {
    return offset({l.from, {}}, p);
}

// LightNode::shares, leaf and pad as two words: bytes one by one cost more than the rest of the node.
VX_HD u32 share_words(const LightNode& n, u32 number) {
    u32 word;
    __builtin_memcpy(&word, n.shares + 4 * number, sizeof word);
    return word;
}
VX_HD bool is_leaf(const LightNode& n) {
    return (share_words(n, 1) >> 16 & 255) != 0;
}

// p: light_place. normal: unit, of the surface there; 0 where light is taken from all sides.
VX_HD float light_importance(const LightNode& n, Vec3 p, Vec3 normal) {
    // Numbers one by one: loops over many places become vectors so.
    const float hx = (n.most.x - n.least.x) * 0.5f, hy = (n.most.y - n.least.y) * 0.5f,
                hz = (n.most.z - n.least.z) * 0.5f;
    const float wx = (n.most.x + n.least.x) * 0.5f - p.x, wy = (n.most.y + n.least.y) * 0.5f - p.y,
                wz = (n.most.z + n.least.z) * 0.5f - p.z;
    const float r2 = hx * hx + hy * hy + hz * hz, d2 = wx * wx + wy * wy + wz * wz;
    const u32 words[2] = {share_words(n, 0), share_words(n, 1)};
    const auto share = [&words](u32 face) { return float(i32(words[face >> 2] >> 8 * (face & 3) & 255)); };
    // Cosine at the emitters: a face that looks along +x gives something only if some of its box lies below p in x.
    const float px = hx - wx, nx = hx + wx, py = hy - wy, ny = hy + wy, pz = hz - wz, nz = hz + wz;
    float facing = 0;
    if (px > 0) facing += px * share(1);
    if (nx > 0) facing += nx * share(0);
    if (py > 0) facing += py * share(3);
    if (ny > 0) facing += ny * share(2);
    if (pz > 0) facing += pz * share(5);
    if (nz > 0) facing += nz * share(4);
    // No nearer than the box's half diagonal, and never nearer than what keeps this finite for a single flat face.
    float near2 = d2 > r2 ? d2 : r2;
    near2 = near2 > 0.01f ? near2 : 0.01f;
    const float inverse = 1 / std::sqrt(near2);
    facing *= inverse * (1.0f / 255);
    facing = facing < 1 ? facing : 1;

    float cosine = 1;
    if (normal.x != 0 || normal.y != 0 || normal.z != 0) {
        const float reach = std::fabs(normal.x) * hx + std::fabs(normal.y) * hy + std::fabs(normal.z) * hz;
        const float along = normal.x * wx + normal.y * wy + normal.z * wz;
        if (along + reach <= 0) return 0;
        if (d2 > r2) {
            const float c = along * inverse, sin2_box = r2 * inverse * inverse, cos_box = std::sqrt(1 - sin2_box);
            if (c < cos_box) { // the normal points past the ball around the box
                const float s2 = 1 - c * c;
                cosine = c * cos_box + std::sqrt((s2 > 0 ? s2 : 0) * sin2_box);
                cosine = cosine > 0.02f ? cosine : 0.02f;
            }
        }
    }
    return n.power * facing * cosine / near2;
}

// From an inner node to one of its children. chance: of all choices so far; 0: neither child gives anything.
VX_HD void choose_child(const LightView& l, Vec3 p, Vec3 normal, u32& at, float& choose, float& chance) {
    const u32 left = l.nodes[at].first;
    const float a = light_importance(l.nodes[left], p, normal), b = light_importance(l.nodes[left + 1], p, normal);
    const float sum = a + b, share = a / sum;
    const bool first = choose < share;
    choose = first ? choose / share : (choose - share) / (1 - share);
    choose = choose < 0.99999994f ? choose : 0.99999994f;
    chance = sum > 0 ? chance * ((first ? a : b) / sum) : 0.0f;
    at = first ? left : left + 1;
}

// choose: 0 <= choose < 1; what is left of it is uniform again. chance: 0 where none is chosen (kNoEmitter).
VX_HD u32 choose_emitter(const LightView& l, Vec3 p, Vec3 normal, float& choose, float& chance) {
    chance = 0;
    if (l.count == 0) return kNoEmitter;
    u32 at = 0;
    chance = 1;
    while (chance > 0 && !is_leaf(l.nodes[at]))
        choose_child(l, p, normal, at, choose, chance);
    return chance > 0 ? l.nodes[at].first : kNoEmitter;
}

// The chance that choose_emitter chooses this one.
VX_HD float chance_of_emitter(const LightView& l, u32 emitter, Vec3 p, Vec3 normal) {
    float chance = 1;
    for (u32 at = l.emitters[emitter].node; at != 0 && chance > 0;) {
        const u32 parent = l.nodes[at].parent, left = l.nodes[parent].first;
        const float a = light_importance(l.nodes[left], p, normal), b = light_importance(l.nodes[left + 1], p, normal);
        const float sum = a + b;
        chance *= sum > 0 ? (at == left ? a : b) / sum : 0;
        at = parent;
    }
    return chance;
}

} // namespace vitrail::trace
