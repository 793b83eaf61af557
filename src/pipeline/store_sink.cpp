#include "pipeline/store_sink.h"

#include <algorithm>

namespace vitrail {

StoreSink::StoreSink(WorldRecords& records, StoreSinkOptions options)
    : records_(records)
    , options_(options)
    , writer_([this] { run(); }) {}

StoreSink::~StoreSink() {
    {
        std::lock_guard lock(mutex_);
        ending_ = dropped_ = true;
    }
    changed_.notify_all();
    if (writer_.joinable()) writer_.join();
}

Result<> StoreSink::level(const LevelInfo& info, const std::string& source) {
    level_.name = info.name.substr(0, 200);
    level_.seed = u64(info.seed.value_or(0));
    level_.time_ticks = info.time - info.time % 24000 + info.day_time;
    level_.source = source.substr(0, 1000);
    spawn_known_ = info.spawn.has_value();
    if (info.spawn) level_.spawn.at = *info.spawn;
    if (info.spawn_dimension == "minecraft:the_nether") level_.spawn.dimension = DimensionId(1);
    if (info.spawn_dimension == "minecraft:the_end") level_.spawn.dimension = DimensionId(2);
    SaveBatch batch;
    batch.level = level_;
    batch.level->unfinished = true;
    return records_.save(batch);
}

Result<> StoreSink::dimension(const DimensionInfo& info) {
    SaveBatch batch;
    batch.dimensions.push_back(info);
    return records_.save(batch);
}

Result<> StoreSink::put_columns(std::vector<ImportedColumn> batch) {
    if (options_.stop && *options_.stop) return fail(ErrorCode::denied, "interrupted");
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return error_ || waiting_.size() < options_.columns_waiting_most; });
    if (error_) return tl::unexpected(*error_);
    std::move(batch.begin(), batch.end(), std::back_inserter(waiting_));
    lock.unlock();
    changed_.notify_all();
    return {};
}

Result<> StoreSink::finish() {
    {
        std::lock_guard lock(mutex_);
        ending_ = true;
    }
    changed_.notify_all();
    if (writer_.joinable()) writer_.join();
    if (error_) return tl::unexpected(*error_);
    SaveBatch batch;
    batch.level = level_;
    return records_.save(batch);
}

Result<> StoreSink::save(std::vector<ImportedColumn> columns) {
    SaveBatch batch;
    for (ImportedColumn& column : columns) {
        const i64 x = column.at.x, z = column.at.z, distance = x * x + z * z;
        if (!spawn_known_ && column.dimension == DimensionId::overworld && distance < nearest_) {
            nearest_ = distance;
            level_.spawn.at = {column.at.x * 16 + 8, column.heights.above[8 | 8 << 4], column.at.z * 16 + 8};
        }
        for (ImportedColumn::Part& part : column.chunks)
            batch.chunks.push_back({column.dimension, {column.at.x, part.y, column.at.z}, std::move(part.chunk)});
        batch.columns.push_back({column.dimension, column.at, {.heights = column.heights, .generated = true}});
    }
    return records_.save(batch);
}

void StoreSink::run() {
    std::unique_lock lock(mutex_);
    for (;;) {
        changed_.wait(lock, [&] { return ending_ || waiting_.size() >= options_.columns_a_batch; });
        if (dropped_ || (ending_ && waiting_.empty())) return;
        const std::size_t n = std::min<std::size_t>(waiting_.size(), options_.columns_a_batch);
        std::vector<ImportedColumn> batch(std::make_move_iterator(waiting_.begin()),
                                          std::make_move_iterator(waiting_.begin() + std::ptrdiff_t(n)));
        waiting_.erase(waiting_.begin(), waiting_.begin() + std::ptrdiff_t(n));
        lock.unlock();
        changed_.notify_all();
        Result<> kept = save(std::move(batch));
        lock.lock();
        if (!kept) {
            error_ = std::move(kept).error();
            lock.unlock();
            changed_.notify_all();
            return;
        }
    }
}

} // namespace vitrail
