#include "pipeline/column_batches.h"

#include <algorithm>

namespace vitrail {

Result<GeneratedColumn> ColumnBatches::take(ColumnPos at, const TerrainPalette& palette) {
    const ColumnPos first{at.x & ~(kSide - 1), at.z & ~(kSide - 1)};
    const std::size_t own = std::size_t((at.z - first.z) * kSide + (at.x - first.x));
    std::unique_lock lock(mutex_);
    for (;;) {
        const auto found =
            std::find_if(squares_.begin(), squares_.end(), [&](const Square& s) { return s.first == first; });
        if (found == squares_.end()) break;
        if (found->making) {
            made_.wait(lock);
            continue;
        }
        if (!found->columns[own]) { // taken before: make the square anew
            squares_.erase(found);
            break;
        }
        GeneratedColumn out = std::move(*found->columns[own]);
        found->columns[own].reset();
        squares_.splice(squares_.begin(), squares_, found);
        return out;
    }
    squares_.emplace_front();
    const auto square = squares_.begin();
    square->first = first;
    lock.unlock();
    Result<std::vector<GeneratedColumn>> columns = tl::unexpected(Error{});
    {
        std::lock_guard making(maker_mutex_);
        const auto number = maker_->submit({first, kSide, kSide});
        if (number)
            columns = maker_->collect(*number, palette);
        else
            columns = tl::unexpected(number.error());
    }
    lock.lock();
    made_.notify_all();
    if (!columns) {
        squares_.erase(square);
        return tl::unexpected(columns.error());
    }
    for (std::size_t i = 0; i < columns->size(); ++i)
        if (i != own) square->columns[i] = std::move((*columns)[i]);
    square->making = false;
    for (auto last = squares_.end(); squares_.size() > kSquares && last != squares_.begin();) {
        --last;
        if (!last->making && last != square) last = squares_.erase(last);
    }
    return std::move((*columns)[own]);
}

} // namespace vitrail
