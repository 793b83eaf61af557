#include "formats/level_dat.h"

#include <algorithm>
#include <fmt/format.h>
#include <map>

namespace vitrail {

namespace fs = std::filesystem;

namespace {

constexpr u64 kMaxLevelBytes = u64(64) << 20;

i32 clamped(i64 v) {
    return i32(std::clamp<i64>(v, -kWorldEdge, kWorldEdge - 1));
}

u32 day_of(i64 ticks) {
    return u32(((ticks % 24000) + 24000) % 24000);
}

Result<> parse_packed(ByteView bytes, Inflater& inflater, nbt::Document& document) {
    const auto method = guess_compression(bytes);
    const Inflated unpacked = inflater.unpack(method.value_or(Compression::gzip), bytes);
    document.parse(unpacked.bytes);
    if (document.root().size() == 0) return fail(ErrorCode::damaged, "holds no readable NBT");
    return {};
}

} // namespace

Result<LevelInfo> read_level_dat(ByteView bytes) {
    Inflater inflater;
    nbt::Document document;
    VX_TRY(parse_packed(bytes, inflater, document));
    const nbt::Tag root = document.root();
    const nbt::Tag data = root.has("Data") ? root["Data"] : root;
    LevelInfo out;
    out.found = true;
    out.name = data["LevelName"].text();
    out.data_version = i32(std::clamp<i64>(data["DataVersion"].integer(), 0, 1 << 24));
    // SpawnX.. to 1.21.8; from 1.21.9 on a compound with position and dimension.
    if (const nbt::Tag spawn = data["spawn"]; spawn.is(nbt::Type::compound)) {
        const nbt::Tag pos = spawn["pos"];
        if (pos.size() == 3)
            out.spawn = BlockPos{clamped(pos.integer_at(0)), clamped(pos.integer_at(1)), clamped(pos.integer_at(2))};
        if (const auto name = spawn["dimension"].text(); !name.empty()) out.spawn_dimension = name;
    } else if (data.has("SpawnX") && data.has("SpawnY") && data.has("SpawnZ")) {
        out.spawn = BlockPos{clamped(data["SpawnX"].integer()), clamped(data["SpawnY"].integer()),
                             clamped(data["SpawnZ"].integer())};
    }
    if (data.has("RandomSeed")) out.seed = data["RandomSeed"].integer();
    if (const nbt::Tag seed = data["WorldGenSettings"]["seed"]) out.seed = seed.integer();
    const i64 time = data["Time"].integer();
    out.time = time > 0 ? u64(time) : 0;
    out.day_time = day_of(data.has("DayTime") ? data["DayTime"].integer() : time);
    out.raining = data["raining"].integer() != 0;
    return out;
}

namespace {

using RegionMap = std::map<RegionPos, SourceRegion>;

// Region files of one folder; not below it.
RegionMap regions_in(const fs::path& folder) {
    RegionMap out;
    std::error_code error;
    for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
        const auto at = region_pos_of(it->path().filename().string());
        std::error_code ignored;
        if (!at || !it->is_regular_file(ignored)) continue;
        SourceRegion& region = out[*at];
        if (region.file.empty() || it->path().extension() == ".mca") region = {*at, it->path(), {}};
    }
    return out;
}

// The regions of a dimension's folder, each with its entities file.
RegionMap dimension_regions(const fs::path& folder) {
    RegionMap out = regions_in(folder / "region");
    for (auto& [at, entities] : regions_in(folder / "entities"))
        if (auto it = out.find(at); it != out.end()) it->second.entities = entities.file;
    return out;
}

// 1.16 to today: dimensions/NAMESPACE/PATH/region, PATH of one or more folders.
void find_named_dimensions(const fs::path& folder, const std::string& ns, const std::string& path, int depth,
                           std::map<std::string, RegionMap>& out) {
    std::error_code error;
    for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
        std::error_code ignored;
        if (!it->is_directory(ignored)) continue;
        const std::string name = it->path().filename().string();
        const std::string below = path.empty() ? name : path + "/" + name;
        if (RegionMap regions = dimension_regions(it->path()); !regions.empty())
            out[ns + ":" + below] = std::move(regions);
        if (depth < 8 && name != "region" && name != "entities" && name != "poi" && name != "data")
            find_named_dimensions(it->path(), ns, below, depth + 1, out);
    }
}

