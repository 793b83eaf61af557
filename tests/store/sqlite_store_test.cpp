#include "store/sqlite_store.h"

#include "store/maintenance.h"
#include "tests/store/temp_folder.h"
#include "tests/store/world_fixture.h"

#include <fstream>
#include <gtest/gtest.h>
#include <sqlite3.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <thread>

namespace vitrail {

using namespace vitrail::testing;
namespace fs = std::filesystem;

static std::unique_ptr<WorldStore> open_store(const std::string& folder, OpenOptions options = {.create = true}) {
    auto store = open_sqlite_store(folder, options);
    EXPECT_TRUE(store) << store.error().message;
    return store ? std::move(*store) : nullptr;
}

TEST(SqliteStore, PutsGetsScansErasesInKeyOrder) {
    TempFolder folder;
    auto store = open_store(folder.path());
    std::map<Bytes, Bytes> model;
    Rng rng(2);
    for (int round = 0; round < 30; ++round) {
        WriteBatch batch;
        for (int i = 0; i < 20; ++i) {
            Bytes key(rng.below(4));
            for (u8& b : key)
                b = u8(rng.below(4) * 85);
            if (rng.below(3) == 0) {
                model.erase(key);
                batch.erase(Table::script, key);
            } else {
                Bytes value(rng.below(3) ? rng.below(60) : rng.below(30000), u8(i));
                model[key] = value;
                batch.put(Table::script, key, value);
            }
        }
        ASSERT_TRUE(store->commit(batch));
        const Bytes from(rng.below(2), u8(85)), to(rng.below(2), u8(170));
        auto expected = model.lower_bound(from);
        ASSERT_TRUE(store->scan(Table::script, from, to, [&](ByteView key, ByteView value) {
            EXPECT_NE(expected, model.end());
            EXPECT_TRUE(std::equal(key.begin(), key.end(), expected->first.begin(), expected->first.end()));
            EXPECT_TRUE(std::equal(value.begin(), value.end(), expected->second.begin(), expected->second.end()));
            return ++expected, true;
        }));
        EXPECT_TRUE(expected == model.end() || (!to.empty() && expected->first >= to));
    }
    for (const auto& [key, value] : model)
        EXPECT_EQ(**store->get(Table::script, key), value);
    EXPECT_FALSE(*store->get(Table::player, Bytes{1}));
    EXPECT_TRUE(store->check());
}

TEST(SqliteStore, SecondOpeningIsBusyInThisProcessAndInAnother) {
    TempFolder folder;
    auto store = open_store(folder.path());
    const auto second = open_sqlite_store(folder.path());
    ASSERT_FALSE(second);
    EXPECT_EQ(second.error().code, ErrorCode::busy);
    EXPECT_NE(second.error().message.find(folder.path()), std::string::npos);
    const pid_t child = ::fork();
    if (child == 0) {
        const auto third = open_sqlite_store(folder.path());
        const bool reads = bool(open_sqlite_store(folder.path(), {.read_only = true}));
        ::_exit(!third && third.error().code == ErrorCode::busy && reads ? 0 : 1);
    }
    int status = 1;
    ::waitpid(child, &status, 0);
    EXPECT_EQ(status, 0);
    store.reset();
    EXPECT_TRUE(open_sqlite_store(folder.path()));
}

TEST(SqliteStore, AbsentAndWrongPlacesAreClearErrors) {
    TempFolder folder;
    EXPECT_EQ(open_sqlite_store(folder.path()).error().code, ErrorCode::not_found);
    EXPECT_EQ(open_sqlite_store(folder / "nothing", {.read_only = true}).error().code, ErrorCode::not_found);
    EXPECT_FALSE(fs::exists(folder / "nothing"));
    EXPECT_FALSE(fs::exists(folder / "lock")) << "nothing is written where there is no world";
    std::ofstream(folder / "file") << "hello";
    EXPECT_EQ(open_sqlite_store(folder / "file", {.create = true}).error().code, ErrorCode::invalid_argument);
    EXPECT_EQ(open_sqlite_store(folder / "file/inside", {.create = true}).error().code, ErrorCode::io);
    fs::create_directory(folder / "odd");
    fs::create_directory(folder / "odd/world.sqlite");
    EXPECT_EQ(open_sqlite_store(folder / "odd").error().code, ErrorCode::invalid_argument);
    fs::create_directory(folder / "text");
    std::ofstream(folder / "text/world.sqlite") << std::string(5000, 'x');
    const auto text = open_sqlite_store(folder / "text");
    EXPECT_EQ(text.error().code, ErrorCode::damaged) << text.error().message;
    fs::create_directory(folder / "other");
    sqlite3* db = nullptr;
    sqlite3_open((folder / "other/world.sqlite").c_str(), &db);
    sqlite3_exec(db, "CREATE TABLE shopping(item)", nullptr, nullptr, nullptr);
    sqlite3_close(db);
    EXPECT_EQ(open_sqlite_store(folder / "other").error().code, ErrorCode::damaged) << "somebody else's database";
    for (const auto& bad : {text.error().message})
        EXPECT_EQ(bad.find('\n'), std::string::npos);
}

TEST(SqliteStore, ReadOnlyOpeningWritesNothing) {
    TempFolder folder;
    WriteBatch batch;
    batch.put(Table::script, {1}, {2});
    ASSERT_TRUE(open_store(folder.path())->commit(batch));
    auto store = open_store(folder.path(), {.read_only = true});
    EXPECT_EQ(**store->get(Table::script, Bytes{1}), Bytes{2});
    EXPECT_EQ(store->commit(batch).error().code, ErrorCode::denied);
    EXPECT_TRUE(store->read_only());
}

// A folder that nobody may write, even root: the immutable flag where the file system has it, else the mode for other
// users.
TEST(SqliteStore, ReadOnlyFolderIsReadAndRefusedForWriting) {
    TempFolder folder;
    WriteBatch batch;
    batch.put(Table::script, {1}, {2});
    ASSERT_TRUE(open_store(folder.path())->commit(batch));
    fs::remove(folder / "lock");
    const auto lock = [&](bool on) {
        if (::geteuid() == 0) {
            const std::string flags = on ? "+i " : "-i ";
            return std::system(("chattr " + flags + folder.path() + " 2>/dev/null").c_str()) == 0;
        }
        return ::chmod(folder.path().c_str(), on ? 0555 : 0755) == 0;
    };
    if (!lock(true)) GTEST_SKIP() << "this file system has no immutable flag and root may write anywhere";
    const auto writing = open_sqlite_store(folder.path());
    auto reading = open_sqlite_store(folder.path(), {.read_only = true});
    const auto value = reading ? (*reading)->get(Table::script, Bytes{1}) : Result<std::optional<Bytes>>();
    lock(false);
    ASSERT_FALSE(writing);
    EXPECT_EQ(writing.error().code, ErrorCode::io) << writing.error().message;
    ASSERT_TRUE(reading) << reading.error().message;
    ASSERT_TRUE(value) << value.error().message;
    EXPECT_EQ(**value, Bytes{2});
}

// The layouts of two imaginary versions: the first kept its scripts elsewhere.
static Result<> make_first(::sqlite3* db) {
    for (const auto& m : store_migrations())
        VX_TRY(m.run(db));
    sqlite3_exec(db, "CREATE TABLE old_script(name TEXT, text TEXT); INSERT INTO old_script VALUES('a','1'),('b','2')",
                 nullptr, nullptr, nullptr);
    return {};
}
static Result<> first_to_second(::sqlite3* db) {
    if (sqlite3_exec(
            db,
            "INSERT INTO script SELECT CAST(name AS BLOB),CAST(text AS BLOB) FROM old_script; DROP TABLE old_script",
            nullptr, nullptr, nullptr) != SQLITE_OK)
        return fail(ErrorCode::damaged, sqlite3_errmsg(db));
    return {};
}
static Result<> first_to_second_fails(::sqlite3* db) {
    VX_TRY(first_to_second(db));
    return fail(ErrorCode::io, "no luck");
}

TEST(SqliteStore, OldWorldIsMigratedInOneTransaction) {
    TempFolder folder;
    const std::vector<StoreMigration> v1{{1, make_first}}, v2{{1, make_first}, {2, first_to_second}},
        unlucky{{1, make_first}, {2, first_to_second_fails}};
    open_store(folder.path(), {.create = true, .migrations = &v1});
    EXPECT_FALSE(open_sqlite_store(folder.path(), {.migrations = &unlucky}));
    EXPECT_TRUE(open_store(folder.path(), {.migrations = &v1})) << "a failed migration changes nothing";
    {
        auto store = open_store(folder.path(), {.migrations = &v2});
        EXPECT_EQ(**store->get(Table::script, Bytes{'b'}), Bytes{'2'});
    }
    EXPECT_TRUE(open_store(folder.path(), {.migrations = &v2})) << "and it is done once";
    const auto old = open_sqlite_store(folder.path());
    ASSERT_FALSE(old);
    EXPECT_EQ(old.error().code, ErrorCode::unsupported);
    EXPECT_NE(old.error().message.find("newer Vitrail"), std::string::npos);
    EXPECT_EQ(open_sqlite_store(folder.path(), {.read_only = true}).error().code, ErrorCode::unsupported);
}

TEST(SqliteStore, EmptyFileOfAnInterruptedCreationBecomesAWorld) {
    TempFolder folder;
    std::ofstream(folder / "world.sqlite").flush();
    EXPECT_EQ(open_sqlite_store(folder.path(), {.read_only = true}).error().code, ErrorCode::not_found);
    EXPECT_TRUE(open_sqlite_store(folder.path()));
    EXPECT_TRUE(open_sqlite_store(folder.path(), {.read_only = true}));
}

TEST(SqliteStore, FoldersMayHaveAnyName) {
    TempFolder folder;
    for (const char* name : {"a b", "q?x=1", "50%20", "#1", "ümlaut", "it's"}) {
        auto store = open_store(folder / name);
        ASSERT_TRUE(store) << name;
        EXPECT_TRUE(fs::exists((folder / name) + "/world.sqlite")) << name;
    }
}

TEST(SqliteStore, ReadersAndAWriterDoNotDisturbEachOther) {
    TempFolder folder;
    auto store = open_store(folder.path(), {.create = true, .synchronous = "OFF"});
    std::atomic<bool> stop{false};
    std::atomic<u64> seen{0};
    std::vector<std::thread> readers;
    for (int i = 0; i < 3; ++i)
        readers.emplace_back([&] {
            while (!stop) {
                // Both records are of one transaction: one scan sees both or the pair before.
                std::vector<Bytes> values;
                const auto scanned = store->scan(Table::script, {}, {}, [&](ByteView, ByteView v) {
                    values.emplace_back(v.begin(), v.end());
                    return true;
                });
                ASSERT_TRUE(scanned) << scanned.error().message;
                if (values.size() != 2) continue;
                ASSERT_EQ(values[0], values[1]);
                ++seen;
            }
        });
    for (u32 n = 0; n < 300 || seen < 10; ++n) {
        WriteBatch batch;
        for (u8 key : {1, 200})
            batch.put(Table::script, {key}, Bytes(100, u8(n)));
        ASSERT_TRUE(store->commit(batch));
    }
    stop = true;
    for (auto& r : readers)
        r.join();
}

} // namespace vitrail
