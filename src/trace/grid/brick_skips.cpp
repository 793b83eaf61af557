#include "trace/grid/brick_skips.h"

#include <algorithm>

namespace vitrail::trace {

namespace {

constexpr std::size_t kBoxesMost = 256; // kept apart; more become one
constexpr i64 kLarge = 2048;            // bricks: from here on threads share the work
constexpr i32 kBack = i32(kSkipMost) - 1;

i64 volume(const BrickBox& b) {
    return i64(b.most.x - b.least.x) * (b.most.y - b.least.y) * (b.most.z - b.least.z);
}
BrickBox joined(const BrickBox& a, const BrickBox& b) {
    return {{std::min(a.least.x, b.least.x), std::min(a.least.y, b.least.y), std::min(a.least.z, b.least.z)},
            {std::max(a.most.x, b.most.x), std::max(a.most.y, b.most.y), std::max(a.most.z, b.most.z)}};
}
BrickBox clipped(const BrickBox& a, const BrickBox& b) {
    return {{std::max(a.least.x, b.least.x), std::max(a.least.y, b.least.y), std::max(a.least.z, b.least.z)},
            {std::min(a.most.x, b.most.x), std::min(a.most.y, b.most.y), std::min(a.most.z, b.most.z)}};
}
bool empty(const BrickBox& b) {
    return b.least.x >= b.most.x || b.least.y >= b.most.y || b.least.z >= b.most.z;
}

u32 word_of(const GridView& g, i32 x, i32 y, i32 z) {
    return skip_index(g, {x, y, z});
}

bool stops(const GridView& g, i32 x, i32 y, i32 z) {
    const GridChunk& c = g.chunks[slot_of(g, {x >> 2, y >> 2, z >> 2})];
    return c.bricks[0] >> (u32(x & 3) | u32(z & 3) << 2 | u32(y & 3) << 4) & 1;
}

BrickBox window_of(const GridView& g) {
    const IVec3 f = g.first;
    return {{f.x * 4, f.y * 4, f.z * 4},
            {(f.x + (1 << g.bits_x)) * 4, (f.y + (1 << g.bits_y)) * 4, (f.z + (1 << g.bits_z)) * 4}};
}

} // namespace

void BrickSkips::reset(u32 bits_x, u32 bits_y, u32 bits_z) {
    words_.assign(std::size_t(64) << (bits_x + bits_y + bits_z), kNoStops);
    changed_.clear(), touched_.clear();
    all_ = true;
}

void BrickSkips::change(const BrickBox& box) {
    if (all_) return;
    // Changes close to each other are solved as one where that is no more work.
    for (BrickBox& b : changed_) {
        const BrickBox both = joined(b, box);
        const auto work = [](const BrickBox& c) {
            return volume({c.least, {c.most.x + kBack, c.most.y + kBack, c.most.z + kBack}});
        };
        if (work(both) <= work(b) + work(box)) {
            b = both;
            return;
        }
    }
    if (changed_.size() < kBoxesMost)
        changed_.push_back(box);
    else
        changed_.back() = joined(changed_.back(), box);
}

void BrickSkips::touch(ChunkPos chunk) {
    if (!all_ && (touched_.empty() || touched_.back() != chunk)) touched_.push_back(chunk);
}

void BrickSkips::point_to_masks(const GridView& g, IVec3 chunk) {
    const GridChunk& c = g.chunks[slot_of(g, chunk)];
    for (u32 b = 0; b < 64; b += 4) {
        u32* words = &words_[word_of(g, chunk.x * 4, chunk.y * 4 + i32(b >> 4), chunk.z * 4 + i32(b >> 2 & 3))];
        for (u32 x = 0; x < 4; ++x)
            if (c.bricks[0] >> (b + x) & 1) {
                const u32 at = c.masks[0] * 64 + b + x;
                const bool plain = g.masks[at] == g.masks[c.opaque * 64 + b + x];
                words[x] = kBrickStops | (plain ? kBrickPlain : 0u) | at;
            } else if (words[x] & kBrickStops) {
                words[x] = kNoStops;
            }
    }
}

// Values of one octant for the bricks of `box`, from ahead to behind; those in `write` are kept. What lies ahead of the
// box is taken from the words there, or as empty.
void BrickSkips::solve(const GridView& g, u32 octant, const BrickBox& box, const BrickBox& write, bool ahead_known) {
    const BrickBox window = window_of(g);
    const i32 nx = box.most.x - box.least.x, ny = box.most.y - box.least.y, nz = box.most.z - box.least.z;
    const bool up_x = octant & 1, up_y = octant & 2, up_z = octant & 4;
    // i, j, k: steps behind the plane ahead of the box; 0 is beyond it.
    const auto x_of = [&](i32 i) { return up_x ? box.most.x - i : box.least.x + i - 1; };
    const auto y_of = [&](i32 j) { return up_y ? box.most.y - j : box.least.y + j - 1; };
    const auto z_of = [&](i32 k) { return up_z ? box.most.z - k : box.least.z + k - 1; };
    const auto known = [&](i32 x, i32 y, i32 z) -> u8 {
        if (!ahead_known || x < window.least.x || x >= window.most.x || y < window.least.y || y >= window.most.y ||
            z < window.least.z || z >= window.most.z)
            return u8(kSkipMost);
        const u32 word = words_[word_of(g, x, y, z)];
        return word & kBrickStops ? u8(0) : u8(brick_skip(word, octant));
    };
    const std::size_t row = std::size_t(nx) + 1;
    std::vector<u8> planes[2] = {std::vector<u8>(row * std::size_t(nz + 1)),
                                 std::vector<u8>(row * std::size_t(nz + 1))};
    std::vector<u8> least(row);
    for (i32 k = 0; k <= nz; ++k)
        for (i32 i = 0; i <= nx; ++i)
            planes[0][std::size_t(k) * row + std::size_t(i)] = known(x_of(i), y_of(0), z_of(k));
    const u32 shift = skip_shift(octant);
    for (i32 j = 1; j <= ny; ++j) {
        const u8* ahead = planes[(j + 1) & 1].data();
        u8* now = planes[j & 1].data();
        const i32 y = y_of(j);
        for (i32 i = 0; i <= nx; ++i)
            now[i] = known(x_of(i), y, z_of(0));
        const bool write_y = y >= write.least.y && y < write.most.y;
        for (i32 k = 1; k <= nz; ++k) {
            const i32 z = z_of(k);
            const bool write_row = write_y && z >= write.least.z && z < write.most.z;
            const u8 *a = ahead + std::size_t(k) * row, *b = a - row, *c = now + std::size_t(k - 1) * row;
            u8* to = now + std::size_t(k) * row;
            for (std::size_t i = 0; i < row; ++i)
                least[i] = std::min(a[i], std::min(b[i], c[i]));
            to[0] = known(x_of(0), y, z);
            for (i32 i = 1; i <= nx; ++i) {
                const i32 x = x_of(i);
                if (stops(g, x, y, z)) {
                    to[i] = 0;
                    continue;
                }
                const u8 n = std::min(std::min(least[std::size_t(i)], least[std::size_t(i - 1)]), to[i - 1]);
                to[i] = u8(std::min<u32>(n + 1u, kSkipMost));
                if (!write_row || x < write.least.x || x >= write.most.x) continue; // another thread's, perhaps
                u32& word = words_[word_of(g, x, y, z)];
                word = (word & ~(7u << shift)) | u32(to[i] - 1) << shift;
            }
        }
    }
}

// All values that a change in a large box can reach, in layers that threads share: each solves what lies ahead of its
// own once more, as far as it matters, and reads nothing that others write.
void BrickSkips::solve_in_layers(const GridView& g, const BrickBox& changed, ThreadPool* pool) {
    const BrickBox window = window_of(g);
    constexpr i32 kLayer = 16;
    const i32 from = std::max(changed.least.y - kBack, window.least.y),
              to = std::min(changed.most.y + kBack, window.most.y);
    const auto solve_layer = [&](u32 layer) {
        const i32 least = from + i32(layer) * kLayer, most = std::min(least + kLayer, to);
        for (u32 octant = 0; octant < 8; ++octant) {
            BrickBox write = changed;
            (octant & 1 ? write.least.x : write.most.x) += octant & 1 ? -kBack : kBack;
            (octant & 2 ? write.least.y : write.most.y) += octant & 2 ? -kBack : kBack;
            (octant & 4 ? write.least.z : write.most.z) += octant & 4 ? -kBack : kBack;
            write.least.y = std::max(write.least.y, least), write.most.y = std::min(write.most.y, most);
            write = clipped(write, window);
            if (empty(write)) continue;
            BrickBox box = write;
            (octant & 1 ? box.most.x : box.least.x) += octant & 1 ? kBack : -kBack;
            (octant & 2 ? box.most.y : box.least.y) += octant & 2 ? kBack : -kBack;
            (octant & 4 ? box.most.z : box.least.z) += octant & 4 ? kBack : -kBack;
            solve(g, octant, clipped(box, window), write, false);
        }
    };
    const u32 layers = u32(std::max(0, (to - from + kLayer - 1) / kLayer));
    if (pool && layers > 1)
        pool->parallel_for(layers, solve_layer);
    else
        for (u32 i = 0; i < layers; ++i)
            solve_layer(i);
}

void BrickSkips::refresh(const GridView& g, ThreadPool* pool) {
    const BrickBox window = window_of(g);
    i64 work = 0;
    for (const BrickBox& b : changed_)
        work += volume({b.least, {b.most.x + kBack, b.most.y + kBack, b.most.z + kBack}});
    if (all_ || work > volume(window)) {
        for (i32 y = 0; y < 1 << g.bits_y; ++y)
            for (i32 z = 0; z < 1 << g.bits_z; ++z)
                for (i32 x = 0; x < 1 << g.bits_x; ++x)
                    point_to_masks(g, {g.first.x + x, g.first.y + y, g.first.z + z});
        solve_in_layers(g, window, pool);
        dirty.add(0, words_.size() * sizeof(u32));
        all_ = false;
        changed_.clear(), touched_.clear();
        return;
    }
    // Rows of bricks, all in the window; it may wrap around within a row.
    const auto note = [&](const BrickBox& b) {
        const u32 wide = 4u << g.bits_x, count = u32(b.most.x - b.least.x);
        for (i32 y = b.least.y; y < b.most.y; ++y)
            for (i32 z = b.least.z; z < b.most.z; ++z) {
                const u64 at = word_of(g, b.least.x, y, z), row = at & ~u64(wide - 1);
                const u64 before = std::min<u64>(count, row + wide - at);
                dirty.add(at * sizeof(u32), (at + before) * sizeof(u32));
                dirty.add(row * sizeof(u32), (row + count - before) * sizeof(u32));
            }
    };
    for (const ChunkPos& c : touched_)
        if (in_window(g, {c.x, c.y, c.z})) {
            point_to_masks(g, {c.x, c.y, c.z});
            note({{c.x * 4, c.y * 4, c.z * 4}, {c.x * 4 + 4, c.y * 4 + 4, c.z * 4 + 4}});
        }
    for (const BrickBox& b : changed_) {
        // Slots that mean other chunks now still point where the old ones did.
        const BrickBox inside = clipped(b, window);
        for (i32 y = inside.least.y >> 2; y << 2 < inside.most.y; ++y)
            for (i32 z = inside.least.z >> 2; z << 2 < inside.most.z; ++z)
                for (i32 x = inside.least.x >> 2; x << 2 < inside.most.x; ++x)
                    point_to_masks(g, {x, y, z});
    }
    for (const BrickBox& b : changed_) {
        BrickBox reach{{b.least.x - kBack, b.least.y - kBack, b.least.z - kBack},
                       {b.most.x + kBack, b.most.y + kBack, b.most.z + kBack}};
        const bool large = volume(b) > kLarge;
        if (large) solve_in_layers(g, b, pool);
        for (u32 octant = 0; octant < 8 && !large; ++octant) {
            BrickBox box = b;
            (octant & 1 ? box.least.x : box.most.x) += octant & 1 ? -kBack : kBack;
            (octant & 2 ? box.least.y : box.most.y) += octant & 2 ? -kBack : kBack;
            (octant & 4 ? box.least.z : box.most.z) += octant & 4 ? -kBack : kBack;
            box = clipped(box, window);
            if (!empty(box)) solve(g, octant, box, box, true);
        }
        note(clipped(reach, window));
    }
    changed_.clear(), touched_.clear();
}

} // namespace vitrail::trace
