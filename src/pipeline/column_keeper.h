// ColumnKeeper: puts freshly generated columns into a world, in batches of one transaction each. A column that the world
// holds already stays as it is: somebody may have built there.
#pragma once

#include "store/world_records.h"
#include "terrain/generator.h"

#include <memory>
#include <mutex>
#include <string>

namespace vitrail {

class ColumnKeeper {
public:
    // Opens the world in `folder`, made where there is none. Errors: the store's; invalid_argument, where it is a world of
    // another seed or generator; denied, where it is an unfinished import.
    static Result<std::unique_ptr<ColumnKeeper>> open(const std::string& folder, const TerrainGenerator& generator,
                                                      std::shared_ptr<const BlockRegistry> registry);

    WorldRecords& records() { return *records_; }
    // Thread-safe; takes the column's chunks. Errors: the store's, then or from an earlier batch's commit.
    Result<> keep(ColumnPos at, GeneratedColumn& column);
    Result<> flush(); // what still waits

private:
    Result<> flush_locked();
    std::unique_ptr<WorldRecords> records_;
    std::mutex mutex_;
    SaveBatch batch_;
};

} // namespace vitrail
