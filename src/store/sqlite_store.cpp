#include "store/sqlite_store.h"

#include "store/folder_lock.h"
#include "store/sqlite_handle.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <charconv>
#include <filesystem>
#include <fmt/format.h>
#include <mutex>

namespace vitrail {

namespace fs = std::filesystem;

static constexpr std::size_t kTables = std::size_t(Table::count);
// Marks the file as ours ("VITR"), in SQLite's header field for that purpose.
static constexpr int kApplicationId = 0x56495452;
static constexpr const char* kFile = "world.sqlite";

const char* table_name(Table table) {
    static constexpr const char* names[kTables] = {"meta",   "dimension", "state",  "biome",  "chunk",
                                                   "column", "entity",    "player", "script", "quarantine"};
    return names[std::size_t(table)];
}

// "column" is a word of SQL.
static std::string sql_name(Table table) {
    return fmt::format("\"{}\"", table_name(table));
}

static Result<> make_tables(::sqlite3* db) {
    for (std::size_t t = 0; t < kTables; ++t)
        VX_TRY(sqlite::run(
            db,
            fmt::format("CREATE TABLE {}(key BLOB PRIMARY KEY, value BLOB NOT NULL) WITHOUT ROWID", sql_name(Table(t))),
            "new", "make tables"));
    return {};
}

const std::vector<StoreMigration>& store_migrations() {
    static const std::vector<StoreMigration> list = {{1, make_tables}};
    return list;
}

namespace {

// One connection with its prepared statements; used by one thread at a time.
struct Connection {
    sqlite::Db db;
    std::array<sqlite::Statement, kTables> get, put, erase, scan, scan_to_end;
    // A snapshot kept open from one read to the next, and the count of commits it was opened at.
    bool in_snapshot = false;
    u64 snapshot_commits = 0;
};

class SqliteStore final : public WorldStore {
public:
    Result<> open(const std::string& folder, const OpenOptions& options);
    Result<std::optional<Bytes>> get(Table table, ByteView key) override;
    Result<> scan(Table table, ByteView from, ByteView to, const ScanCallback& callback) override;
    Result<> commit(const WriteBatch& batch) override;
    Result<> backup(const std::string& target) override;
    Result<> check() override;
    bool read_only() const override { return options_.read_only; }
    u64 size_bytes() const override;
    const std::string& location() const override { return folder_; }
    ~SqliteStore() override;

private:
    // A reader out of the pool, given back at the end of scope.
    struct Borrowed {
        SqliteStore& store;
        std::unique_ptr<Connection> connection;
        ~Borrowed() {
            std::lock_guard lock(store.pool_mutex_);
            if (store.pool_.size() < 4) store.pool_.push_back(std::move(connection));
        }
    };
    Result<std::unique_ptr<Connection>> connect(bool writable) const;
    Result<std::unique_ptr<Connection>> borrow();
    Result<> refresh_snapshot(Connection& c) const;
    static void end_snapshot(Connection& c);
    tl::unexpected<Error> read_error(Connection& c, int code) const {
        auto e = sqlite::error(c.db.get(), code, folder_, "read");
        end_snapshot(c);
        return e;
    }
    Result<u32> format_of(::sqlite3* db) const;
    Result<> migrate(::sqlite3* db, u32 from) const;
    Result<::sqlite3_stmt*> statement(Connection& c, std::array<sqlite::Statement, kTables>& kind, Table table,
                                      const char* sql) const;
    Result<> write(Connection& c, const WriteBatch::Write& write);

