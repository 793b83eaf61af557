// Runs a libFuzzer target without libFuzzer: the corpus as it is, then seeded mutations of it.
// Usage: TARGET [--runs N] [--seconds S] CORPUS_FILE_OR_FOLDER...   Exit status 0 unless the target crashes.
#include "../src/base/rng.h"

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size);

using Input = std::vector<unsigned char>;

static Input mutate(const std::vector<Input>& corpus, vitrail::Rng& rng) {
    Input out = corpus[rng.below(unsigned(corpus.size()))];
    for (unsigned steps = 1 + rng.below(8); steps > 0; --steps) {
        const unsigned at = out.empty() ? 0 : rng.below(unsigned(out.size()));
        switch (rng.below(7)) {
        case 0:
            if (!out.empty()) out[at] ^= (unsigned char)(1u << rng.below(8));
            break;
        case 1:
            if (!out.empty()) out[at] = (unsigned char)rng.below(256);
            break;
        case 2:
            out.insert(out.begin() + at, (unsigned char)rng.below(256));
            break;
        case 3:
            out.resize(at);
            break;
        case 4: // values at the edges of their types
            for (unsigned i = at; i < at + (1u << rng.below(4)) && i < out.size(); ++i)
                out[i] = rng.below(2) ? 0xff : 0x7f;
            break;
        case 5: { // a piece of another input
            const Input& other = corpus[rng.below(unsigned(corpus.size()))];
            if (other.empty()) break;
            const unsigned from = rng.below(unsigned(other.size()));
            const unsigned n = std::min<unsigned>(rng.below(64) + 1, unsigned(other.size()) - from);
            out.insert(out.begin() + at, other.begin() + from, other.begin() + from + n);
            break;
        }
        default:
            if (!out.empty()) out.erase(out.begin() + at);
            break;
        }
    }
    return out;
}

int main(int argc, char** argv) {
    long runs = 10000;
    double seconds = 10;
    std::vector<Input> corpus;
    auto load = [&](const std::filesystem::path& path) {
        std::ifstream file(path, std::ios::binary);
        corpus.emplace_back(std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>());
    };
    for (int i = 1; i < argc; ++i) {
        const std::string word = argv[i];
        if (word == "--runs" && i + 1 < argc)
            runs = std::atol(argv[++i]);
        else if (word == "--seconds" && i + 1 < argc)
            seconds = std::atof(argv[++i]);
        else if (std::filesystem::is_directory(word)) {
            for (const auto& entry : std::filesystem::recursive_directory_iterator(word))
                if (entry.is_regular_file()) load(entry.path());
        } else if (std::filesystem::exists(word))
            load(word);
    }
    const std::size_t seeds = corpus.size();
    if (corpus.empty()) corpus.push_back({});
    for (const Input& input : corpus)
        LLVMFuzzerTestOneInput(input.data(), input.size());
    vitrail::Rng rng(1);
    const auto start = std::chrono::steady_clock::now();
    long done = 0;
    for (; done < runs; ++done) {
        if (std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() > seconds) break;
        const Input input = mutate(corpus, rng);
        LLVMFuzzerTestOneInput(input.data(), input.size());
    }
    std::printf("fuzz: %zu seeds, %ld mutations, no crash\n", seeds, done);
    return 0;
}
