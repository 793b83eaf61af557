// Many paths at once on a CPU, in rounds: the rays of all that go on are traced as one stream, then every path's event
// happens, then the rays to lights go as another. Sums are those of trace_path (trace/kernel/path.h), bit for bit,
// whatever the CPU.
#pragma once

#include "trace/cpu/ray_stream.h"
#include "trace/kernel/path.h"

#include <memory>
#include <span>

namespace vitrail::trace {

// Which path of a picture.
struct PathStart {
    u32 x, y;   // pixel
    u32 sample; // of this frame
};

// Room that one thread's paths need, kept from call to call; grows to the most paths asked for.
class PathRoom {
public:
    PathRoom();
    ~PathRoom();
    PathRoom(PathRoom&&) noexcept;
    PathRoom& operator=(PathRoom&&) noexcept;

    struct Arrays;
    Arrays& arrays(u32 paths); // for so many

private:
    std::unique_ptr<Arrays> arrays_;
};

// As many paths as keep their state in a core's second cache.
inline constexpr u32 kPathsAtOnce = 1024;

// sums: one a path. Returns how many rays were traced. Paths that start beside each other should be neighbors: they
// meet the same chunks.
u64 trace_paths(const SceneView& scene, const SkyView& sky, const Camera& camera, const PathSettings& settings,
                std::span<const PathStart> paths, std::span<PixelSample> sums, PathRoom& room,
                StreamCode code = StreamCode::best);

} // namespace vitrail::trace
