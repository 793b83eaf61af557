#include "store/sqlite_handle.h"

#include <fmt/format.h>

namespace vitrail::sqlite {

tl::unexpected<Error> error(::sqlite3* db, int code, const std::string& where, const char* doing) {
    ErrorCode kind = ErrorCode::io;
    const char* words = db ? sqlite3_errmsg(db) : sqlite3_errstr(code);
    switch (code & 0xff) {
    case SQLITE_FULL:
        words = "the disk is full";
        break;
    case SQLITE_BUSY:
    case SQLITE_LOCKED:
        kind = ErrorCode::busy;
        break;
    case SQLITE_CORRUPT:
    case SQLITE_NOTADB:
        kind = ErrorCode::damaged;
        break;
    case SQLITE_READONLY:
        words = "read-only folder or file";
        break;
    case SQLITE_TOOBIG:
        kind = ErrorCode::limit;
        break;
    default:
        break;
    }
    return fail(kind, fmt::format("world {}: cannot {}: {}", where, doing, words));
}

Result<Db> open(const std::string& path, int flags, const char* vfs, const std::string& where) {
    ::sqlite3* raw = nullptr;
    const int code = sqlite3_open_v2(path.c_str(), &raw, flags | SQLITE_OPEN_NOMUTEX, vfs);
    Db db(raw);
    if (code != SQLITE_OK) return error(raw, code, where, "open its store");
    sqlite3_extended_result_codes(raw, 1);
    sqlite3_busy_timeout(raw, 5000);
    return db;
}

Result<> run(::sqlite3* db, const std::string& sql, const std::string& where, const char* doing) {
    const int code = sqlite3_exec(db, sql.c_str(), nullptr, nullptr, nullptr);
    if (code != SQLITE_OK) return error(db, code, where, doing);
    return {};
}

Result<Statement> prepare(::sqlite3* db, const std::string& sql, const std::string& where) {
    ::sqlite3_stmt* raw = nullptr;
    const int code = sqlite3_prepare_v3(db, sql.c_str(), -1, SQLITE_PREPARE_PERSISTENT, &raw, nullptr);
    if (code != SQLITE_OK) return error(db, code, where, "read its store");
    return Statement(raw);
}

Result<std::string> text_of(::sqlite3* db, const std::string& sql, const std::string& where) {
    VX_TRY_ASSIGN(Statement statement, prepare(db, sql, where));
    const int code = sqlite3_step(statement.get());
    if (code == SQLITE_DONE) return std::string();
    if (code != SQLITE_ROW) return error(db, code, where, "read its store");
    const auto* words = reinterpret_cast<const char*>(sqlite3_column_text(statement.get(), 0));
    return std::string(words ? words : "");
}

} // namespace vitrail::sqlite
