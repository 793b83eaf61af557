#include "render/meshing/mesh_kernels.h"

#include "render/meshing/mesher.h"

#include <atomic>
#include <string_view>

namespace vitrail::render {

namespace {

bool machine_has(std::string_view path) {
#if defined(__x86_64__)
    if (path == "avx512")
        return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
               __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512dq") &&
               __builtin_cpu_supports("avx512vbmi") && __builtin_cpu_supports("avx512vbmi2");
    if (path == "avx2")
        return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("bmi") && __builtin_cpu_supports("bmi2");
#endif
    return path == "portable";
}

const MeshKernels* find(std::string_view path) {
    for (const MeshKernels* k : {&kMeshKernelsAvx512, &kMeshKernelsAvx2, &kMeshKernelsPortable})
        if ((path.empty() || path == k->name) && machine_has(k->name)) return k;
    return nullptr;
}

std::atomic<const MeshKernels*> in_use{nullptr};

constexpr std::array<u8, 512> make_occlusion_table() {
    std::array<u8, 512> out{};
    for (u32 m = 0; m < 512; ++m) {
        const auto at = [&](i32 u, i32 v) { return m >> ((u + 1) + (v + 1) * 3) & 1; };
        const auto corner = [&](i32 u, i32 v) {
            const u32 a = at(u, 0), b = at(0, v);
            return a && b ? 0u : 3 - (a + b + at(u, v));
        };
        out[m] = u8(corner(-1, -1) | corner(1, -1) << 2 | corner(1, 1) << 4 | corner(-1, 1) << 6);
    }
    return out;
}

} // namespace

constexpr std::array<u8, 512> kOcclusionTable = make_occlusion_table();

const MeshKernels& mesh_kernels() {
    const MeshKernels* k = in_use.load(std::memory_order_relaxed);
    if (!k) in_use.store(k = find({}), std::memory_order_relaxed);
    return *k;
}

const char* mesher_path() {
    return mesh_kernels().name;
}

bool force_mesher_path(const char* path) {
    const MeshKernels* k = find(path);
    if (k) in_use.store(k, std::memory_order_relaxed);
    return k != nullptr;
}

} // namespace vitrail::render
