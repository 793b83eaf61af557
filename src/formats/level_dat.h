// What a Minecraft world folder holds: level.dat and the region files of its dimensions, in every layout from Beta to
// today.
#pragma once

#include "formats/region.h"
#include "voxel/coords.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace vitrail {

// level.dat; a world without it, or with a damaged one, keeps the defaults.
struct LevelInfo {
    bool found = false; // read, wholly or in part
    std::string name;
    i32 data_version = 0; // 0 before 1.9
    std::optional<BlockPos> spawn;
    std::string spawn_dimension = "minecraft:overworld";
    std::optional<i64> seed;
    u64 time = 0;     // ticks since the world was made
    u32 day_time = 0; // 0..23999
    bool raining = false;
};

struct SourceRegion {
    RegionPos at;
    std::filesystem::path file;
    std::filesystem::path entities; // the region of the separate entities folder (1.17 on); empty where there is none
};

struct SourceDimension {
    std::string name;                  // minecraft:overworld, ...
    std::vector<SourceRegion> regions; // by position
};

struct WorldSource {
    std::filesystem::path folder;
    LevelInfo level;
    std::vector<SourceDimension> dimensions; // the overworld first, where it is there; each has a region
    std::vector<std::string> problems;       // one line each
};

// `source`: a world folder, its level.dat, a folder of bare region files, or one region file (read as overworld).
// Where both .mca and .mcr exist for a place, the .mca counts.
// Errors: not_found, where there is no such file or no region in it; io.
Result<WorldSource> open_world_source(const std::filesystem::path& source);

// The bytes of a level.dat (gzip or bare NBT). Errors: damaged, where nothing could be read.
Result<LevelInfo> read_level_dat(ByteView bytes);

} // namespace vitrail
