// Ways along water: of rays inside of it, and of rays in the air between a surface and the cells above. Kernel-safe.
//
// What the grid knows of water (calm cells, GridView::layers) says where such a ray meets nothing but the plane of a
// flat surface: then a step leaves a box of cells at once, as wide as a chunk where the layers are calm all over it.
// Cells that the ray passes near the plane are looked into, as any others; what is met there is for cell_hit.h alone.
#pragma once

#include "trace/kernel/grid_walk.h"

namespace vitrail::trace {

// Above the start cell's bottom, after t blocks.
VX_HD double height_at(const Ray& ray, double t) {
    return double(ray.from.at.y) + double(ray.dir.y) * t;
}
// Heights at distance t, or nearer, that differ by more are told apart by cell_hit.h too, whose distances are float.
VX_HD double surely(double t) {
    return 1e-4 + t * (1.0 / (1 << 22));
}
VX_HD double surface_of(const GridView& g) { // above its cell's bottom
    return double(g.water_top) * (1.0 / 256);
}

// How many bits of a word of 16 are set next to each other: up from `bit`, or down, that one included. It is set.
VX_HD u32 run_up(u32 word, u32 bit) {
#ifdef __CUDA_ARCH__
    return u32(__ffs(i32(~(word >> bit)))) - 1;
#else
    return u32(__builtin_ctz(~(word >> bit)));
#endif
}
VX_HD u32 run_down(u32 word, u32 bit) {
#ifdef __CUDA_ARCH__
    return u32(__clz(i32(~(word << (31 - bit)))));
#else
    return u32(__builtin_clz(~(word << (31 - bit))));
#endif
}

// Layers of a brick without a cell that is set in its mask.
VX_HD u32 clear_layers(u64 mask) {
    return u32((mask & 0xFFFF) == 0) | u32((mask >> 16 & 0xFFFF) == 0) << 1 | u32((mask >> 32 & 0xFFFF) == 0) << 2 |
           u32(mask >> 48 == 0) << 3;
}

// Calm cells around one of the window: layers of its chunk, or of its brick, as wide as that; or itself.
struct CalmBox {
    u32 bits;   // log2 of its width, blocks
    u32 layers; // bits: of the chunk; 0: the cell is not calm
    u32 open;   // those that may have surfaces
};
VX_HD CalmBox calm_box(const GridView& g, const GridChunk& c, IVec3 cell) {
    constexpr u32 kSet = u32(Through::water);
    const u32 layer = u32(cell.y & 15), brick = brick_of(cell), calm = (c.layers | c.layers >> 16) & 0xFFFF;
    if (calm >> layer & 1) return {4, calm, c.layers >> 16};
    u64 mask = 0;
    if (c.bricks[kSet] >> brick & 1) mask = g.masks[c.masks[kSet] * 64 + brick];
    const u32 clear = clear_layers(mask);
    if (clear >> (layer & 3) & 1) return {2, clear << (layer & 12), ~0u};
    return {0, mask >> bit_of(cell) & 1 ? 0 : 1u << layer, ~0u};
}

// As next_stop, in water (GridView::water, which is known): to the next cell, beyond the one that it is in, that the
// ray may meet something in.
VX_HD Walked next_in_water(const GridView& g, const Ray& ray, Walk& w, double t_most, u32& steps) {
    for (bool fresh = true;; fresh = false) {
        const IVec3 cell = w.cell();
        bool stop = !in_window_cell(g, cell);
        IVec3 p = next_planes(w);
        double t = 0;
        u32 axis = 0;
        if (!stop) {
            const CalmBox box = calm_box(g, g.chunks[slot_of(g, {cell.x >> 4, cell.y >> 4, cell.z >> 4})], cell);
            const u32 layer = u32(cell.y & 15);
            stop = box.layers == 0;
            u32 bits = box.bits, open = box.open, end = layer + run_up(box.layers | 1u << layer, layer);
            if (!(w.up & 2)) p.y = w.y + 1 - i32(run_down(box.layers | 1u << layer, layer));
            while (!stop) {
                p.x = box_plane(cell.x, w.start.x, bits, w.up & 1), p.z = box_plane(cell.z, w.start.z, bits, w.up & 4);
                const i32 top = w.y + i32(end - layer);
                if (w.up & 2) p.y = top;
                axis = first_plane(w, p, t);
                // Surfaces are in the highest layer.
                if (!(open >> (end - 1) & 1)) break;
                const double surface = double(top - 1) + surface_of(g) - surely(t);
                if (height_at(ray, w.t) < surface && height_at(ray, t) < surface) break;
                if (end - 1 > layer) {
                    --end, open = 0;
                } else if (bits != 0) {
                    bits = bits == 4 ? 2 : 0;
                } else { // full water has water above
                    const IVec3 above{cell.x, cell.y + 1, cell.z};
                    stop = !in_window_cell(g, above) || !is_calm(g, above);
                    open = 0;
                }
            }
        }
        if (stop) {
            if (!fresh) return Walked::stopped;
            step_cell(w);
        } else {
            leave_by(w, ray, p, axis, t);
        }
        if (!(w.t < t_most)) return Walked::ended;
        if (steps-- == 0) return Walked::lost;
    }
}

// A ray through air in a cell that may be water, is so high where it comes in that it may pass above a flat surface.
VX_HD bool is_high(const GridView& g, const Ray& ray, const Walk& w) {
    return g.water != 0 && height_at(ray, w.t) - double(w.y) > surface_of(g) + surely(w.t);
}

// From a cell that stops rays through air on, past those whose flat surface lies below the ray's way. stopped: in the
// next one that stops it; ended: none that is entered before t_most; lost: not told, it stands in a cell without any.
VX_HD Walked pass_above_water(const GridView& g, const Ray& ray, Walk& w, double t_most) {
    do {
        if (!is_high(g, ray, w)) return Walked::stopped;
        const IVec3 cell = w.cell();
        const GridChunk& c = g.chunks[slot_of(g, {cell.x >> 4, cell.y >> 4, cell.z >> 4})];
        u32 bits = (c.layers >> 16 & ~c.layers) >> (cell.y & 15) & 1 ? 4 : 0;
        if (bits == 0 && (c.masks[u32(Through::water)] == kAllMasks || !is_calm(g, cell) ||
                          stops_air(g, {cell.x, cell.y + 1, cell.z})))
            return Walked::stopped;
        IVec3 p = next_planes(w);
        for (;; bits = bits == 4 ? 2 : 0) {
            p.x = box_plane(cell.x, w.start.x, bits, w.up & 1), p.z = box_plane(cell.z, w.start.z, bits, w.up & 4);
            double t;
            const u32 axis = first_plane(w, p, t);
            if (height_at(ray, t) - double(w.y) > surface_of(g) + surely(t)) {
                leave_by(w, ray, p, axis, t);
                break;
            }
            if (bits == 0) return Walked::stopped;
        }
        if (!(w.t < t_most)) return Walked::ended;
    } while (stops_air(g, w.cell()));
    return Walked::lost;
}

} // namespace vitrail::trace
