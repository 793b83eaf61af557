#include "light/relight.h"

#include "light/column_solver.h"
#include "light/light_field.h"

#include <algorithm>
#include <unordered_map>

namespace vitrail {

namespace {

LightField& field_of_thread() {
    static thread_local LightField field;
    return field;
}

ColumnHeights heights_of(Dimension& dimension, ColumnPos column) {
    if (const ColumnHeights* known = dimension.heights(column)) return *known;
    const ColumnHeights made = compute_heights(dimension, column);
    dimension.put_heights(column, made);
    return made;
}

void set_sky(LightField& field, i32 slot, u32 index, u32 level) {
    field.open(slot);
    Light& l = field.slot(slot).cells[index];
    l = Light(u16((l.bits & 0xfff0) | level));
}

u32 sky_at(LightField& field, i32 slot, u32 index) {
    return field.slot(slot).now->get(LocalPos(index)).sky();
}

void cover(LightField& field, i32 slot, u32 index) {
    set_sky(field, slot, index, 0);
    field.withdrawn.push_back({u32(slot) << 12 | index, kSkyFull});
}

void uncover(LightField& field, i32 slot, u32 index) {
    set_sky(field, slot, index, 15);
    field.rising.push_back(u32(slot) << 12 | index);
}

// Cells of one block column that the height says are open but were not, and the other way round. Light of before says
// where the sky was open: only there is it 15.
void follow_height(LightField& field, i32 x, i32 z, i32 height) {
    const DimensionInfo& info = field.dimension().info();
    const u32 across = u32(x & 15) | u32(z & 15) << 4;
    for (i32 y = std::max(height, info.min_y); y < info.max_y;) {
        const i32 slot = field.slot_at({x >> 4, y >> 4, z >> 4});
        if (slot == LightField::kNone || field.slot(slot).pending) {
            y = (y | 15) + 1;
            continue;
        }
        const u32 index = across | u32(y & 15) << 8;
        if (sky_at(field, slot, index) == 15) break;
        uncover(field, slot, index);
        ++y;
    }
    for (i32 y = std::min(height, info.max_y) - 1; y >= info.min_y;) {
        const i32 slot = field.slot_at({x >> 4, y >> 4, z >> 4});
        if (slot == LightField::kNone || field.slot(slot).pending) {
            y = (y & ~15) - 1;
            continue;
        }
        const u32 index = across | u32(y & 15) << 8;
        if (sky_at(field, slot, index) != 15) break;
        cover(field, slot, index);
        --y;
    }
}

// Chunks of the column that stay as they are but were lit under other heights.
void follow_heights(LightField& field, ColumnPos column, const ColumnHeights& heights) {
    const DimensionInfo& info = field.dimension().info();
    for (i32 cy = info.min_y >> 4; cy < info.max_y >> 4; ++cy) {
        const i32 slot = field.slot_at({column.x, cy, column.z});
        if (slot == LightField::kNone || field.slot(slot).pending) continue;
        for (u32 index = 0; index < kChunkVolume; ++index) {
            const bool open = cy * 16 + i32(index >> 8) >= heights.above[index & 255];
            if (open == (sky_at(field, slot, index) == 15)) continue;
            if (open)
                uncover(field, slot, index);
            else
                cover(field, slot, index);
        }
    }
}

// What flowed out of a chunk that is lit anew leaves with it.
void withdraw_outflow(LightField& field, i32 slot) {
    const LightField::Slot& s = field.slot(slot);
    const LightVolume* old = s.chunk->light.get();
    if (!old || (old->uniform() && old->get(LocalPos()).bits == 0)) return;
    for (u32 index = 0; index < kChunkVolume; ++index) {
        const u32 x = index & 15, z = index >> 4 & 15, y = index >> 8;
        if (x != 0 && x != 15 && y != 0 && y != 15 && z != 0 && z != 15) continue;
        if (const u32 light = spread_light(old->get(LocalPos(index))))
            field.withdrawn.push_back({u32(slot) << 12 | index, light});
    }
}

} // namespace

ChangeSet relight_chunks(Dimension& dimension, std::span<const ChunkPos> chunks) {
    ChangeSet out;
    LightField& field = field_of_thread();
    field.start(dimension);
    std::vector<ColumnPos> columns; // in the order given
    std::unordered_map<ColumnPos, std::vector<i32>> pending;
    for (const ChunkPos at : chunks) {
        if (field.slot_at(at) != LightField::kNone && field.slot(field.slot_at(at)).pending) continue; // given twice
        const i32 slot = field.pending_slot_at(at);
        if (slot == LightField::kNone) continue;
        auto& list = pending[column_of(at)];
        if (list.empty()) columns.push_back(column_of(at));
        list.push_back(slot);
    }
    for (const ColumnPos column : columns)
        for (const i32 slot : pending[column])
            withdraw_outflow(field, slot);
    if (dimension.info().has_sky)
        for (const ColumnPos column : columns)
            follow_heights(field, column, heights_of(dimension, column));
    field.run_withdrawal();
    for (const ColumnPos column : columns) {
        const ColumnHeights heights = dimension.info().has_sky ? heights_of(dimension, column) : ColumnHeights{};
        solve_column(field, pending[column], heights);
    }
    // A chunk that stayed while its neighbor was away may have kept light that came through it.
    for (const ColumnPos column : columns)
        for (const i32 slot : pending[column])
            for (u32 face = 0; face < 6; ++face) {
                const i32 to = field.beside(slot, face);
                if (to != LightField::kNone && !field.slot(to).fresh) field.withdraw_unsupported(to, face ^ 1);
            }
    field.run_withdrawal();
    field.run_spread();
    field.finish(out.light_chunks);
    return out;
}

void relight(Dimension& dimension, ChangeSet& changes) {
    if (changes.blocks.empty()) return;
    LightField& field = field_of_thread();
    field.start(dimension);
    const bool has_sky = dimension.info().has_sky;
    const StateLight* lights = field.lights();
    std::vector<u32> edited; // cells
    std::unordered_map<ColumnPos, ColumnHeights> heights;
    const auto height_at = [&](BlockPos p) {
        const ColumnPos column = column_of(chunk_of(p));
        auto it = heights.find(column);
        if (it == heights.end()) it = heights.emplace(column, heights_of(dimension, column)).first;
        return it->second.above[std::size_t(local_of(p).index & 255)];
    };
    const auto matters = [&](const BlockChange& c) {
        const StateLight a = lights[u32(c.before)], b = lights[u32(c.after)];
        return std::max<u8>(a.opacity, 1) != std::max<u8>(b.opacity, 1) || (a.opacity == 0) != (b.opacity == 0) ||
               LightField::emission(a) != LightField::emission(b);
    };
    for (const BlockChange& c : changes.blocks)
        if (has_sky && matters(c)) follow_height(field, c.at.x, c.at.z, height_at(c.at));
    for (const BlockChange& c : changes.blocks) {
        if (!matters(c)) continue;
        const i32 slot = field.slot_at(chunk_of(c.at));
        if (slot == LightField::kNone) continue;
        field.open(slot);
        const u32 index = local_of(c.at).index;
        const LightField::Slot& s = field.slot(slot);
        const u32 before = spread_light(s.cells[index]);
        u32 now = field.emission_of(s, index); // as the dimension has it: the last of several edits
        if (has_sky && c.at.y >= height_at(c.at)) now |= kSkyFull;
        s.cells[index] = pack_light(now);
        const u32 lost = before & lanes_lit(lanes_minus(before, now));
        const u32 cell = u32(slot) << 12 | index;
        if (lost) field.withdrawn.push_back({cell, lost});
        edited.push_back(cell);
    }
    field.run_withdrawal();
    for (const u32 cell : edited) {
        field.gather(i32(cell >> 12), cell & 4095);
        field.rising.push_back(cell);
    }
    field.run_spread();
    field.finish(changes.light_chunks);
}

} // namespace vitrail
