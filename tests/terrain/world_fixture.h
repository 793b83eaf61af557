// Columns that stand for the world, and their hash.
#pragma once

#include "terrain/generator.h"
#include "tests/terrain/base_terrain.h"

#include <gtest/gtest.h>

#include <cstdlib>

namespace vitrail {

// Order-free sum over columns, as `vitrail generate --hash` prints it.
inline u64 place_hash(ColumnPos at, const GeneratedColumn& column) {
    return hash_combine(hash_combine(u32(at.x), u32(at.z)), column_hash(column));
}

// 1,024 columns: a square at the origin, and pieces in all four quadrants and at the far corners of the world.
// Rectangles of columns, row by row.
struct SampleRect {
    ColumnPos first;
    i32 side;
};
inline constexpr SampleRect kSampleRects[] = {
    {{-12, -12}, 24},  {{-5000, -7000}, 8},           {{4000, -6000}, 8},          {{-9000, 3000}, 8},
    {{8000, 2000}, 8}, {{-134217600, -134217600}, 8}, {{134217500, 134217500}, 8}, {{-134217600, 134217500}, 8}};
inline constexpr u64 kSampleSeed = 20261122;
// Sum of place_hash over them. Whoever changes the land on purpose takes the new number from the failing test, and
// raises kGeneratorVersion (pipeline/new_world.h) once worlds exist that were made with the old.
inline constexpr u64 kSampleHash = 3263921860082023420u;

inline std::vector<ColumnPos> sample_columns() {
    std::vector<ColumnPos> out;
    for (const SampleRect& r : kSampleRects)
        for (i32 i = 0; i < r.side * r.side; ++i)
            out.push_back({r.first.x + i % r.side, r.first.z + i / r.side});
    return out;
}

inline bool long_tests() {
    return std::getenv("VITRAIL_LONG") != nullptr;
}

} // namespace vitrail
