// What blocks owe to their neighbors: shapes that join (fences, panes, walls, stairs, rails), things that need
// something to stand on or hang from, and blocks of two parts. Shared by placement and breaking.
#pragma once

#include "rules/collision.h"
#include "voxel/edit.h"
#include "world/dimension.h"

#include <optional>
#include <unordered_map>

namespace vitrail {

// The world with edits on top that are not applied yet.
class EditView {
public:
    explicit EditView(const Dimension& dimension)
        : dimension_(dimension) {}
    const Dimension& dimension() const { return dimension_; }
    StateTable& states() const { return dimension_.states(); }
    StateId id_at(BlockPos at) const;
    const StateInfo& info_at(BlockPos at) const { return states().info(id_at(at)); }
    // Within the dimension and known, loaded or open sky: only there may rules change anything. Where an edit lies in
    // open sky without a chunk, who applies it makes the chunk first.
    bool editable(BlockPos at) const {
        return dimension_.contains(at) && cell_kind(dimension_, at) != CellKind::unknown;
    }
    Result<> set(BlockPos at, const BlockState& state);
    EditBatch batch() const; // without edits that change nothing

private:
    const Dimension& dimension_;
    std::unordered_map<BlockPos, StateId> pending_;
    std::vector<BlockPos> order_;
};

bool has_property(const StateInfo& info, std::string_view property);

// Horizontal faces by name and back; nothing for other words.
std::optional<Face> face_named(std::string_view name);
const char* name_of(Face face);
Face clockwise(Face horizontal); // seen from above: north to east
Face counterclockwise(Face horizontal);

// Whether the face of a state can carry things: its collision boxes fill that side of the cell.
bool is_sturdy(const BlockShape& shape, Face face);
// The same for what needs only the middle (torches and lanterns on fences and walls).
bool holds_center(const BlockShape& shape, Face face);

// Whether what is at `at` has what it stands on, hangs from or belongs to. True for everything that needs nothing.
bool is_supported(const EditView& view, BlockPos at);

// Where the other part of a door, bed or tall plant should be.
std::optional<BlockPos> other_part(const StateInfo& info, BlockPos at);
// Whether `other` is that part.
bool belong_together(const StateInfo& info, const StateInfo& other);

// The state with its connections to its neighbors as they now are.
BlockState connected(const EditView& view, BlockPos at, BlockState state);

// What is left where a block goes: water where it was waterlogged, else air.
BlockState remains_of(const StateInfo& info);

inline constexpr std::size_t kSettleMost = 4096; // blocks that one edit may bring down
// After the edits around these positions: takes away what lost its support, then joins what is left. Errors: limit.
Result<> settle(EditView& view, std::vector<BlockPos> changed);

} // namespace vitrail
