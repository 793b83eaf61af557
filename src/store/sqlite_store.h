// The embedded WorldStore: one SQLite file (world.sqlite) in the world's folder, write-ahead log, one table a Table.
#pragma once

#include "store/world_store.h"

#include <memory>
#include <vector>

struct sqlite3;

namespace vitrail {

// A step of the store's layout, run inside the transaction that also notes the new format. (What is inside a record
// changes by the record's own version byte instead, on the next write of it.)
struct StoreMigration {
    u32 to = 1; // the format it makes, from to - 1
    Result<> (*run)(::sqlite3* db) = nullptr;
};
// In order, from 1 (which makes an empty store) to kStoreFormat.
const std::vector<StoreMigration>& store_migrations();

struct OpenOptions {
    bool read_only = false; // takes no lock: works beside a process that has the world open, and in a read-only folder
    bool create = false;    // make folder and world where there is none
    // Below: for tests and measurements.
    const std::vector<StoreMigration>* migrations = nullptr; // null: store_migrations()
    const char* vfs = nullptr;                               // SQLite VFS by name; null: the system's
    const char* synchronous = "FULL";                        // FULL: a commit that returned survives the loss of power
    u32 page_bytes = 8192;                                   // of a new world
    u32 checkpoint_pages = 2000;                             // log pages after which a commit also writes back
};

// Errors: not_found (no world there, create not set), invalid_argument (not a folder), busy (another process has it
// open), unsupported (made by a newer Vitrail), damaged (not a world store), io (permission, full disk).
Result<std::unique_ptr<WorldStore>> open_sqlite_store(const std::string& folder, const OpenOptions& options = {});

// True where `folder` holds a world store.
bool has_sqlite_store(const std::string& folder);

// Version of the store's layout that this program writes. Older ones are migrated when opened for writing and are read
// as they are when opened read-only.
inline constexpr u32 kStoreFormat = 1;

} // namespace vitrail
