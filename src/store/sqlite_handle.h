// Owning handles over sqlite3 and sqlite3_stmt, and the one place that turns SQLite's codes into our errors.
#pragma once

#include "base/bytes.h"
#include "base/result.h"

#include <memory>
#include <sqlite3.h>
#include <string>

namespace vitrail::sqlite {

struct CloseDb {
    void operator()(::sqlite3* db) const { sqlite3_close_v2(db); }
};
struct FinalizeStatement {
    void operator()(::sqlite3_stmt* s) const { sqlite3_finalize(s); }
};
using Db = std::unique_ptr<::sqlite3, CloseDb>;
using Statement = std::unique_ptr<::sqlite3_stmt, FinalizeStatement>;

// `code` is an SQLite result other than OK; `where` names the world's folder, `doing` what failed.
tl::unexpected<Error> error(::sqlite3* db, int code, const std::string& where, const char* doing);

// flags: SQLITE_OPEN_...; `path` is a file name or, with SQLITE_OPEN_URI, a URI.
Result<Db> open(const std::string& path, int flags, const char* vfs, const std::string& where);
Result<> run(::sqlite3* db, const std::string& sql, const std::string& where, const char* doing);
Result<Statement> prepare(::sqlite3* db, const std::string& sql, const std::string& where);
// First column of the first row as text; empty where there is none.
Result<std::string> text_of(::sqlite3* db, const std::string& sql, const std::string& where);

// A blob parameter that must outlive the step. SQLite takes a null pointer for NULL, so empty ones get another.
inline int bind(::sqlite3_stmt* s, int at, ByteView bytes) {
    static const u8 nothing = 0;
    return sqlite3_bind_blob64(s, at, bytes.empty() ? &nothing : bytes.data(), bytes.size(), SQLITE_STATIC);
}
inline ByteView blob(::sqlite3_stmt* s, int column) {
    const void* data = sqlite3_column_blob(s, column);
    return {static_cast<const u8*>(data), data ? std::size_t(sqlite3_column_bytes(s, column)) : 0};
}

// Undoes an open transaction at the end of scope unless told it was committed.
class Transaction {
public:
    explicit Transaction(::sqlite3* db)
        : db_(db) {}
    ~Transaction() {
        if (db_ && !sqlite3_get_autocommit(db_)) sqlite3_exec(db_, "ROLLBACK", nullptr, nullptr, nullptr);
    }
    Transaction(const Transaction&) = delete;
    Transaction& operator=(const Transaction&) = delete;
    void done() { db_ = nullptr; }

private:
    ::sqlite3* db_;
};

} // namespace vitrail::sqlite
