// Caves: rooms (one noise above a threshold) and tunnels (near the common zero of two noises), sampled on a lattice of
// 4 blocks and interpolated between; kernel-safe.
#pragma once

#include "terrain/surface_kernel.h"

namespace vitrail {

inline constexpr i32 kCaveStep = 4; // blocks between lattice points, which lie at multiples of it

// Negative inside a cave, the more the deeper. `depth`: blocks below the ground's surface, for openings to be rare
// there.
VX_HD constexpr float cave_value(const TerrainKeys& k, i32 bx, i32 by, i32 bz) {
    const i64 x = fixed_block(bx), y = fixed_block(by), z = fixed_block(bz);
    // rooms are flattened: their y runs faster
    const float room = noise3(k.cave_room, x, y * 2, z, 6) * 0.8f + noise3(k.cave_room, x, y * 2, z, 4) * 0.25f;
    const float deep = clamp((48.0f - float(by)) * (1.0f / 96.0f), 0.0f, 1.0f);
    const float rooms = (0.62f - 0.14f * deep) - room;
    const float a = noise3(k.cave_tunnel_a, x, y + y / 2, z, 6), b = noise3(k.cave_tunnel_b, x, y + y / 2, z, 6);
    const float gate = noise3(k.cave_gate, x, y, z, 7);
    // the width swells and closes along the way
    const float width = 0.105f + 0.05f * clamp(gate + 0.3f, -1.0f, 1.0f);
    const float tunnels = (a * a + b * b - width * width) * 4.0f;
    return rooms < tunnels ? rooms : tunnels;
}

} // namespace vitrail
