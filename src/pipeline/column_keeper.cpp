#include "pipeline/column_keeper.h"

#include "pipeline/new_world.h"

#include <fmt/format.h>

namespace vitrail {

static constexpr std::size_t kColumnsABatch = 64;

Result<std::unique_ptr<ColumnKeeper>> ColumnKeeper::open(const std::string& folder, const TerrainGenerator& generator,
                                                         std::shared_ptr<const BlockRegistry> registry) {
    auto keeper = std::make_unique<ColumnKeeper>();
    VX_TRY_ASSIGN(keeper->records_, WorldRecords::open(folder, registry, {.create = true}));
    VX_TRY_ASSIGN(const auto level, keeper->records_->load_level());
    if (!level) {
        VX_TRY(make_new_level(*keeper->records_, "World", generator.seed(), &generator, 0));
        return keeper;
    }
    if (level->unfinished)
        return fail(ErrorCode::denied, fmt::format("world {} is an unfinished import of {}: if it no longer runs, import it again",
                                                   folder, level->source));
    if (level->seed != generator.seed() || level->generator != kGeneratorName || level->generator_version != kGeneratorVersion)
        return fail(ErrorCode::invalid_argument, fmt::format("{} is a world of seed {} and generator '{}' (version {}) already: it is left as it is",
                                                             folder, level->seed, level->generator, level->generator_version));
    return keeper;
}

Result<> ColumnKeeper::keep(ColumnPos at, GeneratedColumn& column) {
    VX_TRY_ASSIGN(const auto held, records_->load_column(DimensionId::overworld, at));
    if (held && held->generated) return {};
    std::lock_guard lock(mutex_);
    for (std::size_t i = 0; i < column.chunks.size(); ++i)
        batch_.chunks.push_back({DimensionId::overworld, {at.x, kTerrainMinY / kChunkSize + i32(i), at.z},
                                 std::make_shared<Chunk>(std::move(column.chunks[i]))});
    ColumnRecord record;
    record.heights.above = column.heights;
    record.generated = true;
    batch_.columns.push_back({DimensionId::overworld, at, record});
    return batch_.columns.size() >= kColumnsABatch ? flush_locked() : Result<>{};
}

Result<> ColumnKeeper::flush() {
    std::lock_guard lock(mutex_);
    return flush_locked();
}

Result<> ColumnKeeper::flush_locked() {
    const SaveBatch batch = std::exchange(batch_, {});
    return batch.empty() ? Result<>{} : records_->save(batch);
}

} // namespace vitrail