std::map<std::string, RegionMap> find_dimensions(const fs::path& folder, std::vector<std::string>& problems) {
    std::map<std::string, RegionMap> out;
    std::error_code error;
    for (fs::directory_iterator it(folder / "dimensions", error), end; !error && it != end; it.increment(error)) {
        std::error_code ignored;
        if (it->is_directory(ignored)) find_named_dimensions(it->path(), it->path().filename().string(), "", 0, out);
    }
    auto add_old = [&](const fs::path& at, const std::string& name) {
        RegionMap regions = dimension_regions(at);
        if (regions.empty()) return;
        if (out.contains(name)) {
            problems.push_back(
                fmt::format("{} lies in the world twice; the newer layout under dimensions/ is read", name));
            return;
        }
        out[name] = std::move(regions);
    };
    add_old(folder, "minecraft:overworld");
    for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
        const std::string name = it->path().filename().string();
        std::error_code ignored;
        if (name.rfind("DIM", 0) != 0 || !it->is_directory(ignored)) continue;
        add_old(it->path(), name == "DIM-1"  ? "minecraft:the_nether"
                            : name == "DIM1" ? "minecraft:the_end"
                                             : "legacy:" + name);
    }
    return out;
}

// 26.1 on keeps clocks, weather and generator settings in files of their own.
void read_level(WorldSource& out) {
    for (const char* name : {"level.dat", "level.dat_old"}) {
        auto bytes = read_file(out.folder / name, kMaxLevelBytes);
        if (!bytes) {
            if (bytes.error().code != ErrorCode::not_found) out.problems.push_back(bytes.error().message);
            continue;
        }
        if (auto level = read_level_dat(*bytes)) {
            out.level = std::move(*level);
            break;
        } else {
            out.problems.push_back(fmt::format("{}: {}", name, level.error().message));
        }
    }
    if (!out.level.found) out.problems.push_back("no readable level.dat: name, spawn and time are unknown");
    Inflater inflater;
    nbt::Document document;
    auto read_data = [&](const char* file, auto use) {
        auto bytes = read_file(out.folder / "data" / "minecraft" / file, kMaxLevelBytes);
        if (bytes && parse_packed(*bytes, inflater, document)) use(document.root()["data"]);
    };
    if (!out.level.seed)
        read_data("world_gen_settings.dat", [&](const nbt::Tag& data) {
            if (data.has("seed")) out.level.seed = data["seed"].integer();
        });
    read_data("world_clocks.dat", [&](const nbt::Tag& data) {
        const nbt::Tag clock = data["minecraft:overworld"];
        if (clock.has("total_ticks")) out.level.day_time = day_of(clock["total_ticks"].integer());
    });
}

} // namespace

Result<WorldSource> open_world_source(const fs::path& source) {
    WorldSource out;
    std::error_code error;
    const fs::file_status status = fs::status(source, error);
    if (error || status.type() == fs::file_type::not_found)
        return fail(ErrorCode::not_found, fmt::format("there is no {}", source.string()));
    std::map<std::string, RegionMap> dimensions;
    if (fs::is_directory(status)) {
        out.folder = source;
        dimensions = find_dimensions(source, out.problems);
        if (dimensions.empty())
            if (RegionMap bare = regions_in(source); !bare.empty()) {
                // A region folder itself: its neighbor holds the entities.
                if (source.filename() == "region" ||
                    (source.filename().empty() && source.parent_path().filename() == "region"))
                    for (auto& [at, e] : regions_in(source / ".." / "entities"))
                        if (auto it = bare.find(at); it != bare.end()) it->second.entities = e.file;
                dimensions["minecraft:overworld"] = std::move(bare);
            }
        if (dimensions.empty())
            return fail(ErrorCode::not_found,
                        fmt::format("no Minecraft region files (.mca, .mcr) in {}", source.string()));
        read_level(out);
    } else if (source.filename() == "level.dat") {
        return open_world_source(source.has_parent_path() ? source.parent_path() : fs::path("."));
    } else {
        out.folder = source.parent_path();
        const std::string ext = source.extension().string();
        if (ext != ".mca" && ext != ".mcr")
            return fail(ErrorCode::invalid_argument,
                        fmt::format("{} is neither a world folder nor a region file", source.string()));
        const auto at = region_pos_of(source.filename().string());
        if (!at) out.problems.push_back("the file's name tells no place; it is read as region 0, 0");
        dimensions["minecraft:overworld"][at.value_or(RegionPos{})] = {at.value_or(RegionPos{}), source, {}};
    }
    auto take = [&](const std::string& name, RegionMap& regions) {
        SourceDimension& d = out.dimensions.emplace_back();
        d.name = name;
        for (auto& [at, region] : regions)
            d.regions.push_back(std::move(region));
    };
    if (auto it = dimensions.find("minecraft:overworld"); it != dimensions.end()) {
        take(it->first, it->second);
        dimensions.erase(it);
    }
    for (auto& [name, regions] : dimensions)
        take(name, regions);
    return out;
}

} // namespace vitrail