    std::string folder_, path_;
    OpenOptions options_;
    bool immutable_ = false; // a folder that cannot hold the log's index: the file alone is read
    FolderLock lock_;
    std::mutex write_mutex_, pool_mutex_;
    std::atomic<u64> commits_{0};
    std::unique_ptr<Connection> writer_;
    std::vector<std::unique_ptr<Connection>> pool_;
};

std::string uri_of(const std::string& path, const char* query) {
    std::string out = "file:";
    for (char c : path) {
        if (c == '?' || c == '#' || c == '%')
            out += fmt::format("%{:02x}", u8(c));
        else
            out += c;
    }
    return out + query;
}

Result<std::unique_ptr<Connection>> SqliteStore::connect(bool writable) const {
    auto c = std::make_unique<Connection>();
    int flags = SQLITE_OPEN_URI | (options_.read_only ? SQLITE_OPEN_READONLY : SQLITE_OPEN_READWRITE);
    if (writable && options_.create) flags |= SQLITE_OPEN_CREATE;
    const std::string uri = uri_of(path_, immutable_ ? "?immutable=1" : "");
    VX_TRY_ASSIGN(c->db, sqlite::open(uri, flags, options_.vfs, folder_));
    // A map saves a copy a read; the cache is for the writer, whose pages change.
    VX_TRY(sqlite::run(c->db.get(),
                       fmt::format("PRAGMA mmap_size={}; PRAGMA cache_size=-{}; PRAGMA trusted_schema=0",
                                   options_.vfs ? 0 : u64(1) << 40, writable ? 16384 : 4096),
                       folder_, "set up its store"));
    return c;
}

Result<u32> SqliteStore::format_of(::sqlite3* db) const {
    VX_TRY_ASSIGN(const std::string id, sqlite::text_of(db, "PRAGMA application_id", folder_));
    VX_TRY_ASSIGN(const std::string text, sqlite::text_of(db, "PRAGMA user_version", folder_));
    i64 format = 0;
    std::from_chars(text.data(), text.data() + text.size(), format);
    if (id != fmt::format("{}", kApplicationId)) {
        if (id == "0" && format == 0) {
            VX_TRY_ASSIGN(const std::string tables, sqlite::text_of(db, "SELECT count(*) FROM sqlite_schema", folder_));
            if (tables == "0") return 0u; // a creation that was interrupted, or a new file
        }
        return fail(ErrorCode::damaged, fmt::format("world {}: {} is not a store of Vitrail", folder_, kFile));
    }
    const u32 newest = options_.migrations ? options_.migrations->back().to : kStoreFormat;
    if (format < 0 || format > i64(newest))
        return fail(ErrorCode::unsupported,
                    fmt::format("world {} was made by a newer Vitrail (store format {}, this one knows {})", folder_,
                                format, newest));
    return u32(format);
}

Result<> SqliteStore::migrate(::sqlite3* db, u32 from) const {
    const auto& list = options_.migrations ? *options_.migrations : store_migrations();
    if (from >= list.back().to) return {};
    VX_TRY(sqlite::run(db, "BEGIN IMMEDIATE", folder_, "start its migration"));
    sqlite::Transaction transaction(db);
    for (const StoreMigration& step : list) {
        if (step.to <= from) continue;
        VX_TRY(step.run(db));
    }
    VX_TRY(sqlite::run(
        db, fmt::format("PRAGMA application_id={}; PRAGMA user_version={}; COMMIT", kApplicationId, list.back().to),
        folder_, "finish its migration"));
    transaction.done();
    return {};
}

Result<> SqliteStore::open(const std::string& folder, const OpenOptions& options) {
    folder_ = folder;
    options_ = options;
    path_ = folder + "/" + kFile;
    std::error_code ec;
    const auto status = fs::status(folder, ec);
    if (fs::exists(status) && !fs::is_directory(status))
        return fail(ErrorCode::invalid_argument, fmt::format("world {} is not a folder", folder));
    const bool there = fs::exists(path_, ec);
    if (!there && (options.read_only || !options.create))
        return fail(ErrorCode::not_found, fmt::format("no world in {}", folder));
    if (there && !fs::is_regular_file(path_, ec))
        return fail(ErrorCode::invalid_argument, fmt::format("world {}: {} is not a file", folder, kFile));
    if (!options.read_only) {
        fs::create_directories(folder, ec);
        if (ec) return fail(ErrorCode::io, fmt::format("world {}: cannot make the folder: {}", folder, ec.message()));
        VX_TRY_ASSIGN(lock_, FolderLock::take(folder));
    }
    auto look = [&]() -> Result<u32> {
        VX_TRY_ASSIGN(writer_, connect(true));
        return format_of(writer_->db.get());
    };
    auto format = look();
    if (!format && options.read_only && format.error().code == ErrorCode::io) {
        // No write access for the log's index. Without a log the file alone is the whole world.
        const auto log = fs::file_size(path_ + "-wal", ec);
        if (ec || log == 0) {
            immutable_ = true;
            format = look();
        }
    }
    if (!format) return tl::unexpected(format.error());
    if (options.read_only) {
        if (*format == 0) return fail(ErrorCode::not_found, fmt::format("no world in {}", folder));
        return {};
    }
    ::sqlite3* db = writer_->db.get();
    if (*format == 0) // only before the first table
        VX_TRY(sqlite::run(db, fmt::format("PRAGMA page_size={}", options.page_bytes), folder, "set up its store"));
    VX_TRY_ASSIGN(const std::string mode, sqlite::text_of(db, "PRAGMA journal_mode=WAL", folder));
    if (mode != "wal")
        return fail(ErrorCode::io, fmt::format("world {}: its store refuses the write-ahead log", folder));
    VX_TRY(sqlite::run(db,
                       fmt::format("PRAGMA synchronous={}; PRAGMA wal_autocheckpoint={}; PRAGMA journal_size_limit={}",
                                   options.synchronous, options.checkpoint_pages, 64 << 20),
                       folder, "set up its store"));
    return migrate(db, *format);
}

SqliteStore::~SqliteStore() {
    pool_.clear();
    writer_.reset(); // the last connection writes the log back; the lock goes after it
}

Result<std::unique_ptr<Connection>> SqliteStore::borrow() {
    {
        std::unique_lock lock(pool_mutex_);
        if (!pool_.empty()) {
            auto c = std::move(pool_.back());
            pool_.pop_back();
            lock.unlock();
            VX_TRY(refresh_snapshot(*c));
            return c;
        }
    }
    VX_TRY_ASSIGN(auto c, connect(false));
    VX_TRY(refresh_snapshot(*c));
    return c;
}

// Opening a snapshot costs as much as a read itself (locks of the operating system), so it lives until the next commit.
// Only where we hold the world's lock: else others commit, and we would not know.
Result<> SqliteStore::refresh_snapshot(Connection& c) const {
    if (options_.read_only) return {};
    const u64 commits = commits_.load(std::memory_order_acquire);
    if (c.in_snapshot && c.snapshot_commits == commits) return {};
    end_snapshot(c);
    VX_TRY(sqlite::run(c.db.get(), "BEGIN", folder_, "read"));
    c.in_snapshot = true;
    c.snapshot_commits = commits;
    return {};
}

void SqliteStore::end_snapshot(Connection& c) {
    if (c.in_snapshot) sqlite3_exec(c.db.get(), "ROLLBACK", nullptr, nullptr, nullptr);
    c.in_snapshot = false;
}

Result<::sqlite3_stmt*> SqliteStore::statement(Connection& c, std::array<sqlite::Statement, kTables>& kind, Table table,
                                               const char* sql) const {
    sqlite::Statement& s = kind[std::size_t(table)];
    if (!s) {
        VX_TRY_ASSIGN(s, sqlite::prepare(c.db.get(), fmt::format(fmt::runtime(sql), sql_name(table)), folder_));
    }
    return s.get();
}

Result<std::optional<Bytes>> SqliteStore::get(Table table, ByteView key) {
    VX_TRY_ASSIGN(auto connection, borrow());
    Borrowed b{*this, std::move(connection)};
    Connection& c = *b.connection;
    VX_TRY_ASSIGN(auto* s, statement(c, c.get, table, "SELECT value FROM {} WHERE key=?1"));
    sqlite::bind(s, 1, key);
    const int code = sqlite3_step(s);
    std::optional<Bytes> out;
    if (code == SQLITE_ROW) {
        const ByteView value = sqlite::blob(s, 0);
        out.emplace(value.begin(), value.end());
    }
    sqlite3_reset(s);
    if (code != SQLITE_ROW && code != SQLITE_DONE) return read_error(c, code);
    return out;
}

Result<> SqliteStore::scan(Table table, ByteView from, ByteView to, const ScanCallback& callback) {
    VX_TRY_ASSIGN(auto connection, borrow());
    Borrowed b{*this, std::move(connection)};
    Connection& c = *b.connection;
    ::sqlite3_stmt* s = nullptr;
    if (to.empty()) {
        VX_TRY_ASSIGN(s, statement(c, c.scan_to_end, table, "SELECT key,value FROM {} WHERE key>=?1 ORDER BY key"));
    } else {
        VX_TRY_ASSIGN(s, statement(c, c.scan, table, "SELECT key,value FROM {} WHERE key>=?1 AND key<?2 ORDER BY key"));
        sqlite::bind(s, 2, to);
    }
    sqlite::bind(s, 1, from);
    int code;
    while ((code = sqlite3_step(s)) == SQLITE_ROW)
        if (!callback(sqlite::blob(s, 0), sqlite::blob(s, 1))) break;
    sqlite3_reset(s);
    if (code != SQLITE_ROW && code != SQLITE_DONE) return read_error(c, code);
    return {};
}

Result<> SqliteStore::write(Connection& c, const WriteBatch::Write& write) {
    ::sqlite3_stmt* s = nullptr;
    if (write.value) {
        VX_TRY_ASSIGN(s, statement(c, c.put, write.table, "INSERT OR REPLACE INTO {} VALUES(?1,?2)"));
        sqlite::bind(s, 2, *write.value);
    } else {
        VX_TRY_ASSIGN(s, statement(c, c.erase, write.table, "DELETE FROM {} WHERE key=?1"));
    }
    sqlite::bind(s, 1, write.key);
    const int code = sqlite3_step(s);
    sqlite3_reset(s);
    if (code != SQLITE_DONE) return sqlite::error(c.db.get(), code, folder_, "save");
    return {};
}

Result<> SqliteStore::commit(const WriteBatch& batch) {
    if (options_.read_only) return fail(ErrorCode::denied, fmt::format("world {} is open for reading only", folder_));
    std::lock_guard lock(write_mutex_);
    {
        // Old snapshots would keep the log from being written back and begun anew.
        std::lock_guard pool_lock(pool_mutex_);
        for (auto& reader : pool_)
            end_snapshot(*reader);
    }
    Connection& c = *writer_;
    ::sqlite3* db = c.db.get();
    VX_TRY(sqlite::run(db, "BEGIN IMMEDIATE", folder_, "save"));
    sqlite::Transaction transaction(db);
    for (const auto& w : batch.writes)
        VX_TRY(write(c, w));
    VX_TRY(sqlite::run(db, "COMMIT", folder_, "save"));
    transaction.done();
    commits_.fetch_add(1, std::memory_order_release);
    return {};
}

Result<> SqliteStore::backup(const std::string& target) {
    std::error_code ec;
    const std::string file = target + "/" + kFile;
    if (fs::exists(file, ec)) return fail(ErrorCode::invalid_argument, fmt::format("{} holds a world already", target));
    const bool made = fs::create_directories(target, ec);
    if (ec) return fail(ErrorCode::io, fmt::format("cannot make {}: {}", target, ec.message()));
    VX_TRY_ASSIGN(FolderLock target_lock, FolderLock::take(target));
    const std::string part = file + ".part";
    fs::remove(part, ec);
    auto copied = [&]() -> Result<> {
        VX_TRY_ASSIGN(auto source, connect(false));
        VX_TRY_ASSIGN(sqlite::Db out,
                      sqlite::open(part, SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE, options_.vfs, target));
        // A reader's snapshot in the log mode: pages come from one moment, whatever is committed meanwhile.
        VX_TRY(sqlite::run(source->db.get(), "BEGIN; SELECT count(*) FROM sqlite_schema", folder_, "read"));
        sqlite3_backup* backup = sqlite3_backup_init(out.get(), "main", source->db.get(), "main");
        if (!backup) return sqlite::error(out.get(), sqlite3_errcode(out.get()), target, "copy");
        const int code = sqlite3_backup_step(backup, -1);
        const int finish = sqlite3_backup_finish(backup);
        if (code != SQLITE_DONE) return sqlite::error(out.get(), finish ? finish : code, target, "copy");
        return {};
    }();
    if (copied) {
        fs::rename(part, file, ec); // complete or absent under its name
        if (ec) copied = fail(ErrorCode::io, fmt::format("cannot write {}: {}", file, ec.message()));
    }
    if (!copied) {
        std::error_code ignored;
        fs::remove(part, ignored);
        fs::remove(part + "-journal", ignored);
        if (made) fs::remove(target + "/lock", ignored), fs::remove(target, ignored);
    }
    return copied;
}

Result<> SqliteStore::check() {
    VX_TRY_ASSIGN(auto c, connect(false));
    VX_TRY_ASSIGN(sqlite::Statement s, sqlite::prepare(c->db.get(), "PRAGMA integrity_check(20)", folder_));
    std::string findings;
    int code;
    while ((code = sqlite3_step(s.get())) == SQLITE_ROW) {
        const auto* row = reinterpret_cast<const char*>(sqlite3_column_text(s.get(), 0));
        const std::string line = row ? row : "";
        if (line == "ok") continue;
        findings += (findings.empty() ? "" : "; ") + line;
    }
    if (code != SQLITE_DONE) return sqlite::error(c->db.get(), code, folder_, "check");
    std::replace(findings.begin(), findings.end(), '\n', ' ');
    if (!findings.empty()) return fail(ErrorCode::damaged, fmt::format("world {}: {}", folder_, findings));
    return {};
}

u64 SqliteStore::size_bytes() const {
    u64 total = 0;
    for (const char* tail : {"", "-wal"}) {
        std::error_code ec;
        const auto size = fs::file_size(path_ + tail, ec);
        if (!ec) total += size;
    }
    return total;
}

} // namespace

bool has_sqlite_store(const std::string& folder) {
    std::error_code ec;
    return fs::is_regular_file(folder + "/" + kFile, ec);
}

Result<std::unique_ptr<WorldStore>> open_sqlite_store(const std::string& folder, const OpenOptions& options) {
    auto store = std::make_unique<SqliteStore>();
    VX_TRY(store->open(folder, options));
    return std::unique_ptr<WorldStore>(std::move(store));
}

} // namespace vitrail
