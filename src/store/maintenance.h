// What `vitrail inspect | verify | backup` do. All open the world read-only, so they work while it is played.
#pragma once

#include "store/world_records.h"

#include <map>

namespace vitrail {

struct VerifyReport {
    u64 records = 0, chunks = 0;       // looked at
    u64 quarantined = 0;               // set aside earlier
    std::vector<std::string> findings; // one line a damaged record, at most 1000
    u64 damaged = 0;                   // all of them
    bool sound() const { return damaged == 0; }
};

// The engine's integrity, each record's checksum, that it decodes, and that its state and biome ids are known.
// Errors: those of opening. Damage is a finding, not an error.
Result<VerifyReport> verify_world(const std::string& folder);

// A consistent copy into the folder `target`, made while others may play. Errors: not_found, invalid_argument (target
// holds a world), io.
Result<> backup_world(const std::string& folder, const std::string& target);

struct InspectReport {
    struct DimensionCounts {
        std::string name;
        u64 chunks = 0, columns = 0, chunk_bytes = 0;
    };
    LevelRecord level;
    std::map<std::string, u64> blocks; // by block state text, air included, hidden left out
    std::vector<DimensionCounts> dimensions;
    u64 states = 0, biomes = 0, players = 0, block_entities = 0, entities = 0, damaged = 0;
    u64 size_bytes = 0; // on disk
};

// Errors: those of opening.
Result<InspectReport> inspect_world(const std::string& folder);

} // namespace vitrail
