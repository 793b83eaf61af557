// Benchmarks of the hot paths: each has a name that stays, a unit, and reports the median of several runs.
//
//     void register_voxel_benches(bench::Suite& suite) {
//         suite.add("codec.encode", "us", "a terrain chunk, one core", [](bench::Context& c) {
//             auto chunks = make_chunks();                       // set-up, not timed
//             c.measure(chunks.size(), [&] { for (auto& chunk : chunks) bench::keep(encode(chunk)); });
//         });
//     }
//
// The unit's name decides the scale: "ns", "us", "ms" are time an item; "/s" is items a second, "M/s" millions;
// anything else is what `report` was given (bytes a chunk, ...).
#pragma once

#include "base/types.h"

#include <functional>
#include <map>
#include <string>
#include <vector>

namespace vitrail::bench {

struct Sample {
    std::string name, unit, note;
    double median = 0, min = 0, max = 0;
    int runs = 0;
};

class Context {
public:
    // Warms up once, then times `body` until at least 7 runs and ~0.3 s are done; items: work units one call does.
    void measure(double items, const std::function<void()>& body);
    // As measure, with untimed work before each run (state that the run spoils).
    void measure(double items, const std::function<void()>& before, const std::function<void()>& body);
    // A figure that is not a time: bytes a chunk, quads, ...
    void report(double value);
    // Why this cannot be measured here (no fixture, no device); the row is left out of JSON and said on the screen.
    void skip(std::string reason);
    // Options of `vitrail bench`: world, at, look, shaders.
    std::map<std::string, std::string> options;
    std::vector<double> seconds_an_item, values;
    std::string skipped;
};

class Suite {
public:
    using Body = std::function<void(Context&)>;
    void add(std::string name, std::string unit, std::string note, Body body);
    // Runs those whose name starts with one of `wanted` (all where empty); prints a line each.
    std::vector<Sample> run(const std::vector<std::string>& wanted, const std::map<std::string, std::string>& options);
    std::vector<std::string> names() const;

private:
    struct Entry {
        std::string name, unit, note;
        Body body;
    };
    std::vector<Entry> entries_;
};

// Writes {"machine": {...}, "results": [...]}; false where the file cannot be written.
bool write_json(const std::string& path, const std::vector<Sample>& samples);
int run_main(Suite& suite, int argc, char** argv); // NAME... [--json FILE]

// Keeps the compiler from dropping a result.
template <class T>
inline void keep(const T& value) {
    asm volatile("" : : "r,m"(&value) : "memory");
}

} // namespace vitrail::bench
