// SectionAsks: which sections the player could see and the replica does not hold: where lines of sight (voxel/sight.h)
// leave what is known.
#pragma once

#include "math/vec.h"
#include "voxel/sight.h"
#include "world/dimension.h"

#include <unordered_map>
#include <unordered_set>
#include <vector>

namespace vitrail::replica {

struct Gaze {
    WorldPos eye;
    Vec3 forward{0, 0, 1};   // of unit length
    float half_angle = 0.9f; // radians from `forward` to the corners of the picture
};

class SectionAsks {
public:
    // The section came, went or has other blocks. Before the first look all are new, and nothing is kept.
    void changed(ChunkPos at) {
        if (looked_) changed_.insert(at);
    }
    // Whether the last answer may not hold any more.
    bool stale(const Gaze& gaze) const;
    // Within view_distance chunks, in any direction: first what lies in the picture, then the rest, each nearest first;
    // at most `most`.
    std::vector<ChunkPos> missing(const Dimension& dimension, const Gaze& gaze, u32 view_distance, std::size_t most);

private:
    std::unordered_set<ChunkPos> changed_;
    std::unordered_map<ChunkPos, SectionSight> known_;
    SightFlood flood_;
    Gaze answered_;
    bool looked_ = false;
};

} // namespace vitrail::replica
