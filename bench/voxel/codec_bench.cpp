// codec.encode, codec.decode, codec.size over a terrain with light; the .blocks rows leave light, biomes and revision
// out.
#include "bench/harness.h"
#include "bench/voxel/sample_chunks.h"
#include "voxel/chunk_codec.h"

namespace {

using namespace vitrail;

const std::vector<bench::SampleChunk>& samples() {
    static const auto chunks = bench::make_sample_chunks();
    return chunks;
}

std::vector<Bytes> encoded(u32 parts) {
    std::vector<Bytes> out;
    for (const auto& s : samples())
        out.push_back(encode_chunk(*s.chunk, parts));
    return out;
}

void add(bench::Suite& suite, const std::string& tail, u32 parts, const std::string& what) {
    suite.add("codec.encode" + tail, "us", what, [parts](bench::Context& c) {
        Bytes out;
        c.measure(double(samples().size()), [&] {
            for (const auto& s : samples()) {
                out.clear();
                encode_chunk(*s.chunk, parts, out);
                bench::keep(out);
            }
        });
    });
    suite.add("codec.decode" + tail, "us", what, [parts](bench::Context& c) {
        const auto records = encoded(parts);
        const DecodeLimits limits{.state_count = bench::kSampleStates, .biome_count = bench::kSampleBiomes};
        c.measure(double(records.size()), [&] {
            for (const auto& r : records)
                bench::keep(decode_chunk(r, limits));
        });
    });
    suite.add("codec.size" + tail, "bytes", what, [parts](bench::Context& c) {
        double total = 0;
        const auto records = encoded(parts);
        for (const auto& r : records)
            total += double(r.size());
        c.report(total / double(records.size()));
    });
}

} // namespace

void register_sight_benches(bench::Suite& suite); // sight_bench.cpp

void register_voxel_benches(bench::Suite& suite) {
    register_sight_benches(suite);
    add(suite, "", kChunkAll, "a terrain chunk with its light, empty ones included, one core");
    add(suite, ".blocks", kChunkBlocks, "the same, blocks only");
}
