#include "base/clock.h"

#include <chrono>
#include <cstdio>
#include <cstring>
#include <ctime>

namespace vitrail {

u64 now_ns() {
    return u64(std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::steady_clock::now().time_since_epoch())
                   .count());
}

u64 thread_time_ns() {
    timespec t{};
    if (clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t) != 0) return now_ns();
    return u64(t.tv_sec) * 1000000000ull + u64(t.tv_nsec);
}

static u64 status_kib(const char* key) {
    std::FILE* file = std::fopen("/proc/self/status", "r");
    if (!file) return 0;
    char line[256];
    unsigned long long value = 0;
    while (std::fgets(line, sizeof line, file))
        if (std::strncmp(line, key, std::strlen(key)) == 0) std::sscanf(line + std::strlen(key), ": %llu", &value);
    std::fclose(file);
    return value;
}

u64 peak_memory_bytes() {
    return status_kib("VmHWM") * 1024;
}
u64 resident_memory_bytes() {
    return status_kib("VmRSS") * 1024;
}

} // namespace vitrail
