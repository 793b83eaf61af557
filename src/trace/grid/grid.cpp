#include "trace/grid/grid.h"

#include "base/assert.h"
#include "base/hash.h"

#include <algorithm>
#include <bit>

namespace vitrail::trace {

namespace {

GridChunk absent_chunk() {
    GridChunk c{};
    c.bricks[0] = 0, c.bricks[1] = ~u64(0); // air stops rays through water
    c.masks[0] = kNoMasks, c.masks[1] = kAllMasks;
    c.opaque = kNoMasks;
    return c; // palette 0: air
}

u64 bricks_with_any(const BrickMasks& masks) {
    u64 out = 0;
    for (u32 i = 0; i < 64; ++i)
        out |= u64(masks[i] != 0) << i;
    return out;
}

// Bricks whose cells that stop rays through air are all opaque.
u64 plain_bricks(const u64* masks, const GridChunk& c) {
    if (c.opaque == c.masks[0]) return ~u64(0);
    u64 out = 0;
    for (u32 i = 0; i < 64; ++i)
        out |= u64(masks[u64(c.masks[0]) * 64 + i] == masks[u64(c.opaque) * 64 + i]) << i;
    return out;
}

u32 palette_capacity(std::size_t entries) {
    return u32(std::bit_ceil(entries));
}

} // namespace

Grid::Grid(const GridShape& shape)
    : shape_(shape) {
    VX_ASSERT(shape.bits_x >= 2 && shape.bits_x <= 7 && shape.bits_y >= 2 && shape.bits_y <= 7 && shape.bits_z >= 2 &&
              shape.bits_z <= 7);
    const u32 bits = shape.bits_x + shape.bits_y + shape.bits_z;
    areas_.resize(std::size_t(1) << (bits - 6));
    chunks_.resize(std::size_t(1) << bits);
    palette_sizes_.resize(std::size_t(1) << bits);
    first_ = {-(1 << shape.bits_x) / 2, -(1 << shape.bits_y) / 2, -(1 << shape.bits_z) / 2};
    clear();
}

void Grid::clear() {
    std::fill(areas_.begin(), areas_.end(), u64(0));
    std::fill(chunks_.begin(), chunks_.end(), absent_chunk());
    std::fill(palette_sizes_.begin(), palette_sizes_.end(), u16(0));
    masks_.clear(), indices_.clear(), palettes_.clear(), tints_.clear();
    tint_blocks_.clear(), tint_hashes_.clear();
    calm_.clear();
    held_count_ = 0;
    BrickMasks none{}, all;
    all.fill(~u64(0));
    masks_.fill(masks_.take(64), none); // kNoMasks
    masks_.fill(masks_.take(64), all);  // kAllMasks
    const u32 air = 0;
    palettes_.fill(palettes_.take(1), {&air, 1});
    std::vector<u32> plain(kTintWords, 0xffffffffu);
    tints_.fill(tints_.take(kTintWords), plain);
    skips_.reset(shape_.bits_x, shape_.bits_y, shape_.bits_z);
    stale_ = true;
    areas_dirty_.add(0, areas_.size() * sizeof(u64));
    chunks_dirty_.add(0, chunks_.size() * sizeof(GridChunk));
}

void Grid::set_states(std::span<const StateRecord> states, std::span<const MediumRecord> media) {
    u32 water = 0;
    for (u32 i = 1; i < media.size() && water == 0; ++i)
        if (media[i].kind == 1) water = i;
    const u32 top = media.empty() ? 0 : media[water].liquid_top;
    std::vector<u8> classes(states.size());
    for (std::size_t i = 0; i < states.size(); ++i)
        classes[i] = state_class(states[i], water, top);
    const std::size_t known = std::min(classes.size(), classes_.size());
    const bool same = classes.size() >= classes_.size() &&
                      std::equal(classes_.begin(), classes_.begin() + std::ptrdiff_t(known), classes.begin());
    classes_ = std::move(classes);
    water_ = water, water_top_ = top;
    if (!same) remake_all();
}

bool Grid::in_window(ChunkPos c) const {
    return (u32(c.x) - u32(first_.x)) >> shape_.bits_x == 0 && (u32(c.y) - u32(first_.y)) >> shape_.bits_y == 0 &&
           (u32(c.z) - u32(first_.z)) >> shape_.bits_z == 0;
}

u32 Grid::slot(ChunkPos at) const {
    const u32 x = u32(at.x) & ((1u << shape_.bits_x) - 1), y = u32(at.y) & ((1u << shape_.bits_y) - 1),
              z = u32(at.z) & ((1u << shape_.bits_z) - 1);
    return x | z << shape_.bits_x | y << (shape_.bits_x + shape_.bits_z);
}

bool Grid::holds(ChunkPos chunk) const {
    return in_window(chunk) && palette_sizes_[slot(chunk)] != 0;
}

bool Grid::center_on(ChunkPos chunk) {
    const auto least = [](i32 c, u32 bits) { return (c - (1 << bits) / 2 + 2) & ~3; };
    const IVec3 to{least(chunk.x, shape_.bits_x), least(chunk.y, shape_.bits_y), least(chunk.z, shape_.bits_z)};
    if (to == first_) return false;
    const IVec3 from = first_;
    // Dropped while the old window still holds: a slot means another chunk afterwards.
    const auto stays = [&](i32 c, i32 least_now, u32 bits) { return (u32(c) - u32(least_now)) >> bits == 0; };
    for (i32 y = 0; y < 1 << shape_.bits_y; ++y)
        for (i32 z = 0; z < 1 << shape_.bits_z; ++z) {
            const i32 cy = from.y + y, cz = from.z + z;
            const bool row_stays = stays(cy, to.y, shape_.bits_y) && stays(cz, to.z, shape_.bits_z);
            for (i32 x = 0; x < 1 << shape_.bits_x; ++x) {
                const i32 cx = from.x + x;
                if (row_stays && stays(cx, to.x, shape_.bits_x)) continue;
                if (palette_sizes_[slot({cx, cy, cz})] != 0) drop({cx, cy, cz});
            }
        }
    first_ = to;
    stale_ = true;
    // Slots of the layers that came in meant other chunks.
    const BrickBox window{
        {to.x * 4, to.y * 4, to.z * 4},
        {(to.x + (1 << shape_.bits_x)) * 4, (to.y + (1 << shape_.bits_y)) * 4, (to.z + (1 << shape_.bits_z)) * 4}};
    const auto enter = [&](i32 was, i32 now, u32 bits, i32 IVec3::*axis) {
        if (was == now) return;
        BrickBox box = window;
        const i32 size = 1 << bits;
        if (now > was)
            box.least.*axis = std::max(now, was + size) * 4;
        else
            box.most.*axis = std::min(now + size, was) * 4;
        skips_.change(box);
    };
    enter(from.x, to.x, shape_.bits_x, &IVec3::x);
    enter(from.y, to.y, shape_.bits_y, &IVec3::y);
    enter(from.z, to.z, shape_.bits_z, &IVec3::z);
    return true;
}

// Bricks of a chunk that stop rays through air, as they were and as they are.
void Grid::note_bricks(ChunkPos at, u64 before, u64 after) {
    stale_ = true;
    skips_.touch(at);
    const u64 changed = before ^ after;
    if (changed == 0) return;
    IVec3 least{3, 3, 3}, most{0, 0, 0};
    for (i32 b = 0; b < 64; ++b) {
        if (!(changed >> b & 1)) continue;
        const i32 x = b & 3, z = b >> 2 & 3, y = b >> 4;
        least = {std::min(least.x, x), std::min(least.y, y), std::min(least.z, z)};
        most = {std::max(most.x, x), std::max(most.y, y), std::max(most.z, z)};
    }
    skips_.change({{at.x * 4 + least.x, at.y * 4 + least.y, at.z * 4 + least.z},
                   {at.x * 4 + most.x + 1, at.y * 4 + most.y + 1, at.z * 4 + most.z + 1}});
}

void Grid::refresh(ThreadPool* pool) {
    refresh_water(pool);
    if (!stale_) return;
    stale_ = false;
    const GridView g = plain_view();
    skips_.refresh(g, pool);
    // Where anything is.
    IVec3 least{1 << 28, 1 << 28, 1 << 28}, most{-(1 << 28), -(1 << 28), -(1 << 28)};
    for (i32 y = 0; y < 1 << (shape_.bits_y - 2); ++y)
        for (i32 z = 0; z < 1 << (shape_.bits_z - 2); ++z)
            for (i32 x = 0; x < 1 << (shape_.bits_x - 2); ++x) {
                const IVec3 at{first_.x + x * 4, first_.y + y * 4, first_.z + z * 4};
                const u64 word = areas_[area_slot_of(g, at)];
                if (word == 0) continue;
                // Bits of an area: x | z << 2 | y << 4.
                const auto bounds = [](u32 four, i32 from, i32& low, i32& high) {
                    low = std::min(low, from + std::countr_zero(four));
                    high = std::max(high, from + 32 - std::countl_zero(four));
                };
                u32 xs = 0, ys = 0, zs = 0;
                for (u32 i = 0; i < 4; ++i) {
                    xs |= u32((word & 0x1111111111111111ull << i) != 0) << i;
                    zs |= u32((word & 0x000F000F000F000Full << 4 * i) != 0) << i;
                    ys |= u32((word >> 16 * i & 0xFFFF) != 0) << i;
                }
                bounds(xs, at.x, least.x, most.x);
                bounds(ys, at.y, least.y, most.y);
                bounds(zs, at.z, least.z, most.z);
            }
    const bool any = least.x < most.x;
    least_ = any ? least : first_;
    extent_[0] = any ? u32(most.x - least.x) : 0;
    extent_[1] = any ? u32(most.y - least.y) : 0;
    extent_[2] = any ? u32(most.z - least.z) : 0;
}

void Grid::prepare(const BlockStorage& blocks, Prepared& out) const {
    const auto palette = blocks.palette();
    out.palette.resize(palette.size());
    std::vector<u8> classes(palette.size());
    for (std::size_t i = 0; i < palette.size(); ++i) {
        u32 state = u32(palette[i]);
        if (state >= classes_.size()) state = classes_.size() > 1 ? u32(StateId::hidden) : 0;
        out.palette[i] = state;
        classes[i] = state < classes_.size() ? classes_[state] : 0;
    }
    make_chunk_masks(blocks, classes.data(), out.masks);
}

u32 Grid::store_masks(u32 old, const BrickMasks& masks) {
    u64 any = 0, all = ~u64(0);
    for (u64 w : masks)
        any |= w, all &= w;
    const bool own = old > kAllMasks;
    if (any == 0 || all == ~u64(0)) {
        if (own) masks_.give(old * 64, 64);
        return any == 0 ? kNoMasks : kAllMasks;
    }
    if (own) {
        masks_.write(old * 64, masks);
        return old;
    }
    const u32 at = masks_.take(64);
    masks_.fill(at, masks);
    return at / 64;
}

void Grid::store_chunk(u32 at, const GridChunk& chunk) {
    if (std::memcmp(&chunks_[at], &chunk, sizeof chunk) == 0) return;
    chunks_[at] = chunk;
    chunks_dirty_.add(at * sizeof(GridChunk), (at + 1) * sizeof(GridChunk));
}

void Grid::refresh_area(ChunkPos at) {
    const GridView g = plain_view();
    const u32 area = area_slot_of(g, {at.x, at.y, at.z}), chunk = slot(at);
    const u32 bit = u32(at.x & 3) | u32(at.z & 3) << 2 | u32(at.y & 3) << 4;
    const u64 now = (areas_[area] & ~(u64(1) << bit)) | u64(chunks_[chunk].bricks[0] != 0) << bit;
    if (now == areas_[area]) return;
    areas_[area] = now;
    areas_dirty_.add(area * sizeof(u64), (area + 1) * sizeof(u64));
}

void Grid::refresh_water(ThreadPool* pool) {
    for (const CalmWater::Made& made : calm_.refresh(pool)) {
        const u32 s = slot(made.at);
        GridChunk chunk = chunks_[s];
        chunk.masks[1] = store_masks(chunk.masks[1], made.masks.stops);
        chunk.bricks[1] = bricks_with_any(made.masks.stops);
        chunk.layers = made.masks.layers;
        store_chunk(s, chunk);
    }
}

void Grid::give_pieces(const GridChunk& chunk, u32 palette_size) {
    palettes_.give(chunk.palette, palette_capacity(palette_size));
    if (chunk.bits) indices_.give(chunk.indices, chunk.bits * 64);
}

void Grid::commit(ChunkPos at, const BlockStorage& blocks, Prepared& p) {
    const u32 s = slot(at);
    GridChunk chunk = chunks_[s];
    const u64 old_bricks = chunk.bricks[0];
    const u32 old_palette = palette_sizes_[s], old_masks = chunk.masks[0];
    const u64 old_plain = plain_bricks(masks_.data(), chunk);

    calm_.put(at, p.masks.water);
    // Blocks of masks: the opaque cells are often all that there is.
    const u32 old_opaque = chunk.opaque == chunk.masks[0] ? kNoMasks : chunk.opaque;
    chunk.masks[0] = store_masks(chunk.masks[0], p.masks.stops);
    chunk.bricks[0] = bricks_with_any(p.masks.stops);
    if (!any_cell(p.masks.water.holds)) { // else they follow in refresh
        if (chunk.masks[1] > kAllMasks) masks_.give(chunk.masks[1] * 64, 64);
        chunk.masks[1] = kAllMasks, chunk.bricks[1] = ~u64(0), chunk.layers = 0;
    }
    if (p.masks.opaque == p.masks.stops) {
        if (old_opaque > kAllMasks) masks_.give(old_opaque * 64, 64);
        chunk.opaque = chunk.masks[0];
    } else {
        chunk.opaque = store_masks(old_opaque, p.masks.opaque);
    }

    const u32 size = u32(p.palette.size()), bits = blocks.bits();
    if (old_palette == 0 || palette_capacity(old_palette) != palette_capacity(size) || chunk.bits != bits) {
        if (old_palette != 0) give_pieces(chunk, old_palette);
        chunk.palette = palettes_.take(palette_capacity(size));
        chunk.bits = bits;
        chunk.indices = bits ? indices_.take(bits * 64) : 0;
        palettes_.fill(chunk.palette, p.palette);
        if (bits) indices_.fill(chunk.indices, blocks.words());
    } else {
        palettes_.write(chunk.palette, p.palette);
        if (bits) indices_.write(chunk.indices, blocks.words());
    }
    if (old_palette == 0) ++held_count_;
    palette_sizes_[s] = u16(size);
    store_chunk(s, chunk);
    if (old_bricks != chunk.bricks[0] || old_masks != chunk.masks[0] || old_plain != plain_bricks(masks_.data(), chunk))
        note_bricks(at, old_bricks, chunk.bricks[0]);
    refresh_area(at);
}

void Grid::drop(ChunkPos at) {
    const u32 s = slot(at);
    if (palette_sizes_[s] == 0) return;
    const GridChunk chunk = chunks_[s];
    for (u32 set = 0; set < 2; ++set)
        if (chunk.masks[set] > kAllMasks) masks_.give(chunk.masks[set] * 64, 64);
    if (chunk.opaque > kAllMasks && chunk.opaque != chunk.masks[0]) masks_.give(chunk.opaque * 64, 64);
    give_pieces(chunk, palette_sizes_[s]);
    give_tints(chunk.tints);
    calm_.remove(at);
    palette_sizes_[s] = 0;
    --held_count_;
    store_chunk(s, absent_chunk());
    note_bricks(at, chunk.bricks[0], 0);
    refresh_area(at);
}

void Grid::give_tints(u32 block) {
    if (block == 0) return;
    const auto hash = tint_hashes_.find(block);
    auto& entry = tint_blocks_[hash->second];
    if (--entry.users != 0) return;
    tints_.give(block * kTintWords, kTintWords);
    tint_blocks_.erase(hash->second);
    tint_hashes_.erase(hash);
}

// Chunks of a column mostly have the same tints: equal blocks are kept once.
void Grid::set_tints(u32 s, const u32* tints) {
    GridChunk chunk = chunks_[s];
    u32 block = 0;
    if (tints) {
        u64 hash = 0;
        for (u32 i = 0; i < kTintWords; i += 2)
            hash = mix64(hash ^ (u64(tints[i]) << 32 | tints[i + 1]));
        for (;; ++hash) { // equal hashes of unequal blocks: the next number
            auto& entry = tint_blocks_[hash];
            if (entry.users == 0) {
                const u32 at = tints_.take(kTintWords);
                entry.block = at / kTintWords;
                tints_.fill(at, {tints, kTintWords});
                tint_hashes_[entry.block] = hash;
            } else if (std::memcmp(tints_.data() + u64(entry.block) * kTintWords, tints, kTintWords * 4) != 0) {
                continue;
            }
            ++entry.users;
            block = entry.block;
            break;
        }
    }
    give_tints(chunk.tints);
    chunk.tints = block;
    store_chunk(s, chunk);
}

void Grid::set_chunks(std::span<const Item> items, ThreadPool* pool) {
    constexpr std::size_t kBatch = 512;
    std::vector<Prepared> prepared(std::min(kBatch, items.size()));
    for (std::size_t first = 0; first < items.size(); first += kBatch) {
        const u32 count = u32(std::min(kBatch, items.size() - first));
        const auto make = [&](u32 i) {
            const Item& item = items[first + i];
            if (item.blocks && in_window(item.at)) prepare(*item.blocks, prepared[i]);
        };
        if (pool && count > 1)
            pool->parallel_for(count, make);
        else
            for (u32 i = 0; i < count; ++i)
                make(i);
        for (u32 i = 0; i < count; ++i) {
            const Item& item = items[first + i];
            if (!in_window(item.at)) continue;
            if (!item.blocks) {
                drop(item.at);
                continue;
            }
            commit(item.at, *item.blocks, prepared[i]);
            set_tints(slot(item.at), item.tints);
        }
    }
}

void Grid::set_chunk(ChunkPos at, const Chunk* chunk, const u32* tints) {
    const Item item{at, chunk ? &chunk->blocks : nullptr, tints};
    set_chunks({&item, 1});
}

BlockStorage Grid::storage_of(u32 s) const {
    const GridChunk& c = chunks_[s];
    std::vector<StateId> palette(palette_sizes_[s]);
    for (std::size_t i = 0; i < palette.size(); ++i)
        palette[i] = StateId(palettes_[c.palette + i]);
    const u64* words = indices_.data() + c.indices;
    return BlockStorage::from_packed(std::move(palette),
                                     c.bits ? std::vector<u64>(words, words + c.bits * 64) : std::vector<u64>());
}

void Grid::apply_by_chunk(std::span<const Edit> edits) {
    // Grouped by chunk, each group in the order given.
    std::vector<u32> order(edits.size());
    for (u32 i = 0; i < order.size(); ++i)
        order[i] = i;
    std::sort(order.begin(), order.end(), [&](u32 a, u32 b) {
        const ChunkPos p = chunk_of(edits[a].at), q = chunk_of(edits[b].at);
        return p.y != q.y ? p.y < q.y : p.z != q.z ? p.z < q.z : p.x != q.x ? p.x < q.x : a < b;
    });
    Prepared prepared;
    for (std::size_t i = 0; i < order.size();) {
        const ChunkPos at = chunk_of(edits[order[i]].at);
        std::size_t end = i + 1;
        while (end < order.size() && chunk_of(edits[order[end]].at) == at)
            ++end;
        if (holds(at)) {
            BlockStorage blocks = storage_of(slot(at));
            for (std::size_t k = i; k < end; ++k)
                blocks.set(local_of(edits[order[k]].at), edits[order[k]].state);
            prepare(blocks, prepared);
            commit(at, blocks, prepared);
        }
        i = end;
    }
}

void Grid::apply(const ChangeSet& changes) {
    std::vector<Edit> edits;
    edits.reserve(changes.blocks.size());
    for (const BlockChange& c : changes.blocks)
        edits.push_back({c.at, c.after});
    apply_by_chunk(edits);
}

void Grid::apply(const EditBatch& batch) {
    apply_by_chunk(batch.edits);
}

void Grid::remake_all() {
    Prepared prepared;
    const IVec3 f = first_;
    for (i32 y = 0; y < 1 << shape_.bits_y; ++y)
        for (i32 z = 0; z < 1 << shape_.bits_z; ++z)
            for (i32 x = 0; x < 1 << shape_.bits_x; ++x) {
                const ChunkPos at{f.x + x, f.y + y, f.z + z};
                if (!holds(at)) continue;
                const BlockStorage blocks = storage_of(slot(at));
                prepare(blocks, prepared);
                commit(at, blocks, prepared);
            }
}

GridView Grid::view() {
    refresh();
    return plain_view();
}

GridView Grid::view() const {
    GridView g = plain_view();
    if (stale_) g.skips = nullptr;
    if (calm_.pending()) g.water = 0;
    return g;
}

GridView Grid::plain_view() const {
    GridView g;
    g.first = first_;
    g.bits_x = shape_.bits_x, g.bits_y = shape_.bits_y, g.bits_z = shape_.bits_z;
    g.areas = areas_.data();
    g.chunks = chunks_.data();
    g.masks = masks_.data();
    g.palettes = palettes_.data();
    g.indices = indices_.data();
    g.tints = tints_.data();
    g.water = water_, g.water_top = water_top_;
    g.skips = skips_.data();
    g.skip_shift_z = g.bits_x + 2, g.skip_shift_y = g.bits_x + g.bits_z + 4;
    g.skip_x = (16u << g.bits_x) - 4;
    g.skip_z = ((16u << g.bits_z) - 4) << g.skip_shift_z;
    g.skip_y = ((16u << g.bits_y) - 4) << g.skip_shift_y;
    g.least = least_;
    g.extent_x = extent_[0], g.extent_y = extent_[1], g.extent_z = extent_[2];
    return g;
}

std::span<const std::byte> Grid::buffer(GridBuffer which) const {
    const auto bytes = [](const auto* data, u64 count) { return std::as_bytes(std::span(data, std::size_t(count))); };
    switch (which) {
    case GridBuffer::areas:
        return bytes(areas_.data(), areas_.size());
    case GridBuffer::chunks:
        return bytes(chunks_.data(), chunks_.size());
    case GridBuffer::masks:
        return bytes(masks_.data(), masks_.size());
    case GridBuffer::palettes:
        return bytes(palettes_.data(), palettes_.size());
    case GridBuffer::indices:
        return bytes(indices_.data(), indices_.size());
    case GridBuffer::tints:
        return bytes(tints_.data(), tints_.size());
    case GridBuffer::skips:
        return bytes(skips_.data(), skips_.size());
    }
    return {};
}

std::span<const DirtyRanges::Range> Grid::dirty(GridBuffer which) const {
    switch (which) {
    case GridBuffer::areas:
        return areas_dirty_.ranges();
    case GridBuffer::chunks:
        return chunks_dirty_.ranges();
    case GridBuffer::masks:
        return masks_.dirty.ranges();
    case GridBuffer::palettes:
        return palettes_.dirty.ranges();
    case GridBuffer::indices:
        return indices_.dirty.ranges();
    case GridBuffer::tints:
        return tints_.dirty.ranges();
    case GridBuffer::skips:
        return skips_.dirty.ranges();
    }
    return {};
}

void Grid::clean() {
    areas_dirty_.clear(), chunks_dirty_.clear();
    masks_.dirty.clear(), indices_.dirty.clear(), palettes_.dirty.clear(), tints_.dirty.clear();
    skips_.dirty.clear();
}

u64 Grid::memory_bytes() const {
    return areas_.size() * 8 + chunks_.size() * sizeof(GridChunk) + palette_sizes_.size() * 2 + masks_.bytes() +
           skips_.bytes() + indices_.bytes() + palettes_.bytes() + tints_.bytes() + calm_.bytes() + classes_.size();
}

} // namespace vitrail::trace
