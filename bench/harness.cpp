#include "bench/harness.h"

#include "base/clock.h"

#include <algorithm>
#include <cstdio>
#include <fmt/format.h>
#include <fstream>
#include <thread>

namespace vitrail::bench {

void Context::measure(double items, const std::function<void()>& body) {
    measure(
        items, [] {}, body);
}

void Context::measure(double items, const std::function<void()>& before, const std::function<void()>& body) {
    before();
    body();
    const u64 start = now_ns();
    while (seconds_an_item.size() < 7 || (seconds_since(start) < 0.3 && seconds_an_item.size() < 2000)) {
        before();
        const u64 t = now_ns();
        body();
        seconds_an_item.push_back(seconds_since(t) / items);
    }
}

void Context::report(double value) {
    values.push_back(value);
}
void Context::skip(std::string reason) {
    skipped = std::move(reason);
}

void Suite::add(std::string name, std::string unit, std::string note, Body body) {
    entries_.push_back({std::move(name), std::move(unit), std::move(note), std::move(body)});
}

static double scaled(double seconds, const std::string& unit) {
    if (unit.starts_with("ns")) return seconds * 1e9;
    if (unit.starts_with("us")) return seconds * 1e6;
    if (unit.starts_with("ms")) return seconds * 1e3;
    if (unit.starts_with("M") && unit.ends_with("/s")) return 1e-6 / seconds;
    if (unit.ends_with("/s")) return 1.0 / seconds;
    return seconds;
}

std::vector<Sample> Suite::run(const std::vector<std::string>& wanted,
                               const std::map<std::string, std::string>& options) {
    std::vector<Sample> samples;
    for (const Entry& entry : entries_) {
        const bool chosen = wanted.empty() || std::any_of(wanted.begin(), wanted.end(), [&](const std::string& w) {
                                return entry.name.starts_with(w);
                            });
        if (!chosen) continue;
        Context context;
        context.options = options;
        entry.body(context);
        if (!context.skipped.empty()) {
            fmt::print("{:24} skipped: {}\n", entry.name, context.skipped);
            continue;
        }
        std::vector<double> values = context.values;
        for (double s : context.seconds_an_item)
            values.push_back(scaled(s, entry.unit));
        if (values.empty()) continue;
        std::sort(values.begin(), values.end());
        Sample sample{entry.name,     entry.unit,    entry.note,        values[values.size() / 2],
                      values.front(), values.back(), int(values.size())};
        fmt::print("{:24} {:12.3f} {:10} (min {:.3f}, max {:.3f}, {} runs) {}\n", sample.name, sample.median,
                   sample.unit, sample.min, sample.max, sample.runs, sample.note);
        std::fflush(stdout);
        samples.push_back(std::move(sample));
    }
    return samples;
}

std::vector<std::string> Suite::names() const {
    std::vector<std::string> names;
    for (const Entry& entry : entries_)
        names.push_back(entry.name);
    return names;
}

static std::string cpu_model() {
    std::ifstream file("/proc/cpuinfo");
    for (std::string line; std::getline(file, line);)
        if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
    return "unknown";
}

bool write_json(const std::string& path, const std::vector<Sample>& samples) {
    std::string out =
        fmt::format("{{\"machine\": {{\"cpu\": \"{}\", \"threads\": {}, \"compiler\": \"{}\"}},\n \"results\": [",
                    cpu_model(), std::thread::hardware_concurrency(), __VERSION__);
    for (std::size_t i = 0; i < samples.size(); ++i) {
        const Sample& s = samples[i];
        out += fmt::format("{}\n  {{\"name\": \"{}\", \"unit\": \"{}\", \"median\": {}, \"min\": {}, \"max\": {}, "
                           "\"runs\": {}, \"note\": \"{}\"}}",
                           i ? "," : "", s.name, s.unit, s.median, s.min, s.max, s.runs, s.note);
    }
    out += "\n ]}\n";
    std::ofstream file(path);
    file << out;
    return bool(file.flush());
}

int run_main(Suite& suite, int argc, char** argv) {
    std::vector<std::string> wanted;
    std::string json;
    for (int i = 1; i < argc; ++i) {
        if (std::string(argv[i]) == "--json" && i + 1 < argc)
            json = argv[++i];
        else
            wanted.emplace_back(argv[i]);
    }
    const auto samples = suite.run(wanted, {});
    if (!json.empty() && !write_json(json, samples)) {
        fmt::print(stderr, "bench: cannot write {}\n", json);
        return 2;
    }
    return 0;
}

} // namespace vitrail::bench
