#include "rules/breaking.h"

#include "rules/neighbors.h"

#include <fmt/format.h>
#include <limits>

namespace vitrail {

Result<> can_break(const Dimension& dimension, BlockPos at) {
    const EditView view(dimension);
    if (!view.editable(at)) return fail(ErrorCode::not_found, "there is nothing to break: the place is not loaded");
    const StateId id = view.id_at(at);
    const StateInfo& info = view.states().info(id);
    const u8 flags = view.states().flags(id);
    if (id == StateId::hidden) return fail(ErrorCode::denied, "this block cannot be seen");
    if (flags & (kAirLike | kLiquid)) return fail(ErrorCode::denied, "there is no block");
    if (info.look->hardness < 0) return fail(ErrorCode::denied, fmt::format("{} cannot be broken", info.state.name));
    return {};
}

Result<EditBatch> break_block(const Dimension& dimension, BlockPos at) {
    VX_TRY(can_break(dimension, at));
    EditView view(dimension);
    const StateInfo& info = view.info_at(at);
    std::vector<BlockPos> changed{at};
    VX_TRY(view.set(at, remains_of(info)));
    // The other part goes even where nothing hangs on it.
    if (const auto other = other_part(info, at); other && view.editable(*other)) {
        const StateInfo& second = view.info_at(*other);
        if (belong_together(info, second)) {
            VX_TRY(view.set(*other, remains_of(second)));
            changed.push_back(*other);
        }
    }
    // A double chest leaves a single one.
    if (const std::string_view type = info.state.get("type");
        info.look->shape == ShapeKind::chest && (type == "left" || type == "right")) {
        const Face facing = face_named(info.state.get("facing")).value_or(Face::north);
        const BlockPos other = neighbor(at, type == "left" ? clockwise(facing) : counterclockwise(facing));
        const StateInfo& second = view.info_at(other);
        if (view.editable(other) && second.state.name == info.state.name && second.state.get("type") != type &&
            second.state.get("type") != "single") {
            BlockState single = second.state;
            single.set("type", "single");
            VX_TRY(view.set(other, single));
        }
    }
    VX_TRY(settle(view, std::move(changed)));
    return view.batch();
}

float break_seconds(const BlockLook& look, bool creative) {
    if (look.hardness < 0) return std::numeric_limits<float>::infinity();
    return creative ? 0.0f : look.hardness * 1.5f;
}

} // namespace vitrail
