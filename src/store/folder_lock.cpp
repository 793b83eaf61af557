#include "store/folder_lock.h"

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>
#include <utility>

namespace vitrail {

Result<FolderLock> FolderLock::take(const std::string& folder) {
    const std::string path = folder + "/lock";
    const int fd = ::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
    if (fd < 0)
        return fail(ErrorCode::io,
                    fmt::format("world {}: cannot be opened for writing: {}", folder, std::strerror(errno)));
    FolderLock lock;
    lock.fd_ = fd;
    // flock, not fcntl: it belongs to the open file, so a second store in the same process is refused as well.
    while (::flock(fd, LOCK_EX | LOCK_NB) != 0) {
        if (errno == EINTR) continue;
        if (errno != EWOULDBLOCK)
            return fail(ErrorCode::io, fmt::format("world {}: cannot be locked: {}", folder, std::strerror(errno)));
        char holder[32] = {};
        const ssize_t size = ::pread(fd, holder, sizeof holder - 1, 0);
        const long pid = size > 0 ? std::strtol(holder, nullptr, 10) : 0;
        return fail(ErrorCode::busy, pid > 0 ? fmt::format("world {} is open in another process ({})", folder, pid)
                                             : fmt::format("world {} is open in another process", folder));
    }
    // The number only serves the message above; a full disk that refuses it is no reason to refuse the world.
    const std::string pid = fmt::format("{}\n", ::getpid());
    if (::ftruncate(fd, 0) == 0 && ::pwrite(fd, pid.data(), pid.size(), 0) < 0) errno = 0;
    return lock;
}

FolderLock& FolderLock::operator=(FolderLock&& o) noexcept {
    std::swap(fd_, o.fd_);
    return *this;
}

FolderLock::~FolderLock() {
    if (fd_ >= 0) ::close(fd_);
}

} // namespace vitrail
