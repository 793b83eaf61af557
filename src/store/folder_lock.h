// FolderLock: one process at a time writes a world. A lock of the operating system on the file `lock` in the folder: it
// ends with the process, however that ends, so a killed one never leaves a world locked.
#pragma once

#include "base/result.h"

#include <string>

namespace vitrail {

class FolderLock {
public:
    // Errors: busy, naming the folder and the holder's process; io.
    static Result<FolderLock> take(const std::string& folder);
    FolderLock() = default;
    FolderLock(FolderLock&& o) noexcept
        : fd_(o.fd_) {
        o.fd_ = -1;
    }
    FolderLock& operator=(FolderLock&& o) noexcept;
    ~FolderLock();

private:
    int fd_ = -1;
};

} // namespace vitrail
