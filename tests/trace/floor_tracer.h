// A tracer over a floor of stone: one chunk at 0 whose lowest layer is full, of the base content's looks.
#pragma once

#include "content_fixture.h"
#include "trace/tracer.h"

namespace vitrail::trace {

// The same one each time, since it is slow to make: with the floor and nothing else, and no frame so far. Null where
// the device is not there.
inline Tracer* on_a_floor(Device device) {
    const BaseContent& c = base_content(); // lives longer
    static std::unique_ptr<Tracer> made[2];
    std::unique_ptr<Tracer>& tracer = made[u32(device)];
    if (!tracer) {
        auto one = Tracer::create({.device = device, .window_chunks = 8});
        if (!one) return nullptr;
        tracer = std::move(*one);
        EXPECT_TRUE(tracer->set_content(c.models, *c.states, &c.pictures));
    }
    auto floor = std::make_shared<Chunk>();
    for (i32 i = 0; i < 256; ++i)
        floor->blocks.set(LocalPos(i % 16, 0, i / 16), StateId(c.id("stone")));
    tracer->clear();
    tracer->set_chunk({0, 0, 0}, DimensionId{}, floor, nullptr);
    return tracer.get();
}

// What one frame leaves in the film.
struct Shot {
    std::vector<Vec3> color, normal, albedo;
    std::vector<float> distance, samples;
};
inline std::vector<Vec3> triples(const std::vector<float>& v) {
    std::vector<Vec3> out;
    for (std::size_t i = 0; i + 2 < v.size(); i += 3)
        out.push_back({v[i], v[i + 1], v[i + 2]});
    return out;
}
inline Shot shoot(Tracer& tracer, const scene::FrameView& frame, const TraceSettings& settings) {
    const auto done = tracer.render(frame, settings);
    EXPECT_TRUE(done) << done.error().message;
    return {triples(tracer.read(Layer::color)), triples(tracer.read(Layer::normal)),
            triples(tracer.read(Layer::albedo)), tracer.read(Layer::distance), tracer.read(Layer::samples)};
}

} // namespace vitrail::trace
