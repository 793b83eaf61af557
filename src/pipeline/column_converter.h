// RawColumn to chunks of the world: names become state and biome ids, old numbers take their modern states.
#pragma once

#include "formats/legacy_connect.h"
#include "formats/raw_column.h"
#include "pipeline/import.h"

#include <unordered_map>

namespace vitrail {

// One a worker; caches what each name and number is in the target world.
class ColumnConverter {
public:
    explicit ColumnConverter(ImportSink& sink)
        : sink_(sink) {}

    // Takes the blobs out of `raw`. `names` is the table its numbers belong to, always the same one. `around` holds the
    // neighbors of a column with numeric ids. `least_y` is the dimension's.
    // Errors: the sink's, and limit (too many states).
    Result<ImportedColumn> convert(RawColumn& raw, const NameTable& names, const LegacyView* around,
                                   DimensionId dimension, i32 least_y);

    // Whether a column of that status has had its terrain made.
    static bool has_terrain(std::string_view status);

    std::vector<u64> counts; // by state id
    u64 block_entities = 0, entities = 0, ticks = 0, skipped = 0;
    std::vector<std::string> problems;

private:
    Result<StateId> state_of_name(u32 number, const NameTable& names);
    Result<StateId> state_of_key(LegacyKey key);
    Result<BiomeId> biome_of(u32 number, const NameTable& names);
    Result<BlockStorage> blocks_of(const RawSection& section, const NameTable& names, const LegacyView* around);
    Result<BiomeGrid> biomes_of(const RawColumn& raw, i32 y, const NameTable& names);
    void keep_entities(RawColumn& raw, std::vector<std::pair<i32, std::shared_ptr<Chunk>>>& chunks);

    ImportSink& sink_;
    std::vector<u32> states_, biomes_; // by name number; ~0: not asked yet
    std::unordered_map<LegacyKey, StateId> legacy_;
    std::vector<StateId> palette_;
    std::vector<LegacyKey> keys_;
    std::vector<u16> indices_;
};

} // namespace vitrail
