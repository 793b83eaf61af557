// Many rays at once on a CPU: several are in flight, and lanes whose ray has ended take the next one. Results are those
// of closest_hit and shadowed, bit for bit, whatever the CPU.
#pragma once

#include "trace/kernel/traverse.h"

#include <span>

namespace vitrail::trace {

struct RayStream {
    std::span<const Ray> rays;
    std::span<const float> t_max; // a ray's; empty: kFar
    std::span<const u8> media;    // a ray's (SceneView::media); empty: air
};

// hits: one a ray, HitKind::nothing where there is none.
void trace_stream(const SceneView& scene, const RayStream& rays, std::span<Hit> hits);

enum class Lit : u8 {
    open = 0,   // nothing is in the way
    shadow = 1, // something opaque is, or leaves
    panes = 2,  // something that light goes straight through, at least in part, is met first: ask shadowed()
};
void shadow_stream(const SceneView& scene, const RayStream& rays, std::span<Lit> lit);

// Which code runs: chosen by CPU, or asked for (tests, benchmarks).
enum class StreamCode : u8 { best, scalar, avx512 };
bool stream_code_available(StreamCode code);
StreamCode chosen_stream_code(StreamCode code); // what `best` is here
void trace_stream(StreamCode code, const SceneView& scene, const RayStream& rays, std::span<Hit> hits);
void shadow_stream(StreamCode code, const SceneView& scene, const RayStream& rays, std::span<Lit> lit);

} // namespace vitrail::trace
