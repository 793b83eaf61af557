#include "server/edits.h"

#include "light/relight.h"
#include "server/chunk_loading.h"
#include "server/interest.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace vitrail::server {

namespace {

constexpr float kReachSlack = 1.0f; // blocks: commands on their way move the eye

struct Verdict {
    std::vector<Edit> edits;
};

float reach_distance(const Session& session, const net::EditRequest& request) {
    const BlockPos at = net::from_wire(request.at);
    const Vec3 corner = view_from(eye_of(session.body), at).v;
    return length(corner + Vec3{std::clamp(request.hit_x, 0.0f, 1.0f), std::clamp(request.hit_y, 0.0f, 1.5f),
                                std::clamp(request.hit_z, 0.0f, 1.0f)});
}

Result<Verdict> judge(ServerWorld& world, ServerDimension& dimension, Session& session, const net::EditRequest& request) {
    const BlockPos at = net::from_wire(request.at);
    const StateTable& states = world.states();
    if (!dimension.dimension.contains(at)) return fail(ErrorCode::denied, "the world ends here");
    if (!ready(dimension, column_of(chunk_of(at)))) return fail(ErrorCode::denied, "nothing is loaded here");
    if (reach_distance(session, request) > 5.0f + kReachSlack) return fail(ErrorCode::denied, "too far away");
    const StateId target = dimension.dimension.state_at(at);
    if (!request.target.empty() && states.info(target).state.to_string() != request.target)
        return fail(ErrorCode::denied, "the block has changed");
    if (is_hidden(at, [&](BlockPos p) { return state_for_surface(dimension, p); }, opaque_states(states)))
        return fail(ErrorCode::denied, "the block is not in sight");
    Verdict verdict;
    if (request.kind == net::EditKind::break_block) {
        verdict.edits.push_back({at, StateId::air});
        return verdict;
    }
    VX_TRY_ASSIGN(BlockState held, parse_block_state(request.held));
    VX_TRY_ASSIGN(StateId id, world.states().intern_with_defaults(held));
    verdict.edits.push_back({neighbor(at, Face(request.face)), id});
    return verdict;
}

} // namespace

ChangeSet edit_world(ServerWorld& world, ServerDimension& dimension, const EditBatch& batch) {
    EditBatch loaded;
    for (const Edit& e : batch.edits)
        if (dimension.dimension.contains(e.at) && require_chunk(dimension, chunk_of(e.at))) loaded.edits.push_back(e);
    ChangeSet changes = apply(dimension.dimension, loaded);
    relight(dimension.dimension, changes);
    for (ChunkPos at : changes.block_chunks) {
        dimension.dirty_chunks.insert(at);
        dimension.dirty_columns.insert(column_of(at));
    }
    dimension.light_changed.insert(changes.light_chunks.begin(), changes.light_chunks.end());
    tell_block_changes(world, dimension, changes);
    return changes;
}

void run_edits(ServerWorld& world) {
    for (auto& session : world.sessions) {
        if (!session->joined) continue;
        for (const net::EditRequest& request : session->requests) {
            ServerDimension& dimension = world.dimensions.at(session->dimension());
            auto verdict = judge(world, dimension, *session, request);
            if (!verdict) {
                session->results.push_back({request.sequence, net::EditOutcome::refused, verdict.error().message.substr(0, 256)});
                continue;
            }
            edit_world(world, dimension, EditBatch{std::move(verdict->edits)});
            session->results.push_back({request.sequence, net::EditOutcome::accepted, {}});
            session->unkept_sequence = request.sequence;
        }
        session->requests.clear();
    }
}

} // namespace vitrail::server
