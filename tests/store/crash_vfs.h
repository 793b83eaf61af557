// CrashVfs: an SQLite VFS over the system's that remembers what was synced. `crash_image` gives the files as a power
// cut would leave them: what was synced is there; of what was written since, any sectors may be there, torn, or
// missing, in any order. It can also refuse to grow beyond a budget, as a full disk does.
//
//     CrashVfs& vfs = CrashVfs::instance();
//     vfs.reset();
//     vfs.crash_after(37);                       // the 38th write and all later calls fail: the process is dead
//     ... use a store opened with {.vfs = CrashVfs::kName} ...
//     vfs.crash_image(other_folder, rng);        // and open that one by the real VFS
#pragma once

#include "base/bytes.h"
#include "base/rng.h"

#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace vitrail::testing {

class CrashVfs {
public:
    static constexpr const char* kName = "vitrail-crash";
    static CrashVfs& instance(); // registered with SQLite on first use

    void reset(); // forgets all files and limits; no store may be open
    void crash_after(u64 writes);
    bool crashed() const;
    u64 writes() const;
    // Bytes that all files together may have; writes and growth beyond it give SQLITE_FULL.
    void set_budget(u64 bytes);
    u64 refused() const; // writes refused by the budget
    // Writes the files, by their names, into `folder`.
    void crash_image(const std::string& folder, Rng& rng) const;

    // For the VFS's own functions.
    struct Op {
        u64 offset = 0;
        Bytes data;            // a write
        bool truncate = false; // or a truncation to `offset`
    };
    struct File {
        Bytes durable;
        std::vector<Op> pending;
        u64 size = 0; // with what is pending
    };
    std::shared_ptr<File> track(const std::string& path);
    void forget(const std::string& path);
    bool may_write(File& file, u64 end, int& error); // counts a write
    void wrote(File& file, Op op);
    void synced(File& file);

private:
    mutable std::mutex mutex_;
    std::map<std::string, std::shared_ptr<File>> files_;
    u64 writes_ = 0, crash_at_ = ~u64(0), budget_ = ~u64(0), refused_ = 0;
    bool crashed_ = false;
};

} // namespace vitrail::testing
