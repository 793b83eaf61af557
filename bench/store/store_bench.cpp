// store.put1, store.put64, store.get: encoded terrain chunks through the envelope and SQLite, as the server and the
// import use it.
#include "base/rng.h"
#include "bench/harness.h"
#include "bench/voxel/sample_chunks.h"
#include "store/keys.h"
#include "store/record.h"
#include "store/sqlite_store.h"
#include "voxel/chunk_codec.h"

#include <cstdlib>
#include <filesystem>
#include <unistd.h>

namespace {

using namespace vitrail;

struct Encoded {
    ChunkPos at;
    Bytes payload;
};

const std::vector<Encoded>& samples() {
    static const auto encoded = [] {
        std::vector<Encoded> out;
        for (const auto& s : bench::make_sample_chunks())
            out.push_back({s.at, encode_chunk(*s.chunk)});
        return out;
    }();
    return encoded;
}

class BenchWorld {
public:
    explicit BenchWorld(const char* synchronous, u32 page_bytes = 8192) {
        std::string name = (std::filesystem::temp_directory_path() / "vitrail-bench-XXXXXX").string();
        if (!::mkdtemp(name.data())) return;
        folder_ = name;
        auto opened =
            open_sqlite_store(folder_, {.create = true, .synchronous = synchronous, .page_bytes = page_bytes});
        if (opened) store = std::move(*opened);
    }
    ~BenchWorld() {
        store.reset();
        std::error_code ec;
        if (!folder_.empty()) std::filesystem::remove_all(folder_, ec);
    }
    BenchWorld(const BenchWorld&) = delete;
    BenchWorld& operator=(const BenchWorld&) = delete;
    std::unique_ptr<WorldStore> store;

private:
    std::string folder_;
};

// Each round is a new part of the world, so that nothing is only overwritten.
bool put_chunks(WorldStore& store, i32 round, std::size_t from, std::size_t count) {
    WriteBatch batch;
    for (std::size_t i = from; i < from + count; ++i) {
        const Encoded& e = samples()[i % samples().size()];
        Bytes key = keys::chunk(DimensionId(0), {e.at.x + round * 8, e.at.y, e.at.z});
        Bytes record = seal_record(Table::chunk, key, 1, e.payload);
        batch.put(Table::chunk, std::move(key), std::move(record));
    }
    return bool(store.commit(batch));
}

void bench_puts(bench::Context& c, const char* synchronous, std::size_t batch, std::size_t rounds,
                u32 page_bytes = 8192) {
    BenchWorld world(synchronous, page_bytes);
    if (!world.store) return c.skip("no folder for temporary files");
    i32 round = 0;
    bool good = true;
    c.measure(double(batch * rounds), [&] {
        for (std::size_t i = 0; i < rounds; ++i)
            good = put_chunks(*world.store, round, i * batch, batch) && good;
        ++round;
    });
    if (!good) c.skip("a commit failed");
}

void bench_gets(bench::Context& c, bool decode) {
    BenchWorld world("OFF");
    if (!world.store) return c.skip("no folder for temporary files");
    constexpr i32 rounds = 32;
    for (i32 r = 0; r < rounds; ++r)
        put_chunks(*world.store, r, 0, samples().size());
    std::vector<Bytes> wanted;
    for (i32 r = 0; r < rounds; ++r)
        for (const Encoded& e : samples())
            wanted.push_back(keys::chunk(DimensionId(0), {e.at.x + r * 8, e.at.y, e.at.z}));
    Rng rng(1);
    for (std::size_t i = wanted.size(); i > 1; --i)
        std::swap(wanted[i - 1], wanted[rng.below(u32(i))]);
    wanted.resize(8192);
    bool good = true;
    c.measure(double(wanted.size()), [&] {
        for (const Bytes& key : wanted) {
            const auto record = world.store->get(Table::chunk, key);
            const auto view =
                record && *record ? open_record(Table::chunk, key, 1, **record) : fail(ErrorCode::not_found, "");
            good = good && view;
            if (view && decode) good = good && decode_chunk(view->payload);
        }
    });
    if (!good) c.skip("a chunk was not found");
}

void bench_columns(bench::Context& c) {
    BenchWorld world("OFF");
    if (!world.store) return c.skip("no folder for temporary files");
    constexpr i32 rounds = 32;
    for (i32 r = 0; r < rounds; ++r)
        put_chunks(*world.store, r, 0, samples().size());
    c.measure(256, [&] {
        for (i32 i = 0; i < 256; ++i) {
            const Bytes from = keys::column(DimensionId(0), {i, i * 5 % 8});
            (void)world.store->scan(Table::chunk, from, keys::after(from), [&](ByteView key, ByteView record) {
                if (const auto view = open_record(Table::chunk, key, 1, record))
                    bench::keep(decode_chunk(view->payload));
                return true;
            });
        }
    });
}

} // namespace

void register_store_benches(bench::Suite& suite) {
    suite.add("store.put1", "/s", "one encoded chunk a commit, synced to disk (FULL)",
              [](bench::Context& c) { bench_puts(c, "FULL", 1, 64); });
    suite.add("store.put64", "/s", "64 encoded chunks a commit, synced to disk (FULL)",
              [](bench::Context& c) { bench_puts(c, "FULL", 64, 16); });
    suite.add("store.put64.normal", "/s", "the same without a sync a commit (NORMAL), for comparison",
              [](bench::Context& c) { bench_puts(c, "NORMAL", 64, 16); });
    suite.add("store.get", "/s", "an encoded chunk at random, checksum proven",
              [](bench::Context& c) { bench_gets(c, false); });
    suite.add("store.load", "/s", "the same and decoded", [](bench::Context& c) { bench_gets(c, true); });
    suite.add("store.column", "us", "16 chunks of a column by one scan, decoded", bench_columns);
}
