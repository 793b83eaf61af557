#include "trace/grid/calm_water.h"

#include <algorithm>
#include <functional>

namespace vitrail::trace {

namespace {

constexpr WaterCells kDry{};

constexpr WaterCells all_sources() {
    WaterCells all{};
    all.liquid.fill(~u64(0)), all.holds.fill(~u64(0));
    return all;
}
constexpr WaterCells kSources = all_sources();
constexpr WaterSides kDrySides{};

bool equal(const WaterCells& a, const WaterCells& b) {
    return a.liquid == b.liquid && a.holds == b.holds && a.odd == b.odd;
}

// Word w (four rows of a layer) of the cells above.
u64 held_above(const WaterCells& cells, const WaterCells& above, u32 w) {
    return w < 60 ? cells.holds[w + 4] : above.holds[w - 60];
}
// Cells that bend surfaces beside them: with water above, or of another height than a source.
u64 bending(const WaterCells& cells, const WaterCells& above, u32 w) {
    return cells.holds[w] & (cells.odd[w] | held_above(cells, above, w));
}

ChunkPos chunk_at(ChunkPos at, i32 x, i32 y, i32 z) {
    return {at.x + x, at.y + y, at.z + z};
}

void make_unique(std::vector<ChunkPos>& chunks) {
    std::sort(chunks.begin(), chunks.end(), [](ChunkPos a, ChunkPos b) {
        return a.y != b.y ? a.y < b.y : a.z != b.z ? a.z < b.z : a.x < b.x;
    });
    chunks.erase(std::unique(chunks.begin(), chunks.end()), chunks.end());
}

void each(std::size_t count, ThreadPool* pool, const std::function<void(u32)>& body) {
    constexpr std::size_t kShare = 16; // fewer are not worth a task
    if (!pool || count < 2 * kShare) {
        for (u32 i = 0; i < count; ++i)
            body(i);
        return;
    }
    pool->parallel_for(u32((count + kShare - 1) / kShare), [&](u32 share) {
        for (std::size_t i = share * kShare; i < std::min(count, (share + 1) * kShare); ++i)
            body(u32(i));
    });
}

} // namespace

WaterSides water_sides(const WaterCells& cells, const WaterCells& above) {
    WaterSides sides;
    for (u32 y = 0; y < 16; ++y) {
        u32 west = 0, east = 0;
        for (u32 k = 0; k < 4; ++k) {
            const u64 bend = bending(cells, above, y * 4 + k);
            if (bend == 0) continue;
            for (u32 z = 0; z < 4; ++z) {
                west |= u32(bend >> 16 * z & 1) << (k * 4 + z);
                east |= u32(bend >> (16 * z + 15) & 1) << (k * 4 + z);
            }
            if (k == 0) sides.north[y] = u16(bend);
            if (k == 3) sides.south[y] = u16(bend >> 48);
        }
        sides.west[y] = u16(west), sides.east[y] = u16(east);
    }
    return sides;
}

CalmMasks calm_masks(const WaterCells& cells, const WaterCells& above, const WaterSides* const (&around)[9]) {
    CellMask stops;
    u32 layers = 0;
    for (u32 y = 0; y < 16; ++y) {
        // Rows of z from -1 to 16, bit x + 1 from -1 to 16.
        u32 rows[18], any = 0;
        for (u32 z = 0; z < 16; ++z)
            rows[z + 1] = u32(bending(cells, above, y * 4 + z / 4) >> 16 * (z & 3) & 0xFFFF) << 1 |
                          u32(around[3]->east[y] >> z & 1) | u32(around[5]->west[y] >> z & 1) << 17;
        rows[0] = u32(around[1]->south[y]) << 1 | u32(around[0]->south[y] >> 15) | u32(around[2]->south[y] & 1) << 17;
        rows[17] = u32(around[7]->north[y]) << 1 | u32(around[6]->north[y] >> 15) | u32(around[8]->north[y] & 1) << 17;
        for (u32& row : rows)
            row |= row << 1 | row >> 1, any |= row;
        u64 full_any = 0, level_any = 0, all = ~u64(0);
        for (u32 k = 0; k < 4; ++k) {
            const u32 w = y * 4 + k;
            u64 bent = 0;
            if (any != 0)
                for (u32 i = 0; i < 4; ++i) {
                    const u32 z = k * 4 + i; // rows z - 1 .. z + 1
                    bent |= u64((rows[z] | rows[z + 1] | rows[z + 2]) >> 1 & 0xFFFF) << 16 * i;
                }
            const u64 full = cells.liquid[w] & held_above(cells, above, w), level = cells.liquid[w] & ~bent;
            stops[w] = ~(full | level);
            full_any |= full, level_any |= level, all &= full | level;
        }
        if (all == ~u64(0)) layers |= u32(full_any != 0) << y | u32(level_any != 0) << (16 + y);
    }
    return {bricks_of(stops), layers};
}

void CalmWater::clear() {
    water_.clear();
    changed_.clear(), beside_.clear();
}

const WaterCells& CalmWater::cells_of(const Water& water) {
    return water.cells ? *water.cells : kSources;
}
const WaterCells& CalmWater::cells_at(ChunkPos at) const {
    const auto it = water_.find(at);
    return it == water_.end() ? kDry : cells_of(it->second);
}

void CalmWater::put(ChunkPos at, const WaterCells& cells) {
    if (!any_cell(cells.holds)) {
        remove(at);
        return;
    }
    const auto [it, added] = water_.try_emplace(at);
    Water& water = it->second;
    const WaterCells& before = added ? kDry : cells_of(water);
    if (!added && equal(cells, before)) return;
    changed_.push_back(at);
    if (!std::equal(cells.holds.begin(), cells.holds.begin() + 4, before.holds.begin()))
        changed_.push_back(chunk_at(at, 0, -1, 0));
    if (equal(cells, kSources))
        water.cells = nullptr;
    else if (water.cells)
        *water.cells = cells;
    else
        water.cells = std::make_unique<WaterCells>(cells);
}

void CalmWater::remove(ChunkPos at) {
    const auto it = water_.find(at);
    if (it == water_.end()) return;
    changed_.push_back(chunk_at(at, 0, -1, 0));
    if (it->second.sides != kDrySides) beside_.push_back(at);
    water_.erase(it);
}

std::vector<CalmWater::Made> CalmWater::refresh(ThreadPool* pool) {
    make_unique(changed_);
    std::vector<WaterSides> sides(changed_.size());
    each(changed_.size(), pool, [&](u32 i) {
        const auto it = water_.find(changed_[i]);
        if (it != water_.end()) sides[i] = water_sides(cells_of(it->second), cells_at(chunk_at(changed_[i], 0, 1, 0)));
    });
    for (std::size_t i = 0; i < changed_.size(); ++i) {
        const auto it = water_.find(changed_[i]);
        if (it == water_.end() || it->second.sides == sides[i]) continue;
        it->second.sides = sides[i];
        beside_.push_back(changed_[i]);
    }
    for (const ChunkPos at : beside_)
        for (i32 z = -1; z <= 1; ++z)
            for (i32 x = -1; x <= 1; ++x)
                changed_.push_back(chunk_at(at, x, 0, z));
    beside_.clear();
    std::erase_if(changed_, [&](ChunkPos at) { return !water_.contains(at); });
    make_unique(changed_);
    std::vector<Made> made(changed_.size());
    each(changed_.size(), pool, [&](u32 i) {
        const ChunkPos at = changed_[i];
        const WaterSides* around[9];
        for (i32 k = 0; k < 9; ++k) {
            const auto it = water_.find(chunk_at(at, k % 3 - 1, 0, k / 3 - 1));
            around[k] = it == water_.end() ? &kDrySides : &it->second.sides;
        }
        made[i] = {at, calm_masks(cells_at(at), cells_at(chunk_at(at, 0, 1, 0)), around)};
    });
    changed_.clear();
    return made;
}

u64 CalmWater::bytes() const {
    u64 total = 0;
    for (const auto& [at, water] : water_)
        total += sizeof(at) + sizeof(water) + 32 + (water.cells ? sizeof(WaterCells) : 0);
    return total;
}

} // namespace vitrail::trace
