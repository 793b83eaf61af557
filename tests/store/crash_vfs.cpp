#include "tests/store/crash_vfs.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <new>
#include <sqlite3.h>

namespace vitrail::testing {

namespace {

sqlite3_vfs* real_vfs = nullptr;

// The real file's own struct follows in the same block.
struct ShimFile {
    sqlite3_file base;
    std::shared_ptr<CrashVfs::File>* tracked; // null: a temporary file
    sqlite3_file* real() { return reinterpret_cast<sqlite3_file*>(this + 1); }
};

ShimFile* shim(sqlite3_file* f) {
    return reinterpret_cast<ShimFile*>(f);
}
CrashVfs& vfs() {
    return CrashVfs::instance();
}

int shim_close(sqlite3_file* f) {
    delete shim(f)->tracked;
    sqlite3_file* real = shim(f)->real();
    return real->pMethods ? real->pMethods->xClose(real) : SQLITE_OK;
}
int shim_read(sqlite3_file* f, void* to, int size, sqlite3_int64 at) {
    if (vfs().crashed()) return SQLITE_IOERR_READ;
    return shim(f)->real()->pMethods->xRead(shim(f)->real(), to, size, at);
}
int shim_write(sqlite3_file* f, const void* from, int size, sqlite3_int64 at) {
    ShimFile* s = shim(f);
    if (s->tracked) {
        int error = SQLITE_OK;
        if (!vfs().may_write(**s->tracked, u64(at) + u64(size), error)) return error;
    }
    const int code = s->real()->pMethods->xWrite(s->real(), from, size, at);
    if (code == SQLITE_OK && s->tracked) {
        const u8* bytes = static_cast<const u8*>(from);
        vfs().wrote(**s->tracked, {u64(at), Bytes(bytes, bytes + size), false});
    }
    return code;
}
int shim_truncate(sqlite3_file* f, sqlite3_int64 size) {
    ShimFile* s = shim(f);
    if (vfs().crashed()) return SQLITE_IOERR_TRUNCATE;
    const int code = s->real()->pMethods->xTruncate(s->real(), size);
    if (code == SQLITE_OK && s->tracked) vfs().wrote(**s->tracked, {u64(size), {}, true});
    return code;
}
int shim_sync(sqlite3_file* f, int) {
    // Nothing waits for the real disk: only the order of writes and syncs is under test.
    if (vfs().crashed()) return SQLITE_IOERR_FSYNC;
    if (shim(f)->tracked) vfs().synced(**shim(f)->tracked);
    return SQLITE_OK;
}
int shim_size(sqlite3_file* f, sqlite3_int64* size) {
    return shim(f)->real()->pMethods->xFileSize(shim(f)->real(), size);
}
int shim_lock(sqlite3_file* f, int level) {
    return shim(f)->real()->pMethods->xLock(shim(f)->real(), level);
}
int shim_unlock(sqlite3_file* f, int level) {
    return shim(f)->real()->pMethods->xUnlock(shim(f)->real(), level);
}
int shim_reserved(sqlite3_file* f, int* out) {
    return shim(f)->real()->pMethods->xCheckReservedLock(shim(f)->real(), out);
}
int shim_control(sqlite3_file* f, int op, void* arg) {
    // A size hint would grow the file behind our back.
    if (op == SQLITE_FCNTL_SIZE_HINT || op == SQLITE_FCNTL_CHUNK_SIZE) return SQLITE_NOTFOUND;
    return shim(f)->real()->pMethods->xFileControl(shim(f)->real(), op, arg);
}
int shim_sector(sqlite3_file*) {
    return 512;
}
int shim_device(sqlite3_file*) {
    return 0;
} // no promise of atomic, ordered or power-safe writes
int shim_shm_map(sqlite3_file* f, int page, int size, int extend, volatile void** out) {
    return shim(f)->real()->pMethods->xShmMap(shim(f)->real(), page, size, extend, out);
}
int shim_shm_lock(sqlite3_file* f, int offset, int n, int flags) {
    return shim(f)->real()->pMethods->xShmLock(shim(f)->real(), offset, n, flags);
}
void shim_shm_barrier(sqlite3_file* f) {
    shim(f)->real()->pMethods->xShmBarrier(shim(f)->real());
}
int shim_shm_unmap(sqlite3_file* f, int remove) {
    return shim(f)->real()->pMethods->xShmUnmap(shim(f)->real(), remove);
}

const sqlite3_io_methods kMethods = {2, // version 2: shared memory, no memory-mapped reads
                                     shim_close,
                                     shim_read,
                                     shim_write,
                                     shim_truncate,
                                     shim_sync,
                                     shim_size,
                                     shim_lock,
                                     shim_unlock,
                                     shim_reserved,
                                     shim_control,
                                     shim_sector,
                                     shim_device,
                                     shim_shm_map,
                                     shim_shm_lock,
                                     shim_shm_barrier,
                                     shim_shm_unmap,
                                     nullptr,
                                     nullptr};

int shim_open(sqlite3_vfs*, const char* name, sqlite3_file* f, int flags, int* out_flags) {
    ShimFile* s = shim(f);
    s->base.pMethods = nullptr;
    s->tracked = nullptr;
    if (vfs().crashed()) return SQLITE_CANTOPEN;
    const int code = real_vfs->xOpen(real_vfs, name, s->real(), flags, out_flags);
    if (code != SQLITE_OK) return code;
    if (name && flags & (SQLITE_OPEN_MAIN_DB | SQLITE_OPEN_WAL | SQLITE_OPEN_MAIN_JOURNAL))
        s->tracked = new std::shared_ptr<CrashVfs::File>(vfs().track(name));
    s->base.pMethods = &kMethods;
    return SQLITE_OK;
}
int shim_delete(sqlite3_vfs*, const char* name, int sync) {
    if (vfs().crashed()) return SQLITE_IOERR_DELETE;
    vfs().forget(name);
    return real_vfs->xDelete(real_vfs, name, sync);
}

} // namespace

CrashVfs& CrashVfs::instance() {
    static CrashVfs self;
    static const bool registered = [] {
        static sqlite3_vfs v;
        real_vfs = sqlite3_vfs_find(nullptr);
        v = *real_vfs;
        v.zName = kName;
        v.szOsFile = int(sizeof(ShimFile)) + real_vfs->szOsFile;
        v.xOpen = shim_open;
        v.xDelete = shim_delete;
        v.pNext = nullptr;
        return sqlite3_vfs_register(&v, 0) == SQLITE_OK;
    }();
    (void)registered;
    return self;
}

void CrashVfs::reset() {
    std::lock_guard lock(mutex_);
    files_.clear();
    writes_ = refused_ = 0;
    crash_at_ = budget_ = ~u64(0);
    crashed_ = false;
}

void CrashVfs::crash_after(u64 writes) {
    std::lock_guard lock(mutex_);
    crash_at_ = writes_ + writes;
}

bool CrashVfs::crashed() const {
    std::lock_guard lock(mutex_);
    return crashed_;
}

u64 CrashVfs::writes() const {
    std::lock_guard lock(mutex_);
    return writes_;
}

void CrashVfs::set_budget(u64 bytes) {
    std::lock_guard lock(mutex_);
    budget_ = bytes;
}

u64 CrashVfs::refused() const {
    std::lock_guard lock(mutex_);
    return refused_;
}

std::shared_ptr<CrashVfs::File> CrashVfs::track(const std::string& path) {
    std::lock_guard lock(mutex_);
    auto& file = files_[path];
    if (!file) file = std::make_shared<File>();
    return file;
}

void CrashVfs::forget(const std::string& path) {
    std::lock_guard lock(mutex_);
    files_.erase(path);
}

bool CrashVfs::may_write(File& file, u64 end, int& error) {
    std::lock_guard lock(mutex_);
    if (crashed_ || writes_ >= crash_at_) {
        crashed_ = true;
        error = SQLITE_IOERR_WRITE;
        return false;
    }
    u64 total = std::max(end, file.size) - file.size;
    for (const auto& [path, f] : files_)
        total += f->size;
    if (end > file.size && total > budget_) {
        ++refused_;
        error = SQLITE_FULL;
        return false;
    }
    ++writes_;
    return true;
}

void CrashVfs::wrote(File& file, Op op) {
    std::lock_guard lock(mutex_);
    file.size = op.truncate ? op.offset : std::max(file.size, op.offset + op.data.size());
    file.pending.push_back(std::move(op));
}

static void apply(Bytes& bytes, const CrashVfs::Op& op) {
    if (op.truncate) return bytes.resize(op.offset);
    if (bytes.size() < op.offset + op.data.size()) bytes.resize(op.offset + op.data.size());
    std::copy(op.data.begin(), op.data.end(), bytes.begin() + std::ptrdiff_t(op.offset));
}

void CrashVfs::synced(File& file) {
    std::lock_guard lock(mutex_);
    for (const Op& op : file.pending)
        apply(file.durable, op);
    file.pending.clear();
}

// Keeps some sectors of a write, and sometimes only the beginning of one.
static void apply_torn(Bytes& bytes, const CrashVfs::Op& op, Rng& rng) {
    if (op.truncate) return apply(bytes, op);
    for (u64 from = 0; from < op.data.size();) {
        const u64 to = std::min<u64>(op.data.size(), ((op.offset + from) / 512 + 1) * 512 - op.offset);
        const u32 fate = rng.below(16);
        const u64 end = fate == 0 ? from + (to - from) / 2 : to;
        if (fate < 10)
            apply(bytes, {op.offset + from, Bytes(op.data.begin() + i64(from), op.data.begin() + i64(end)), false});
        from = to;
    }
}

void CrashVfs::crash_image(const std::string& folder, Rng& rng) const {
    std::lock_guard lock(mutex_);
    for (const auto& [path, file] : files_) {
        Bytes bytes = file->durable;
        const u32 manner = rng.below(4); // nothing, all, whole writes, sectors
        for (const Op& op : file->pending) {
            if (manner == 1 || (manner == 2 && rng.below(2))) apply(bytes, op);
            if (manner == 3) apply_torn(bytes, op, rng);
        }
        std::ofstream out(folder + "/" + std::filesystem::path(path).filename().string(), std::ios::binary);
        out.write(reinterpret_cast<const char*>(bytes.data()), std::streamsize(bytes.size()));
    }
}

} // namespace vitrail::testing
