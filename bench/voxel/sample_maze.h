// Rock with hollows, seeded, for tests and benchmarks of what can be seen from where: a maze of rooms, one a section,
// and crooked corridors between them; or caves, boxes hollowed out at random across sections.
#pragma once

#include "base/rng.h"
#include "voxel/block_storage.h"
#include "voxel/coords.h"

#include <algorithm>
#include <array>
#include <vector>

namespace vitrail::bench {

class SampleMaze {
public:
    static constexpr StateId kRock{2};

    // Sections 0 .. size - 1 on each axis, all rock.
    explicit SampleMaze(IVec3 size)
        : size_(size)
        , rock_(std::size_t(size.x) * std::size_t(size.y) * std::size_t(size.z) * kChunkVolume, 1) {}

    // Every room is joined to every other; `loops` of the walls left over (0..100 percent) have a door too.
    void carve_maze(Rng& rng, u32 loops) {
        std::vector<u8> seen(sections());
        std::vector<IVec3> path{
            {i32(rng.below(u32(size_.x))), i32(rng.below(u32(size_.y))), i32(rng.below(u32(size_.z)))}};
        carve_room(rng, path[0]), seen[index(path[0])] = 1;
        while (!path.empty()) {
            const IVec3 at = path.back();
            std::array<u32, 6> faces{0, 1, 2, 3, 4, 5};
            for (u32 i = 5; i > 0; --i)
                std::swap(faces[i], faces[rng.below(i + 1)]);
            bool went = false;
            for (u32 f : faces) {
                const IVec3 n = kFaceNormal[f], to{at.x + n.x, at.y + n.y, at.z + n.z};
                if (!inside(to)) continue;
                if (seen[index(to)]) {
                    if (rng.below(600) < loops) carve_door(rng, at, f);
                    continue;
                }
                carve_room(rng, to), carve_door(rng, at, f);
                seen[index(to)] = 1;
                path.push_back(to);
                went = true;
                break;
            }
            if (!went) path.pop_back();
        }
    }
    void carve_caves(Rng& rng, u32 boxes, u32 longest) {
        for (u32 i = 0; i < boxes; ++i) {
            i32 from[3], to[3];
            for (int a = 0; a < 3; ++a) {
                from[a] = i32(rng.below(u32(side(a))));
                to[a] = from[a] + i32(rng.below(longest));
            }
            carve({from[0], from[1], from[2]}, {to[0], to[1], to[2]});
        }
    }
    void carve(BlockPos from, BlockPos to) { // both included
        for (i32 y = std::max(from.y, 0); y <= std::min(to.y, side(1) - 1); ++y)
            for (i32 z = std::max(from.z, 0); z <= std::min(to.z, side(2) - 1); ++z)
                for (i32 x = std::max(from.x, 0); x <= std::min(to.x, side(0) - 1); ++x)
                    rock_[cell({x, y, z})] = 0;
    }

    IVec3 size() const { return size_; }
    i32 side(int axis) const { return (axis == 0 ? size_.x : axis == 1 ? size_.y : size_.z) * kChunkSize; }
    bool inside(BlockPos p) const {
        return p.x >= 0 && p.y >= 0 && p.z >= 0 && p.x < side(0) && p.y < side(1) && p.z < side(2);
    }
    bool rock(BlockPos p) const { return !inside(p) || rock_[cell(p)] != 0; } // all is rock around it
    // Somewhere in the open, `tries` permitting; else in the rock.
    BlockPos open_block(Rng& rng, u32 tries = 10000) const {
        BlockPos p;
        do
            p = {i32(rng.below(u32(side(0)))), i32(rng.below(u32(side(1)))), i32(rng.below(u32(side(2))))};
        while (rock(p) && tries-- > 0);
        return p;
    }
    BlockStorage blocks(ChunkPos at) const {
        std::vector<StateId> states(kChunkVolume);
        for (u32 i = 0; i < u32(kChunkVolume); ++i)
            states[i] = rock(block_at(at, LocalPos(i))) ? kRock : StateId::air;
        return BlockStorage::from_states(std::span<const StateId, kChunkVolume>(states));
    }
    template <class Visit>
    void each_section(Visit&& visit) const {
        for (i32 y = 0; y < size_.y; ++y)
            for (i32 z = 0; z < size_.z; ++z)
                for (i32 x = 0; x < size_.x; ++x)
                    visit(ChunkPos{x, y, z});
    }

private:
    bool inside(IVec3 s) const {
        return s.x >= 0 && s.y >= 0 && s.z >= 0 && s.x < size_.x && s.y < size_.y && s.z < size_.z;
    }
    std::size_t sections() const { return rock_.size() / kChunkVolume; }
    std::size_t index(IVec3 s) const {
        return (std::size_t(s.y) * std::size_t(size_.z) + std::size_t(s.z)) * std::size_t(size_.x) + std::size_t(s.x);
    }
    std::size_t cell(BlockPos p) const {
        return index({p.x >> 4, p.y >> 4, p.z >> 4}) * kChunkVolume + local_of(p).index;
    }
    void carve_room(Rng& rng, IVec3 s) {
        const i32 w = 2 + i32(rng.below(4)), h = 2 + i32(rng.below(3));
        const BlockPos o = origin_of({s.x, s.y, s.z});
        carve({o.x + 8 - w, o.y + 8 - h, o.z + 8 - w}, {o.x + 7 + w, o.y + 7 + h, o.z + 7 + w});
    }
    // From the room's middle to a place of its own on the wall, straight through it, and on to the middle beyond.
    void carve_door(Rng& rng, IVec3 s, u32 face) {
        const IVec3 n = kFaceNormal[face];
        const i32 axis = i32(face >> 1);
        const BlockPos o = origin_of({s.x, s.y, s.z});
        const BlockPos middle{o.x + 7, o.y + 7, o.z + 7};
        BlockPos wall{o.x + 2 + i32(rng.below(11)), o.y + 2 + i32(rng.below(11)), o.z + 2 + i32(rng.below(11))};
        (axis == 0   ? wall.x
         : axis == 1 ? wall.y
                     : wall.z) = axis == 0   ? middle.x + n.x * 6
                                 : axis == 1 ? middle.y + n.y * 6
                                             : middle.z + n.z * 6;
        const BlockPos out{wall.x + n.x * 4, wall.y + n.y * 4, wall.z + n.z * 4};
        const BlockPos beyond{middle.x + n.x * 16, middle.y + n.y * 16, middle.z + n.z * 16};
        tunnel(middle, wall), tunnel(wall, out), tunnel(out, beyond);
    }
    void tunnel(BlockPos a, BlockPos b) { // one axis after the other, two blocks wide
        const BlockPos c{b.x, a.y, a.z}, d{b.x, a.y, b.z};
        for (const auto& [p, q] : {std::pair{a, c}, std::pair{c, d}, std::pair{d, b}})
            carve({std::min(p.x, q.x), std::min(p.y, q.y), std::min(p.z, q.z)},
                  {std::max(p.x, q.x) + 1, std::max(p.y, q.y) + 1, std::max(p.z, q.z) + 1});
    }
    IVec3 size_;
    std::vector<u8> rock_;
};

} // namespace vitrail::bench
