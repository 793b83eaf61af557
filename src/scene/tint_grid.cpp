#include "scene/tint_grid.h"

#include <algorithm>

namespace vitrail::scene {

namespace {

constexpr i32 kReach = 2,
              kCells = 4 + 2 * (1 + kReach); // cells -3..6 of 4 blocks: the grid's -1..4 and a tent of two more

// Colors of one kind as sums over the four layers of a column of biomes.
struct Sum {
    u32 c[3] = {0, 0, 0};
};

} // namespace

TintGrid build_tint_grid(std::span<const Chunk* const, 9> chunks, std::span<const BiomeTint> tints) {
    const Chunk* const center = chunks[4];
    const BiomeTint plain;
    const auto tint_of = [&](BiomeId id) -> const BiomeTint& {
        if (tints.empty()) return plain;
        return tints[u32(id) < tints.size() ? u32(id) : 0];
    };
    // An absent column of chunks gives what the nearest cell of the section has.
    const auto chunk_at = [&](i32& cell_x, i32& cell_z) {
        const i32 dx = cell_x < 0 ? -1 : cell_x > 3 ? 1 : 0, dz = cell_z < 0 ? -1 : cell_z > 3 ? 1 : 0;
        const Chunk* c = chunks[std::size_t(dx + 1 + 3 * (dz + 1))];
        if (c) {
            cell_x &= 3, cell_z &= 3;
            return c;
        }
        cell_x = std::clamp(cell_x, 0, 3), cell_z = std::clamp(cell_z, 0, 3);
        return center;
    };
    const auto blend = [&](std::array<u8, 3> BiomeTint::*kind, TintGrid::Texels& out) {
        Sum cells[kCells][kCells], rows[kCells][TintGrid::kSize];
        for (i32 z = 0; z < kCells; ++z)
            for (i32 x = 0; x < kCells; ++x) {
                i32 cx = x - 1 - kReach, cz = z - 1 - kReach;
                const Chunk* c = chunk_at(cx, cz);
                for (i32 y = 0; y < 4; ++y) {
                    const auto& color = tint_of(c->biomes.cells[std::size_t(cx | cz << 2 | y << 4)]).*kind;
                    for (u32 k = 0; k < 3; ++k)
                        cells[z][x].c[k] += color[k];
                }
            }
        // Tent 1 2 3 2 1 along both axes.
        for (i32 z = 0; z < kCells; ++z)
            for (i32 x = 0; x < TintGrid::kSize; ++x)
                for (u32 k = 0; k < 3; ++k)
                    rows[z][x].c[k] = cells[z][x].c[k] + 2 * cells[z][x + 1].c[k] + 3 * cells[z][x + 2].c[k] +
                                      2 * cells[z][x + 3].c[k] + cells[z][x + 4].c[k];
        bool same = true;
        for (i32 z = 0; z < TintGrid::kSize; ++z)
            for (i32 x = 0; x < TintGrid::kSize; ++x) {
                auto& texel = out[std::size_t(x + z * TintGrid::kSize)];
                for (u32 k = 0; k < 3; ++k) {
                    const u32 sum = rows[z][x].c[k] + 2 * rows[z + 1][x].c[k] + 3 * rows[z + 2][x].c[k] +
                                    2 * rows[z + 3][x].c[k] + rows[z + 4][x].c[k];
                    texel[k] = u8((sum + 162) / 324); // 81 weights of four layers
                }
                texel[3] = 255;
                same &= texel == out[0];
            }
        return same;
    };
    const auto fill = [](std::array<u8, 3> color, TintGrid::Texels& out) {
        out.fill({color[0], color[1], color[2], 255});
    };

    TintGrid out;
    // One biome everywhere is the rule.
    const BiomeId first = center->biomes.cells[0];
    bool one = true;
    for (const Chunk* c : chunks)
        if (c)
            for (const BiomeId id : c->biomes.cells)
                one &= id == first;
    if (one) {
        const BiomeTint& t = tint_of(first);
        fill(t.grass, out.grass);
        fill(t.foliage, out.foliage);
        fill(t.water, out.water);
        out.uniform = true;
        return out;
    }
    const bool a = blend(&BiomeTint::grass, out.grass), b = blend(&BiomeTint::foliage, out.foliage);
    const bool c = blend(&BiomeTint::water, out.water);
    out.uniform = a && b && c;
    return out;
}

} // namespace vitrail::scene
